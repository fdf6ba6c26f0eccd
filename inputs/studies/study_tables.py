# SPDX-License-Identifier: GPL-2.0-or-later
"""A study: its table of runs (NAME.csv) and its recipe (NAME.py beside it, or default.py).

study_tables.py CONFIG NAME OUT.csv    writes one of its tables: table, costs, differences, or a stack of the recipe
"""
import csv
import io
import itertools
import json
import math
import os
import re
import shlex
import shutil
import subprocess
import sys
from pathlib import Path

import yaml

INPUTS = Path(__file__).resolve().parent.parent
sys.path[:0] = [str(INPUTS), str(INPUTS.parent / "python")]
from lsm import LOADING  # noqa: E402
from lsm.analysis import mean_and_error  # noqa: E402
from recipes import Found, Missing, Numbers, Recipe, RecipeError, meant, read_json  # noqa: E402
from run import MPI, PROGRAMS, begun_otherwise, replace  # noqa: E402
from variables import declared, defaults  # noqa: E402

RESERVED = ("run", "program", "ranks", "settings")
# Kinds of the values of NAME=VALUE after the table, see config.yaml: whole numbers, or others; "" stands for none
WHOLE, POSITIVE = ("ranks", "seeds", "checkpoint"), ("hours", "shorten", "minutes")


class TableError(RecipeError):
    pass


def with_defaults(config):
    """The settings of a study. \\raises TableError for a name that config.yaml does not have, or an invalid value"""
    known = yaml.safe_load((INPUTS / "studies/config.yaml").read_text())
    for name, value in config.items():
        if name in ("table", "bin"):
            continue
        if name not in known:
            raise TableError(f"'{name}={value}', expected one of {', '.join(known)}")
        text = "" if value is None else str(value)
        if name in WHOLE and not re.fullmatch(r"[1-9]\d*" if known[name] else r"([1-9]\d*)?", text):
            raise TableError(f"'{name}={text}', expected a whole number above 0")
        if name in POSITIVE and not is_number(text, 0):
            raise TableError(f"'{name}={text}', expected a number above 0")
    pattern(config.get("only"), "only")
    return {**known, **config}


def is_number(text, above=-math.inf):
    try:
        return above < float(text) < math.inf
    except ValueError:
        return False


def shorten_of(config):
    return float(config.get("shorten") or 1)


def pattern(text, where):
    """Compiles a regular expression. \\raises TableError if it is not valid"""
    try:
        return re.compile("" if text is None else str(text))
    except re.error as error:
        raise TableError(f"{where} '{text}', expected a regular expression ({error})")


def text_of(path, what):
    """Text of a file. \\raises TableError naming file and line if it is not UTF-8"""
    try:
        raw = Path(path).read_bytes()
    except OSError as error:
        raise TableError(f"cannot read {path}, expected {what} ({error.strerror})")
    try:
        if 0 in raw:  # UTF-16 without a mark
            raise UnicodeDecodeError("utf-8", raw, raw.index(0), 1 + raw.index(0), "a byte of 0")
        return raw.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise TableError(f"{path}:{raw[:error.start].count(10) + 1}: not UTF-8, expected {what} in UTF-8")


class Run:

    def __init__(self, name, row, config):
        self.name = self.folder = name
        self.row, self.program, self.settings, self.shorten = row, row["program"], settings_of(row, config), shorten_of(config)
        self.postproc = shlex.quote(f"{config.get('bin')}/postproc")
        on_ranks = PROGRAMS[self.program].on_ranks
        given = row.get("ranks") or (config.get("ranks") if on_ranks else "")
        if row.get("ranks") and not on_ranks:
            raise TableError(f"ranks '{given}' of program '{self.program}', expected them for faults only")
        if given and not re.fullmatch(r"[1-9]\d*", str(given)):
            raise TableError(f"ranks '{given}', expected a whole number above 0")
        # On fewer cores a fault gets fewer ranks, unless they are given.
        self.ranks_given = bool(given)
        length = float(self.settings.get("length", 120)) if self.program == "fault" else 0
        self.ranks = int(given) if given else max(1, int(length / 60))
        if self.program == "esys":
            self.ranks = 2  # one process computes, one directs it
        self.words = [f"{key}={value}" for key, value in self.settings.items()]
        self.catalogue = f"{name}/{PROGRAMS[self.program].catalogue}"

    @property
    def failed(self):
        """Why the run cannot come to its end with these settings; empty if it can."""
        done = Path(self.name, "done.json")
        return read_json(done).get("failed", "") if done.exists() else ""

    @property
    def loaded(self):
        """When the first loading of a fault ends, in which PE rises: `loading`, for its velocity. 0 for other programs, and if the run ends before."""
        if self.program not in ("fault", "esys"):
            return 0
        said = defaults(self.settings.get("preset", "leaky")) | self.settings
        try:
            dt, velocity = float(said["dt"]), float(said["velocity"])
            times = [
                float(usual[1]) if (usual := re.match(r"\$\(round\((\d+)/v_dt", said[key])) else float(said[key]) * dt for key in ("settle", "steps")
            ]
            begin = 1200 + (LOADING - 1200) * float(defaults()["velocity"]) / velocity
        except (ValueError, ZeroDivisionError):  # refused by check_values(), or plates at rest
            return 0
        return begin if 0 < begin < sum(times) else 0

    def __getitem__(self, name):
        """The value of a setting, a number where possible."""
        return float(self.settings[name]) if is_number(self.settings[name]) else self.settings[name]


def cell_values(column, cell, config):
    """The values in a cell: words, or several words in quotes. 1-3 in the column seed stands for 1, 2 and 3, or as many as config has."""
    values = []
    for word in shlex.split(cell):
        seeds = re.fullmatch(r"(\d+)-(\d+)", word) if column == "seed" else None
        if not seeds:
            values.append(word)
            continue
        first, last = int(seeds[1]), int(seeds[2])
        if last < first:
            raise TableError(f"seed '{word}', expected the smaller one first")
        values += [str(n) for n in range(first, first + int(config["seeds"]) if config.get("seeds") else last + 1)]
    return values or [""]


def settings_of(row, config):
    """Variables of fault.in or options of slider_cli: every column that is not reserved, and the words of `settings`."""
    pairs = {key: value for key, value in row.items() if value and key not in RESERVED}
    for word in shlex.split(row.get("settings", "")):
        key, equals, value = word.partition("=")
        if not (key and equals and value):
            raise TableError(f"settings '{word}', expected NAME=VALUE")
        if key in pairs or key in RESERVED:
            raise TableError(f"settings '{word}', but " + (f"there is {key}={pairs[key]} already" if key in pairs else f"{key} is a column"))
        pairs[key] = value
    if row["program"] == "catalogue":
        return pairs
    shorten = shorten_of(config)
    if shorten != 1 and not {"steps", "time"} & pairs.keys():
        raise TableError(f"shorten={shorten:g}, but the line has neither steps nor time")
    for key in ("steps", "time"):
        if key in pairs:
            if not is_number(pairs[key], 0):
                raise TableError(f"{key} '{pairs[key]}', expected a number above 0")
            value = float(pairs[key]) / shorten
            pairs[key] = f"{value:.0f}" if key == "steps" else f"{value:.15g}"
    return pairs


def runs_of_row(row, config):
    """A Run for each combination of the values of one line."""
    if row["program"] not in PROGRAMS:
        *others, last = PROGRAMS
        raise TableError(f"program '{row['program']}', expected {', '.join(others)} or {last}")
    columns = [key for key in row if key not in ("run", "settings")]
    for values in itertools.product(*(cell_values(key, row[key], config) for key in columns)):
        one = dict(zip(columns, values), settings=row.get("settings", ""))
        own = [f"{key}-{one[key]}" for key in columns if one[key] and key not in RESERVED] + shlex.split(one["settings"])
        try:
            name = row["run"].format(**one) if row.get("run") else "_".join([one["program"]] + [re.sub(r"[=\s]+", "-", word) for word in own])
        except (AttributeError, KeyError, ValueError, IndexError) as error:
            raise TableError(f"run '{row['run']}', expected a name with columns in braces (not {error})")
        here = Path(config["table"]).resolve().parent
        if one.get("file"):
            one["file"] = str(here / one["file"].format(**one))
        one = {key: value.replace("{here}", str(here)) for key, value in one.items()}
        if not re.fullmatch(r"\w[\w.+-]*", name, re.ASCII):
            raise TableError(f"run '{name}', expected letters, digits, '.', '_', '+' and '-'")
        yield Run(name, one, config)


def read_runs(path, config):
    """All runs of a table by name. \\raises TableError naming file and line"""
    config = dict(config, table=path)
    lines = [(n, line) for n, line in enumerate(text_of(path, "a table of runs").splitlines(), 1) if line.strip(", \t") and line[0] != "#"]
    if not lines:
        raise TableError(f"{path}: empty, expected a table of runs")
    header, runs = [name.strip() for name in next(csv.reader([lines[0][1]]))], {}
    other = [name for mark, name in ((";", "semicolons"), ("\t", "tabs")) if mark in lines[0][1]]
    separated = f", and commas in place of {other[0]}" if other else ""
    for wrong, said in ((len(set(header)) < len(header), f"column '{max(header, key=header.count)}' twice, expected once"),
                        ("" in header, "a column without a name, expected one"), ("program"
                                                                                  not in header, "no column 'program', expected one" + separated)):
        if wrong:
            raise TableError(f"{path}:{lines[0][0]}: {said}")
    for number, line in lines[1:]:
        try:
            cells = next(csv.reader([line], strict=True))
            if len(cells) != len(header):
                raise TableError(f"{len(cells)} cells, expected {len(header)} as in the first line")
            for run in runs_of_row({key: cell.strip() for key, cell in zip(header, cells)}, config):
                if run.name in runs:
                    raise TableError(f"there is a run '{run.name}' already, expected another name")
                run.place = f"{path}:{number}"
                runs[run.name] = run
        except (TableError, ValueError, csv.Error) as error:
            raise TableError(f"{path}:{number}: {error}")
    wanted = {name: run for name, run in runs.items() if pattern(config.get("only"), "only").search(name)}
    if not wanted:
        raise TableError(f"{path}: no run" + (f" whose name matches '{config['only']}'" if config.get("only") else ", expected one at least"))
    return wanted


def text(value):
    """A number in a table; nothing for one that is missing."""
    return "" if value is None or value != value else f"{value:.6g}" if isinstance(value, float) else value


class Study:

    def __init__(self, config):
        table = Path(config["table"])
        self.binaries, self.shorten = config["bin"], shorten_of(config)
        self.runs = read_runs(table, config)
        self.known = {program: self.known_to(program) for program in {run.program for run in self.runs.values()}}
        own = table.with_suffix(".py")
        self.recipe = Recipe(own if own.exists() else Path(__file__).with_name("default.py"))
        some = next(iter(self.runs.values()))
        # What a recipe makes is known before the numbers are, so that all of it is looked at.
        self.stacks, self.drawings = list(self.recipe("stacks", some, self.nothing(some))), list(self.recipe("drawings"))
        self.figures, self.pages = self.recipe("figures", self), self.recipe("pages", self)
        self.tables = [name for name in ("table", "costs") if self.recipe(name, some, self.nothing(some))]
        both = [name + end for part in ("means", "differences") for name in self.recipe(part, some, self.nothing(some)) for end in ("", "_error")]
        twice = [name for name in both if both.count(name) > 1]
        if twice:
            raise TableError(f"{self.recipe.path}: means and differences: '{twice[0]}' twice in differences.csv, expected it once")
        self.tables += ["differences"] * bool(both)
        for part, key in ("figures", "command"), ("pages", "title"):
            for name, one in getattr(self, part).items():
                pattern(one.get("runs"), f"{self.recipe.path}: {part}: {name}: runs")
                if key not in one:
                    raise TableError(f"{self.recipe.path}: {part}: {name}: expected a {key}")
        taken = {Path(name).parts[0] for name in self.results()} | {"slurm"}
        for run in self.runs.values():
            if run.name in taken:
                raise TableError(f"{run.place}: run '{run.name}', expected another name, as results have this one")
            if run.program == "catalogue" and not Path(run.settings.get("file", "")).is_file():
                raise TableError(f"{run.place}: {run.settings.get('file', 'nothing')}: no such catalogue, expected one in the column 'file'")
            for part in ("table", "costs", "means", "differences", "stacks"):
                self.recipe(part, run, self.nothing(run))
            for one in self.pages.values():
                self.begin(one, run), self.label(one, run)

    def known_to(self, program):
        """Names of the settings that a program has; none for existing catalogues."""
        try:
            return PROGRAMS[program].known(self.binaries) if PROGRAMS[program].known else set()
        except (OSError, subprocess.CalledProcessError) as error:
            raise TableError(f"cannot ask program {program} in {self.binaries} for its options ({error})")

    def check(self):
        """\\raises TableError for names that the programs do not have, and for runs that were started with other settings"""
        for run in self.runs.values():
            kind, place = PROGRAMS[run.program], run.place
            for name in run.settings if kind.known else ():
                if name in kind.OWN:
                    raise TableError(f"{place}: '{name}' is set by the study, expected no such column or setting")
                if name not in self.known[run.program]:
                    raise TableError(f"{place}: '{name}', which program {run.program} does not have{meant(name, self.known[run.program] - kind.OWN)}")
            folder = Path(run.name).resolve()
            otherwise = begun_otherwise(folder, [f"program={run.program}", *run.words])
            if not otherwise and run.ranks_given and (folder / "done.json").exists():
                had = read_json(folder / "done.json").get("ranks", run.ranks)
                otherwise = had != run.ranks and f"{folder} was run on {had} ranks, expected {run.ranks}; move it away, or give no ranks"
            if otherwise:
                raise TableError(f"{place}: {otherwise}")
            self.numbers(run)

    def check_values(self):
        """\\raises TableError for values that no fault may have, by fault.variables and the friction law; begun runs are not asked again"""
        names, script = {one.name for one in declared()}, "atom_style bond\n"  # other variables are of scenes for `extra`
        asked = [run for run in self.runs.values() if run.program == "fault" and not Path(run.name, "settings.txt").exists()]
        for run in asked:
            given = {name: value for name, value in run.settings.items() if name in names}
            script += f"print 'run {run.name}'\n" + "".join(f"variable {name} delete\n" for name in names)
            script += "".join(f'variable {name} index """{value}"""\n' for name, value in given.items())
            script += "lsm_variables fault.variables\npair_style lsm/friction ${law}\n"
        if not asked:
            return
        done = subprocess.run([f"{self.binaries}/lmp", "-log", "none"], cwd=INPUTS, input=script, capture_output=True, text=True,
                              env={**os.environ, **MPI})
        said = re.search(r"^ERROR: (.*?)( \(\S+:\d+\))?$", done.stdout, re.M)
        if done.returncode and said:
            run = self.runs[re.findall(r"^run (.*)", done.stdout[:said.start()], re.M)[-1]]
            raise TableError(f"{run.place}: run '{run.name}': {said[1]}")

    def check_programs(self):
        """\\raises TableError if runs need ESyS-Particle and it is not installed"""
        needing = [run.name for run in self.runs.values() if run.program == "esys"]
        if needing and not shutil.which("esysparticle"):
            raise TableError(f"run {needing[0]} needs ESyS-Particle, no program esysparticle was found (Debian package esys-particle)")

    def matching(self, pattern):
        return [run for name, run in self.runs.items() if re.search(pattern or "", name)]

    def reference(self, run):
        """The run with which this one is compared, or None."""
        text = self.recipe("reference") or ""
        try:
            name = text.format(**run.row)
        except (AttributeError, KeyError, ValueError, IndexError) as error:
            raise TableError(f"reference '{text}', expected the name of a run with columns in braces (not {error})")
        return self.runs.get(name) if name != run.name else None

    def numbers(self, run):
        """Commands for a run by name, see program()."""
        commands, other = self.recipe("numbers", run), self.reference(run)
        if other:
            commands = {**commands, **self.recipe("comparisons", run, other.catalogue)}
        return {name: self.program(re.sub(r"(?<!\S)OUT(?![\w/-])", f"{run.name}/numbers/{name}", command)) for name, command in commands.items()}

    def label(self, one, run):
        """Name of the curve of a run. Some commands take runs with the same label as samples of one model."""
        return self.recipe.asked("label", one["label"], run) if "label" in one else run.name.replace("_", " ")

    def begin(self, one, run):
        """The time from which on a page has the events of a run."""
        return f"{self.recipe.asked('begin', one['begin'], run) if 'begin' in one else 0:.15g}"

    def program(self, command):
        """A command for the shell: of postproc, a script of results (NAME.py), or a program of the Python module lsm (lsm.NAME)."""
        python = shlex.quote(sys.executable)
        if command.split()[0].endswith(".py"):
            return f"{python} {shlex.quote(str(INPUTS.parent / 'results'))}/{command}"
        if command.startswith("lsm."):
            return f"PYTHONPATH={shlex.quote(str(INPUTS.parent / 'python'))}:${{PYTHONPATH:-}} {python} -m {command}"
        return f"{next(iter(self.runs.values())).postproc} {command} --overwrite"

    def nothing(self, run):
        """What a run of which nothing is known yet has: names without numbers."""
        names = ["done", "summary", *self.recipe("numbers", run), *self.recipe("comparisons", run, "")]
        return Numbers({name: Missing() for name in names})

    def found(self, run):
        """All numbers of a run; of one that failed, why."""
        found = self.nothing(run)
        if run.failed:
            found["done"] = Found(failed=run.failed)
            return found
        found.update({
            name: read_json(path)
            for name in found for path in (Path(run.name, f"{name}.json"), Path(run.name, "numbers", f"{name}.json")) if path.exists()
        })
        return found

    def row(self, part, run):
        """The numbers of a run in a part of the recipe by column."""
        return self.recipe(part, run, self.found(run))

    def shown(self, part, run):
        """The numbers as tables show them; NaN for one that is missing."""
        return {name: float("nan" if text(one) == "" else text(one)) for name, one in self.row(part, run).items()}

    def done(self):
        """The runs but those that failed."""
        return [run for run in self.runs.values() if not run.failed]

    def failures(self):
        """Names of the runs that failed, with the reason."""
        return [f"{run.name}: {run.failed}" for run in self.runs.values() if run.failed]

    def columns(self):
        return list(dict.fromkeys(key for run in self.runs.values() for key in run.row if key not in ("run", "program", "ranks")))

    def start(self, run):
        """Name and settings of a run, column by column; steps and times are those after `shorten`, none of one that failed."""
        lasting = ("steps", "time") if run.failed else ()
        others = " ".join(f"{key}={shlex.quote(value)}" for key, value in run.settings.items() if key not in run.row)
        return [run.name] + [
            "" if key in lasting else others if key == "settings" else run.settings.get(key, run.row.get(key, "")) for key in self.columns()
        ]

    def asked(self, name):
        """All that a table depends on except the numbers of the runs: if it changes, the table is made again."""
        parts = ("means", "differences") if name == "differences" else ("stacks",) if name in self.stacks else (name,)
        return json.dumps([self.shorten, *map(self.recipe.text, parts), self.columns(), [self.start(run) for run in self.runs.values()]])

    def table(self, name):
        """One line for each run, with the columns in part `name` of the recipe."""
        rows = [self.row(name, run) for run in self.runs.values()]
        empty = [column for column in rows[0] if not any(text(row[column]) != "" for row in rows)]
        if empty:
            why = {column: next((f" ({row[column].why})" for row in rows if getattr(row[column], "why", "")), "") for column in empty}
            where = "" if all(why.values()) else "; the reasons are in RUN/numbers"
            print(f"{name}.csv: empty for all runs: {', '.join(column + why[column] for column in empty)}{where}", file=sys.stderr)
        return [["run", *self.columns(), *rows[0]]] + [self.start(run) + list(map(text, row.values())) for run, row in zip(self.runs.values(), rows)]

    def stack(self, name):
        """One line for each row of a table that each run has."""
        rows = [(run, row) for run in self.done() for row in self.row("stacks", run)[name]]
        lines = [self.start(run) + ["" if isinstance(value, Missing) else value for value in row.values()] for run, row in rows]
        return [["run", *self.columns(), *row] for _, row in rows[:1]] + lines

    def differences(self):
        """One line for all seeds of a model: means with errors of part `means`, and of the differences from the first model, seed by seed."""
        columns = [column for column in self.columns() if column != "seed"]
        groups, values = {}, {run.name: [self.shown("means", run), self.shown("differences", run)] for run in self.done()}
        for run in self.done():
            groups.setdefault(tuple(run.row.get(column, "") for column in columns), []).append(run)
        runs = list(self.runs.values())
        first = groups.get(tuple(runs[0].row.get(column, "") for column in columns), [])
        first = {run.row.get("seed"): values[run.name][1] for run in first}
        means, differences = (self.recipe(part, runs[0], self.nothing(runs[0])) for part in ("means", "differences"))
        lines = [columns + ["seeds"] + [name + end for name in (*means, *differences) for end in ("", "_error")]]
        for key, runs in groups.items():
            numbers = [[values[run.name][0][name] for run in runs] for name in means]
            numbers += [[values[run.name][1][name] - first[run.row.get("seed")][name] for run in runs if run.row.get("seed") in first]
                        for name in differences]
            lines.append([*key, len(runs), *(text(float(one)) for some in numbers for one in mean_and_error(some))])
        return lines

    def write(self, name, path):
        made = self.stack(name) if name in self.stacks else self.differences() if name == "differences" else self.table(name)
        out = io.StringIO()
        csv.writer(out, lineterminator="\n").writerows(made)
        replace(Path(path), out.getvalue())

    def results(self):
        """The files that a study makes for its reader."""
        figures = [f"figures/{name}.png" for name, one in self.figures.items() if self.matching(one.get("runs"))]
        pages = [f"{name}.html" for name, one in self.pages.items() if self.matching(one.get("runs"))]
        return [f"{name}.csv" for name in self.tables + self.stacks] + figures + pages + [f"{name}.png" for name in self.drawings]

    def numbers_of_all(self):
        return [f"{run.name}/numbers/{name}.json" for run in self.runs.values() for name in self.numbers(run)]


if __name__ == "__main__":
    Study(json.loads(sys.argv[1])).write(*sys.argv[2:])
