# SPDX-License-Identifier: GPL-2.0-or-later
"""Recipes of studies: NAME.py beside the table NAME.csv, or default.py; studies.md explains their parts. And the numbers that they read:
those of JSON files as a.b[0].c, where what could not be determined has no value, and no sum or ratio made of it has one."""
import difflib
import inspect
import json
import math
import sys
import traceback
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path

from lsm.analysis import mean_and_error

sys.dont_write_bytecode = True  # of recipes, which may change more than once in a second
PARTS = ("reference", "numbers", "comparisons", "table", "costs", "tables", "figures", "pages", "drawings")


class RecipeError(Exception):
    pass


class Missing(float):
    """What a run does not have; so is all that belongs to it."""

    def __new__(cls, *_):
        return super().__new__(cls, "nan")

    def __getattr__(self, name):
        if name.startswith("__"):
            raise AttributeError(name)
        return self

    def __getitem__(self, _):
        return self

    def __call__(self, *_):
        return self

    def __iter__(self):
        return iter(())

    def __bool__(self):
        return False


class List(list):

    def __getitem__(self, n):
        return super().__getitem__(n) if isinstance(n, slice) or -len(self) <= n < len(self) else Missing()


class Found(dict):
    """An object of a JSON file. Where a command determined nothing it has `why` in place of numbers, and a run that failed `failed`."""

    def __getattr__(self, name):
        if name in self:
            return self[name]
        if name.startswith("__") or not {"why", "failed"} & self.keys():
            raise AttributeError(f"nothing is called '{name}'{meant(name, self)}, expected one of {', '.join(self)}")
        return Missing()


def found(value):
    """The value of a JSON file, so that missing ones can be asked for."""
    if isinstance(value, dict):
        return Found({key: found(one) for key, one in value.items()})
    return List(map(found, value)) if isinstance(value, list) else Missing() if value is None else value


def read_json(path):
    return found(json.loads(Path(path).read_text()))


def meant(name, known):
    close = difflib.get_close_matches(name, known, 1)
    return f" (did you mean {close[0]}?)" if close else ""


# ---- for recipes


def cell(value):
    """A number in a table; nothing for one that is missing."""
    return "" if value is None or value != value else f"{value:.6g}" if isinstance(value, float) else value


def ratio(a, b):
    return a / b if b else math.nan


def log(x):
    return math.log(x) if x > 0 else math.nan


def fit_command(catalogue, *options):
    """postproc's command for exponents of sizes, without what only a reader of the output needs."""
    return " ".join(["fit", str(catalogue), *filter(None, options), "--replicas 0 --no-comparison --no-picture -o OUT"])


def times_command(catalogue, *options):
    """The same for gamma and B of inter-event times, delta = 1, by maximum likelihood."""
    return " ".join(["intervals", str(catalogue), *filter(None, options), "--method likelihood --delta 1 --replicas 0 --no-picture -o OUT"])


def joined(study, rows):
    """A table that every run has, rows(found), for all runs."""
    return [study.start(run) | row for run in study.done() for row in rows(study.found(run))]


def over_seeds(study, means, differences):
    """A row for all seeds of a model: means(run, found) with errors, and those of the differences from the first model, seed by seed."""
    models = {}
    for run in study.runs.values():
        models.setdefault(tuple((key, run.row.get(key, "")) for key in study.columns() if key != "seed"), []).append(run)

    def numbers(part, run):
        return {key: float(cell(value) or "nan") for key, value in part(run, study.found(run)).items()}

    first = {run.row.get("seed"): numbers(differences, run) for run in next(iter(models.values())) if not run.failed}
    for model, runs in models.items():
        runs = [run for run in runs if not run.failed]
        rows = [numbers(means, run) | {key: value - first.get(run.row.get("seed"), {}).get(key, math.nan)
                                       for key, value in numbers(differences, run).items()} for run in runs]  # yapf: disable
        averaged = {key: map(float, mean_and_error([row[key] for row in rows])) for key in (rows or [{}])[0]}
        if rows:
            yield dict(model, seeds=len(runs)) | {key + end: cell(x) for key, pair in averaged.items() for end, x in zip(("", "_error"), pair)}


class Recipe:
    """The parts of a recipe by name; those that it does not have are empty. \\raises RecipeError that names file and line"""

    def __init__(self, path):
        self.path = path
        spec = spec_from_file_location(f"recipe_{path.stem}", path)
        self.module = module_from_spec(spec)
        self.asked("the recipe", spec.loader.exec_module, self.module)
        functions = [one for one in vars(self.module).values() if inspect.isfunction(one)]
        for one in functions:
            name = one.__name__
            if one.__module__ == spec.name and name not in PARTS and name[0] != "_":
                raise RecipeError(f"{path}:{inspect.getsourcelines(one)[1]}: '{name}'{meant(name, PARTS)}, expected one of {', '.join(PARTS)}, "
                                  "or a name that begins with _")
        self.files = sorted({str(path), *map(inspect.getsourcefile, functions)})

    def asked(self, what, function, *words):
        try:
            return function(*words)
        except RecipeError:
            raise
        except Exception as error:  # code of a user may raise whatever there is
            lines = [one.lineno for one in traceback.extract_tb(error.__traceback__) if one.filename == str(self.path.absolute())]
            line = error.lineno if isinstance(error, SyntaxError) else lines[-1] if lines else 1
            said = error.msg if isinstance(error, SyntaxError) else f"{type(error).__name__}: {error}"
            raise RecipeError(f"{self.path}:{line}: {what}: {said}")

    def __call__(self, part, *words):
        """What a part gives for a run, its numbers or the study; {} without it."""
        made = getattr(self.module, part, {})
        return self.asked(part, made, *words) if callable(made) else made
