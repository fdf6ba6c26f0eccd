# SPDX-License-Identifier: GPL-2.0-or-later
"""Recipes of studies: NAME.py beside the table NAME.csv, or default.py; studies.md explains their parts. And the numbers that
they read: those of JSON files as a.b[0].c, where what is missing has no value, and no sum or ratio made of it has one."""
import difflib
import inspect
import json
import math
import sys
import traceback
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path

sys.dont_write_bytecode = True  # of recipes, which may change more than once in a second
PARTS = ("reference", "numbers", "comparisons", "table", "costs", "means", "differences", "stacks", "figures", "pages", "drawings")


class RecipeError(Exception):
    pass


class Missing(float):
    """What a run does not have, and why; so is all that belongs to it."""

    def __new__(cls, why=""):
        made = super().__new__(cls, "nan")
        made.why = why
        return made

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
    """An object of a JSON file. What a command could not determine has its reason, `why`, in place of numbers."""

    def __getattr__(self, name):
        if name.startswith("__"):
            raise AttributeError(name)
        return self[name] if name in self else Missing(
            self.get("why") or f"nothing is called '{name}'{meant(name, self)}, expected one of {', '.join(self)}")


class Numbers(Found):
    """The numbers of a run, by the names of the commands that determine them. \\raises AttributeError for other names"""

    def __getattr__(self, name):
        if name in self:
            return self[name]
        raise AttributeError(f"nothing is called '{name}'{meant(name, self)}, expected one of {', '.join(self)}")


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


def ratio(a, b):
    return a / b if b else math.nan


def fit_command(catalogue, *options):
    """postproc's command for exponents of sizes, without what only a reader of the output needs."""
    return " ".join(["fit", str(catalogue), *filter(None, options), "--replicas 0 --no-comparison --no-picture -o OUT"])


def times_command(catalogue, *options):
    """The same for gamma and B of inter-event times, delta = 1, by maximum likelihood."""
    return " ".join(["intervals", str(catalogue), *filter(None, options), "--method likelihood --delta 1 --replicas 0 --no-picture -o OUT"])


def log(x):
    return math.log(x) if x > 0 else math.nan


class Recipe:
    """The parts of a recipe by name; those that it does not have are empty. \\raises RecipeError that names file and line"""

    def __init__(self, path):
        self.path = path
        spec = spec_from_file_location(f"recipe_{path.stem}", path)
        self.module = module_from_spec(spec)
        self.asked("the recipe", spec.loader.exec_module, self.module)
        for name, one in vars(self.module).items():
            if inspect.isfunction(one) and one.__module__ == spec.name and name not in PARTS and name[0] != "_":
                raise RecipeError(f"{path}:{inspect.getsourcelines(one)[1]}: '{name}'{meant(name, PARTS)}, expected one of {', '.join(PARTS)}, "
                                  "or a name that begins with _")

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

    def text(self, part):
        """Text of the file that has a part; what is made of it is made again if it changes."""
        made = getattr(self.module, part, None)
        return Path(inspect.getsourcefile(made)).read_text() if inspect.isfunction(made) else repr(made)
