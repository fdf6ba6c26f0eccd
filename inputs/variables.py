# SPDX-License-Identifier: GPL-2.0-or-later
"""The variables of scenes, as their tables declare them, such as fault.variables that of fault.in."""
import re
from pathlib import Path
from typing import NamedTuple

__all__ = ["Variable", "cases", "declared", "defaults"]

TABLE = Path(__file__).with_name("fault.variables")


class Variable(NamedTuple):
    """Cells of a line of the table."""
    name: str
    default: str
    accepted: str
    restart: str
    header: str
    unit: str
    meaning: str


def declared(table=TABLE):
    """All variables, in order."""
    return [Variable(*(cell.strip() for cell in line.split("|"))) for line in table.read_text().splitlines() if line.count("|") == 6]


def cases():
    """(condition, name, value) of each default for a case, such as ("preset absorbing", "dt", "0.12")."""
    lines = re.findall(r"^when (.*?) : (.*)$", TABLE.read_text(), re.M)
    return [(condition, *pair.split(None, 1)) for condition, pairs in lines for pair in pairs.split(", ")]


def defaults(preset="leaky"):
    """Texts of the defaults with a preset, by name."""
    return {one.name: one.default for one in declared()} | {name: value for condition, name, value in cases() if condition == f"preset {preset}"}
