# SPDX-License-Identifier: GPL-2.0-or-later
"""The variables of fault.in, as fault.variables declares them."""
import re
from pathlib import Path

__all__ = ["defaults"]


def defaults(preset="leaky"):
    """Texts of the defaults with a preset, by name."""
    text = Path(__file__).with_name("fault.variables").read_text()
    cells = [[cell.strip() for cell in line.split("|")] for line in text.splitlines() if line.count("|") > 4]
    preset_values = re.findall(rf"^when preset {preset} : (.*)", text, re.M)
    return {row[0]: row[1] for row in cells} | dict(words.split() for line in preset_values for words in line.split(","))
