# SPDX-License-Identifier: GPL-2.0-or-later
"""A study: its table of runs (NAME.csv) and its recipe (NAME.py beside it, or default.py).

study_tables.py CONFIG NAME OUT.csv    writes one of its tables: table, costs, or one of `tables` of the recipe
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
from recipes import Found, Missing, Recipe, RecipeError, cell, meant, read_json  # noqa: E402
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
        text = "" if value is None else str(value)
        if name not in (*known, "table", "bin"):
            raise TableError(f"'{name}={value}', expected one of {', '.join(known)}")
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


def pattern(text, where):
    """Compiles a regular expression. \\raises TableError if it is not valid"""
    try:
        return re.compile("" if text is None else str(text))
    except re.error as error:
        raise TableError(f"{where} '{text}', expected a regular expression ({error})")


# ---- the table of runs


class Run:

    def __init__(self, name, row, config):
        self.name = self.folder = name
        self.row, self.program, self.settings = row, row["program"], settings_of(row, config)
        self.shorten, self.postproc = float(config.get("shorten") or 1), shlex.quote(f"{config.get('bin')}/postproc")
        on_ranks = PROGRAMS[self.program].on_ranks
        given = row.get("ranks") or (config.get("ranks") if on_ranks else "")
        if row.get("ranks") and not on_ranks:
            raise TableError(f"ranks '{given}' of program '{self.program}', expected them for faults only")
        if given and not re.fullmatch(r"[1-9]\d*", str(given)):
            raise TableError(f"ranks '{given}', expected a whole number above 0")
        # On fewer cores a fault gets fewer ranks, unless they are given. Of ESyS-Particle one process computes, one directs it.
        length = float(self.settings.get("length", 120)) if self.program == "fault" else 120 if self.program == "esys" else 0
        self.ranks_given, self.ranks = bool(given), int(given) if given else max(1, int(length / 60))
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
    for word in shlex.split(cell) or [""]:
        seeds = re.fullmatch(r"(\d+)-(\d+)", word) if column == "seed" else None
        first, last = map(int, seeds.groups()) if seeds else (0, 0)
        if last < first:
            raise TableError(f"seed '{word}', expected the smaller one first")
        yield from map(str, range(first, first + int(config["seeds"]) if config.get("seeds") else last + 1)) if seeds else [word]


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
    shorten, lasting = float(config.get("shorten") or 1), [key for key in ("steps", "time") if key in pairs]
    if shorten != 1 and not lasting:
        raise TableError(f"shorten={shorten:g}, but the line has neither steps nor time")
    for key in lasting:
        if not is_number(pairs[key], 0):
            raise TableError(f"{key} '{pairs[key]}', expected a number above 0")
        pairs[key] = f"{float(pairs[key]) / shorten:{'.0f' if key == 'steps' else '.15g'}}"
    return pairs


def runs_of_row(row, config):
    """A Run for each combination of the values of one line."""
    if row["program"] not in PROGRAMS:
        *others, last = PROGRAMS
        raise TableError(f"program '{row['program']}', expected {', '.join(others)} or {last}")
    columns, here = [key for key in row if key not in ("run", "settings")], Path(config["table"]).resolve().parent
    for values in itertools.product(*(cell_values(key, row[key], config) for key in columns)):
        one = dict(zip(columns, values), settings=row.get("settings", ""))
        own = [f"{key}-{one[key]}" for key in columns if one[key] and key not in RESERVED] + shlex.split(one["settings"])
        try:
            name = row["run"].format(**one) if row.get("run") else "_".join([one["program"]] + [re.sub(r"[=\s]+", "-", word) for word in own])
        except (AttributeError, KeyError, ValueError, IndexError) as error:
            raise TableError(f"run '{row['run']}', expected a name with columns in braces (not {error})")
        if not re.fullmatch(r"\w[\w.+-]*", name, re.ASCII):
            raise TableError(f"run '{name}', expected letters, digits, '.', '_', '+' and '-'")
        yield Run(name, {key: value.replace("{here}", str(here)) for key, value in one.items()}, config)


def checked_header(names):
    if len(set(names)) < len(names):
        raise TableError(f"column '{max(names, key=names.count)}' twice, expected once")
    if "" in names:
        raise TableError("a column without a name, expected one")
    if "program" not in names:
        raise TableError(f"no column 'program' in '{','.join(names)}', expected one, with commas between columns")
    return names


def read_runs(path, config):
    """All runs of a table by name. \\raises TableError naming file and line"""
    config, raw = dict(config, table=path), Path(path).read_bytes()
    try:
        lines = raw.decode("utf-8-sig").splitlines(keepends=True)
    except UnicodeDecodeError as error:
        raise TableError(f"{path}:{raw[:error.start].count(10) + 1}: not UTF-8, expected a table of runs in UTF-8")
    cells = csv.reader(("\n" if line[0] == "#" or not line.strip(", \t\r\n") else line for line in lines), strict=True)
    header, runs = None, {}
    try:
        for row in ([cell.strip() for cell in row] for row in cells if row):
            if not header:
                header = checked_header(row)
                continue
            if len(row) != len(header):
                raise TableError(f"{len(row)} cells, expected {len(header)} as in the first line")
            for run in runs_of_row(dict(zip(header, row)), config):
                if run.name in runs:
                    raise TableError(f"there is a run '{run.name}' already, expected another name")
                run.place = f"{path}:{cells.line_num}"
                runs[run.name] = run
    except (TableError, ValueError, csv.Error) as error:
        raise TableError(f"{path}:{cells.line_num}: {error}")
    if not header:
        raise TableError(f"{path}: empty, expected a table of runs")
    wanted = {name: run for name, run in runs.items() if pattern(config.get("only"), "only").search(name)}
    if not wanted:
        raise TableError(f"{path}: no run" + (f" whose name matches '{config['only']}'" if config.get("only") else ", expected one at least"))
    return wanted


# ---- the study


class Study:

    def __init__(self, config):
        table = Path(config["table"])
        self.binaries, self.runs = config["bin"], read_runs(table, config)
        some = list(self.runs.values())
        self.shorten, own = some[0].shorten, table.with_suffix(".py")
        self.recipe = Recipe(own if own.exists() else Path(__file__).with_name("default.py"))
        for run in some:
            run.reference = self.reference(run)
            commands = self.recipe("numbers", run) | (self.recipe("comparisons", run, run.reference.catalogue) if run.reference else {})
            run.commands = {name: self.program(re.sub(r"(?<!\S)OUT(?![\w/-])", f"{run.name}/numbers/{name}", command))
                            for name, command in commands.items()}  # yapf: disable
        # What a recipe makes is known before the numbers are, so that all of it is looked at.
        self.figures, self.pages, self.drawings = (self.recipe(part, self) for part in ("figures", "pages", "drawings"))
        rows = {part: [self.recipe(part, run, self.nothing(run)) for run in some] for part in ("table", "costs")}
        self.tables = [part for part in rows if rows[part][0]] + list(self.recipe.module.__dict__.get("tables", ()))
        for part, key in ("figures", "command"), ("pages", "title"):
            for name, one in getattr(self, part).items():
                pattern(one.get("runs"), f"{self.recipe.path}: {part}: {name}: runs")
                if key not in one:
                    raise TableError(f"{self.recipe.path}: {part}: {name}: expected a {key}")
                self.curves(one)
        taken = {Path(name).parts[0] for name in self.results()} | {"slurm"}
        for run in some:
            if run.name in taken:
                raise TableError(f"{run.place}: run '{run.name}', expected another name, as results have this one")

    def reference(self, run):
        """The run with which this one is compared, or None."""
        text = self.recipe("reference") or ""
        try:
            name = text.format(**run.row)
        except (AttributeError, KeyError, ValueError, IndexError) as error:
            raise TableError(f"reference '{text}', expected the name of a run with columns in braces (not {error})")
        return self.runs.get(name) if name != run.name else None

    def program(self, command):
        """A command for the shell: of postproc, a script of results (NAME.py), or a program of the Python module lsm (lsm.NAME)."""
        python = shlex.quote(sys.executable)
        if command.split()[0].endswith(".py"):
            return f"{python} {shlex.quote(str(INPUTS.parent / 'results'))}/{command}"
        if command.startswith("lsm."):
            return f"PYTHONPATH={shlex.quote(str(INPUTS.parent / 'python'))}:${{PYTHONPATH:-}} {python} -m {command}"
        return f"{next(iter(self.runs.values())).postproc} {command} --overwrite"

    # ---- what is refused before anything is started

    def check(self):
        """\\raises TableError for names that the programs do not have, and for runs that were started with other settings"""
        known = {program: self.known_to(PROGRAMS[program]) for program in {run.program for run in self.runs.values()}}
        for run in self.runs.values():
            kind, folder = PROGRAMS[run.program], Path(run.name).resolve()
            for name in run.settings:
                if name in kind.OWN:
                    raise TableError(f"{run.place}: '{name}' is set by the study, expected no such column or setting")
                if name not in known[run.program]:
                    raise TableError(f"{run.place}: '{name}', which program {run.program} does not have{meant(name, known[run.program] - kind.OWN)}")
            otherwise = begun_otherwise(folder, [f"program={run.program}", *run.words])
            if not otherwise and run.ranks_given and (folder / "done.json").exists():
                had = read_json(folder / "done.json").get("ranks", run.ranks)
                otherwise = had != run.ranks and f"{folder} was run on {had} ranks, expected {run.ranks}; move it away, or give no ranks"
            if otherwise:
                raise TableError(f"{run.place}: {otherwise}")

    def known_to(self, kind):
        """Names of the settings that a program has."""
        try:
            return kind.known(self.binaries)
        except (OSError, subprocess.CalledProcessError) as error:
            raise TableError(f"cannot ask the programs in {self.binaries} for their options ({error})")

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

    # ---- what is made

    def matching(self, pattern):
        return [run for name, run in self.runs.items() if re.search(pattern or "", name)]

    def curves(self, one):
        """Of a figure or page: the catalogues, names of the curves, and times from which on a page has their events."""
        runs = [run for run in self.matching(one.get("runs")) if not run.failed]
        labels = [self.recipe.asked("label", one["label"], run) if "label" in one else run.name.replace("_", " ") for run in runs]
        begins = [f"--from={self.recipe.asked('begin', one['begin'], run):.15g}" for run in runs if "begin" in one]
        return dict(catalogues=[run.catalogue for run in runs], labels=[f"--label={label}" for label in labels] + begins)

    def results(self):
        """The files that a study makes for its reader."""
        drawn = [form.format(name) for form, some in (("figures/{}.png", self.figures), ("{}.html", self.pages)) for name, one in some.items()
                 if self.matching(one.get("runs"))]  # yapf: disable
        return [f"{name}.csv" for name in self.tables] + drawn + [f"{name}.png" for name in self.drawings]

    def numbers_of_all(self):
        return [f"{run.name}/numbers/{name}.json" for run in self.runs.values() for name in run.commands]

    def nothing(self, run):
        """What a run of which nothing is known yet has: names without numbers."""
        return Found(dict.fromkeys(("done", "summary", *self.recipe("numbers", run), *self.recipe("comparisons", run, "")), Missing()))

    def found(self, run):
        """All numbers of a run; of one that failed, why."""
        nothing = self.nothing(run)
        if run.failed:
            return Found(nothing | {"done": Found(failed=run.failed)})
        paths = [(name, Path(run.name, folder, f"{name}.json")) for name in nothing for folder in ("", "numbers")]
        return Found(nothing | {name: read_json(path) for name, path in paths if path.exists()})

    def done(self):
        """The runs but those that failed."""
        return [run for run in self.runs.values() if not run.failed]

    def columns(self):
        return list(dict.fromkeys(key for run in self.runs.values() for key in run.row if key not in ("run", "program", "ranks")))

    def start(self, run):
        """Name and settings of a run by column; steps and times are those after `shorten`, none of one that failed."""
        others = " ".join(f"{key}={shlex.quote(value)}" for key, value in run.settings.items() if key not in run.row)
        row = {key: others if key == "settings" else run.settings.get(key, run.row.get(key, "")) for key in self.columns()}
        return {"run": run.name} | row | {key: "" for key in ("steps", "time") if run.failed and key in row}

    def asked(self):
        """All that tables depend on except the numbers of the runs: if it changes, they are made again."""
        return json.dumps([self.shorten, [Path(file).read_text() for file in self.recipe.files], [self.start(run) for run in self.runs.values()]])

    def table(self, part):
        """One line for each run, with the columns in a part of the recipe."""
        rows = [self.recipe(part, run, self.found(run)) for run in self.runs.values()]
        rows = [{column: cell(value) for column, value in row.items()} for row in rows]
        if empty := [column for column in rows[0] if all(row[column] == "" for row in rows)]:
            print(f"{part}.csv: empty for all runs: {', '.join(empty)}; the reasons are in RUN/numbers", file=sys.stderr)
        return [self.start(run) | row for run, row in zip(self.runs.values(), rows)]

    def write(self, name, path):
        rows = self.table(name) if name in ("table", "costs") else list(self.recipe.asked(name, self.recipe("tables")[name], self))
        out = io.StringIO()
        table = csv.writer(out, lineterminator="\n")
        table.writerows([list(row) for row in rows[:1]] + [["" if value != value else value for value in row.values()] for row in rows])
        replace(Path(path), out.getvalue())


if __name__ == "__main__":
    try:
        Study(json.loads(sys.argv[1])).write(*sys.argv[2:])
    except RecipeError as error:
        sys.exit(f"study_tables.py: {error}")
