# SPDX-License-Identifier: GPL-2.0-or-later
"""A study: its table of runs (NAME.csv) and its recipe (NAME.yaml beside it, or default.yaml)."""
import csv
import itertools
import json
import math
import re
import shlex
import shutil
from pathlib import Path

import yaml

INPUTS = Path(__file__).resolve().parent.parent
PROGRAMS = ("fault", "slider", "esys", "catalogue")  # esys: a fault by ESyS-Particle; catalogue: an existing one, see `file`
RESERVED = ("run", "program", "ranks", "settings")
# what an expression raises if a run lacks its numbers
MISSING = (AttributeError, IndexError, KeyError, NameError, TypeError, ValueError, ZeroDivisionError)


class TableError(Exception):
    pass


class Found(dict):
    """Numbers of JSON files, accessible as a.b[0].c."""

    def __getattr__(self, name):
        return self[name]


def read_json(path):
    return json.loads(Path(path).read_text(), object_hook=Found)


class Run:
    def __init__(self, name, row, config):
        self.name, self.row, self.program = name, row, row["program"]
        self.settings = settings_of(row, config)
        ranks = row.get("ranks") or config.get("ranks")
        length = float(self.settings.get("length", 120)) if self.program == "fault" else 0
        self.ranks = int(ranks) if ranks else max(1, int(length / 60))
        if self.program == "esys":
            self.ranks = 2  # one process computes, one directs it
        self.words = [f"{key}={value}" for key, value in self.settings.items()]
        self.catalogue = f"{name}/" + ("catalogue.csv" if self.program in ("slider", "catalogue") else "fault.catalogue.csv")

    def values(self):
        """Settings, as numbers where possible."""
        values = dict(run=self.name, folder=self.name, catalogue=self.catalogue)
        for key, value in self.settings.items():
            try:
                values[key.replace("-", "_")] = float(value)
            except ValueError:
                values[key.replace("-", "_")] = value
        return values


def cell_values(column, cell, config):
    """The values of a cell: words, or several words in quotes; 1-3 in the column seed are 1, 2 and 3, or as many as the config says."""
    values = []
    for word in shlex.split(cell):
        seeds = re.fullmatch(r"(\d+)-(\d+)", word) if column == "seed" else None
        last = seeds and int(config.get("seeds") or seeds[2])
        values += [str(n) for n in range(int(seeds[1]), last + 1)] if seeds else [word]
    return values or [""]


def settings_of(row, config):
    """Variables of fault.in or options of slider_cli: every column that is not reserved, and the words of `settings`."""
    pairs = {key: value for key, value in row.items() if value and key not in RESERVED}
    for word in shlex.split(row.get("settings", "")):
        key, equals, value = word.partition("=")
        if not (key and equals and value):
            raise TableError(f"settings '{word}', expected NAME=VALUE")
        pairs[key] = value
    for key in ("steps", "time"):
        if key in pairs:
            value = float(pairs[key]) / float(config.get("shorten") or 1)
            pairs[key] = f"{value:.0f}" if key == "steps" else f"{value:g}"
    return pairs


def runs_of_row(row, config):
    """A Run for each combination of the values of one line."""
    if row["program"] not in PROGRAMS:
        raise TableError(f"program '{row['program']}', expected {', '.join(PROGRAMS[:-1])} or {PROGRAMS[-1]}")
    columns = [key for key in row if key not in ("run", "settings")]
    for values in itertools.product(*(cell_values(key, row[key], config) for key in columns)):
        one = dict(zip(columns, values), settings=row.get("settings", ""))
        own = [f"{key}-{one[key]}" for key in columns if one[key] and key not in RESERVED] + shlex.split(one["settings"])
        try:
            name = row["run"].format(**one) if row.get("run") else "_".join([one["program"]] + [re.sub(r"[=\s]+", "-", word) for word in own])
        except (KeyError, ValueError, IndexError) as error:
            raise TableError(f"run '{row['run']}', expected a name with columns in braces (not {error})")
        if one.get("file"):
            one["file"] = one["file"].format(**one)
        if not re.fullmatch(r"\w[\w.+-]*", name):
            raise TableError(f"run '{name}', expected letters, digits, '.', '_', '+' and '-'")
        yield Run(name, one, config)


def read_runs(path, config):
    """All runs of a table by name. \\raises TableError naming file and line"""
    try:
        lines = [(n, line) for n, line in enumerate(Path(path).read_text().splitlines(), 1) if line.strip() and line[0] != "#"]
    except OSError as error:
        raise TableError(f"cannot read {path}, expected a table of runs ({error.strerror})")
    if not lines:
        raise TableError(f"{path}: empty, expected a table of runs")
    header, runs = [name.strip() for name in next(csv.reader([lines[0][1]]))], {}
    if "program" not in header:
        raise TableError(f"{path}:{lines[0][0]}: no column 'program', expected one")
    for number, line in lines[1:]:
        cells = next(csv.reader([line]))
        try:
            if len(cells) != len(header):
                raise TableError(f"{len(cells)} cells, expected {len(header)} as in the first line")
            for run in runs_of_row({key: cell.strip() for key, cell in zip(header, cells)}, config):
                if run.name in runs:
                    raise TableError(f"there is a run '{run.name}' already, expected another name")
                runs[run.name] = run
        except (TableError, ValueError) as error:
            raise TableError(f"{path}:{number}: {error}")
    wanted = {name: run for name, run in runs.items() if re.search(str(config.get("only") or ""), name)}
    if not wanted:
        raise TableError(f"{path}: no run whose name matches '{config.get('only')}'")
    return wanted


def mean_and_error(numbers):
    """Mean and its standard error as text, empty where there is none; numbers that are missing (NaN) do not count."""
    there = [number for number in numbers if not math.isnan(number)]
    if not there:
        return ["", ""]
    mean = math.fsum(there) / len(there)
    if len(there) < 2:
        return [f"{mean:.6g}", ""]
    return [f"{mean:.6g}", f"{math.sqrt(math.fsum((x - mean) ** 2 for x in there) / (len(there) - 1) / len(there)):.6g}"]


class Study:
    def __init__(self, config):
        table = Path(config["table"])
        self.runs = read_runs(table, config)
        recipe = table.with_suffix(".yaml")
        default = Path(__file__).with_name("default.yaml")
        self.recipe = yaml.safe_load((recipe if recipe.exists() else default).read_text())
        if "like" in self.recipe:
            self.recipe = yaml.safe_load(default.with_name(self.recipe["like"] + ".yaml").read_text())
        self.common = dict(math.__dict__, postproc=f"{config['bin']}/postproc", inputs=str(INPUTS), shorten=float(config.get("shorten") or 1))

    def part(self, name):
        return self.recipe.get(name) or {}

    def check_programs(self):
        """\\raises TableError where the runs need ESyS-Particle, and it is not installed"""
        needing = [run.name for run in self.runs.values() if run.program == "esys"]
        if needing and not shutil.which("esysparticle"):
            raise TableError(f"run {needing[0]} needs ESyS-Particle, no program esysparticle was found (Debian package esys-particle)")

    def matching(self, pattern):
        return [run for name, run in self.runs.items() if re.search(pattern or "", name)]

    def names(self, values):
        """Names for expressions: functions of math, `shorten`, these values, and the part `values` of the recipe."""
        names = dict(self.common, **values)
        for key, expression in self.part("values").items():
            try:
                names[key] = eval(expression, dict(names))
            except MISSING:
                continue
        return names

    def fill(self, text, values):
        """The text with the expressions in braces evaluated."""
        names = self.names(values)

        def computed(braces):
            value = eval(braces[1], dict(names))
            return value if isinstance(value, str) else f"{value:.15g}"
        return re.sub(r"\{([^{}]+)\}", computed, text)

    def reference(self, run):
        """The run with which this one is compared, or None."""
        name = self.recipe.get("reference", "").format(**run.row)
        return self.runs.get(name) if name != run.name else None

    def numbers(self, run):
        """Names and commands of postproc for a run."""
        commands = dict(self.part("numbers"))
        if self.reference(run):
            commands.update(self.part("comparisons"))
        return commands

    def label(self, recipe, run):
        """Name of the curve of a run; runs of one label are samples of one model where a command says so."""
        return str(eval(recipe["label"], self.names(run.values()))) if "label" in recipe else run.name.replace("_", " ")

    def command(self, run, name):
        other = self.reference(run)
        values = dict(run.values(), out=f"{run.name}/numbers/{name}", reference=other.catalogue if other else "")
        return self.fill(self.numbers(run)[name], values)

    def found(self, run):
        """All numbers of a run, by the names of its commands."""
        found = self.names(run.values())
        for path in [f"{run.name}/done.json", f"{run.name}/summary.json", *(f"{run.name}/numbers/{name}.json" for name in self.numbers(run))]:
            if Path(path).exists():
                found[Path(path).stem] = read_json(path)
        return found

    def row(self, run, expressions):
        """The values of the expressions, empty where something is missing."""
        found, values = self.found(run), []
        for expression in expressions:
            try:
                value = eval(expression, dict(found))
            except MISSING:
                value = None
            values.append("" if value is None else f"{value:.6g}" if isinstance(value, float) else value)
        return values

    def columns(self):
        return list(dict.fromkeys(key for run in self.runs.values() for key in run.row if key not in ("run", "program", "ranks")))

    def start(self, run):
        return [run.name] + [run.row.get(key, "") for key in self.columns()]

    def write_table(self, name, path):
        """One line for each run, with the columns that part `name` of the recipe has."""
        part = self.part(name)
        with open(path, "w", newline="") as file:
            out = csv.writer(file, lineterminator="\n")
            out.writerow(["run", *self.columns(), *part])
            for run in self.runs.values():
                out.writerow(self.start(run) + self.row(run, part.values()))

    def write_stack(self, expression, path):
        """One line for each row of a table that each run has."""
        head = None
        with open(path, "w", newline="") as file:
            out = csv.writer(file, lineterminator="\n")
            for run in self.runs.values():
                try:
                    rows = eval(expression, dict(self.found(run)))
                except MISSING:
                    continue
                for row in rows:
                    if head is None:
                        head = ["run", *self.columns(), *row]
                        out.writerow(head)
                    out.writerow(self.start(run) + ["" if value is None else value for value in row.values()])

    def write_differences(self, path):
        """One line for all seeds: part `means`, and means with errors of what differs from the run of the same seed in the first."""
        means, differences, groups, values = self.part("means"), self.part("differences"), {}, {}
        for run in self.runs.values():
            key = tuple(run.row.get(column, "") for column in self.columns() if column != "seed")
            groups.setdefault(key, []).append(run)
            row = self.row(run, [*means.values(), *differences.values()])
            values[run.name] = [float(value) if value != "" else math.nan for value in row]
        first = {run.row.get("seed"): values[run.name] for run in next(iter(groups.values()))}
        with open(path, "w", newline="") as file:
            out = csv.writer(file, lineterminator="\n")
            out.writerow([c for c in self.columns() if c != "seed"] + ["seeds", *means]
                         + [f"{name}{end}" for name in differences for end in ("", "_error")])
            for key, runs in groups.items():
                line = [*key, len(runs)]
                for k in range(len(means)):
                    line += mean_and_error([values[run.name][k] for run in runs])[:1]
                for k in range(len(means), len(means) + len(differences)):
                    line += mean_and_error([values[run.name][k] - first[run.row.get("seed")][k] for run in runs if run.row.get("seed") in first])
                out.writerow(line)

    def results(self):
        """The files that a study makes."""
        figures = [f"figures/{name}.png" for name, one in self.part("figures").items() if self.matching(one.get("runs"))]
        pages = [f"{name}.html" for name, one in self.part("pages").items() if self.matching(one.get("runs"))]
        tables = [f"{name}.csv" for name in ("table", "costs", "differences") if self.part(name)]
        return tables + [f"{name}.csv" for name in self.part("stacks")] + figures + pages + [f"{name}.png" for name in self.recipe.get("drawings", [])]
