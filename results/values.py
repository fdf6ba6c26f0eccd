# SPDX-License-Identifier: GPL-2.0-or-later
"""The numbers in sentences of the pages: values.csv has each with its key, and tables.py writes them into the pages.

A comment follows a number of a page, 0.93<!--n KEY--> or ?<!--n KEY--> before it is written for the first time; what is before the
comment is replaced. After the key, after a blank, may stand how it is written:
  (nothing)    digits as the error allows, three without an error
  ()           with the error in units of the last digit: 1.18(2)
  %            a share as a percentage, without the sign; %() with its error
  .2f          a format of Python
  1/           the inverse, such as the mean time of a rate
  95           before one of these: the error is half of the 95 % interval of so many packings (Student)
"""
import csv
import math
import re
from pathlib import Path
from typing import NamedTuple

from scipy.stats import t as student

TABLE = Path(__file__).resolve().parent / "values.csv"
# What a page may say without a key: what the paper prints, and settings and limits that were chosen and not measured.
PRINTED = "30 120 240 480 945 1440 1890 256 614 972 1450 1928 0.6 0.00025 0.01 1e7 3e7 3000 8000 5000 1.07 0.995 15.2 15.21 2.12 0.5 1.0 0.25 1e-4 2004 553"
CHOSEN = {
    "sizes that are counted, and units of rates": "1e-4 0.001 0.002 0.003 1e-3 3e-3 0.01 0.1 1 100 1000",
    "times: loading, a P-wave through the blocks, memories and steps": "8000 15 0.3 4 0.03 0.12",
    "thresholds of ruptures, in velocities of the plates": "20 50",
    "benchmarks: spacings, stations, times, frequency, thinning": "12.5 50 100 150 200 19 1 0.2",
    "our tolerances, and aims": "0.07 1.22 1.25 25 32",
    "rounds": "15",
    "a network": "2 10",
    "packings": "4 5 6 11 12 13",
    "cut of short times in memories, stretches with bursts and their periods": "2.5 250 2",
    "times after main shocks": "300 3e4",
    "moments of ruptures": "10",
    "the block-slider: blocks, time step, and time left out": "512 0.05 12000",
}
CONSTANTS = set(f"{PRINTED} {' '.join(CHOSEN.values())}".split())
MARK = re.compile(r"(\?|-?\d[\d.]*(?:e[-+]?\d+)?(?:\(\d[\d.]*\))?)<!--n\s+([^\s>]+)(?:\s+([^\s>]+?))?\s*-->")


class Value(NamedTuple):
    """source: file of this folder, with the function of faults.py that makes the number from it"""
    key: str
    value: float
    error: float = math.nan
    unit: str = ""
    n: int = 1
    source: str = ""


def digits(value, error):
    """Digits after the point: the error has one, or two if it begins with less than 3.5; without an error the value has three."""
    if error > 0:
        last = math.floor(math.log10(error))
        return -last + (1 if error / 10**last < 3.5 else 0)
    return 2 - math.floor(math.log10(abs(value))) if value else 0


def text_of(value, error=math.nan, form="", n=1):
    """\\raises ValueError if there is no number, or no such form"""
    if form.startswith("95"):
        if n < 2:
            raise ValueError(f"{n} packing, expected at least 2 for an interval")
        error, form = error * student.ppf(0.975, n - 1), form[2:]
    if not math.isfinite(value):
        raise ValueError("no number")
    if form.startswith("1/"):
        value, error, form = 1 / value, error / value**2, form[2:]
    if form.startswith("%"):
        value, error, form = 100 * value, 100 * error, form[1:]
    if form not in ("", "()"):
        return format(value, form)
    places = digits(value, error)
    if not form or not error > 0:
        return f"{round(value, places):.{max(0, places)}f}"
    shown = round(error, places)
    return f"{round(value, places):.{max(0, places)}f}({f'{shown:.{places}f}' if 1 <= shown and places > 0 else round(shown * 10**max(0, places))})"


def rows(values):
    """Those of the table."""
    found = sorted(values)
    assert len({one.key for one in found}) == len(found)
    return [one._asdict() | {key: f"{x:.6g}" if math.isfinite(x) else "" for key, x in (("value", one.value), ("error", one.error))} for one in found]


def write(values, path=TABLE):
    with open(path, "w", newline="") as file:
        table = csv.DictWriter(file, Value._fields, lineterminator="\n")
        table.writeheader()
        table.writerows(rows(values))


def read(path=TABLE):
    """{key: Value}"""
    with open(path) as file:
        return {
            row["key"]: Value(row["key"], float(row["value"] or "nan"), float(row["error"] or "nan"), row["unit"], int(row["n"]), row["source"])
            for row in csv.DictReader(file)
        }


def filled(text, values):
    """A page with its numbers as they are in the table. \\raises ValueError that names a key"""

    def replace(match):
        _, key, form = match.groups()
        if key not in values:
            near = [name for name in values if name.split(".")[0] == key.split(".")[0]]
            raise ValueError(f"number {key}: no such key in values.csv" + (f", expected one of {', '.join(near[:9])}" if near else ""))
        try:
            shown = text_of(values[key].value, values[key].error, form or "", values[key].n)
        except ValueError as error:
            raise ValueError(f"number {key} {form or ''}: {error}") from None
        return f"{shown}{match[0][len(match[1]):]}"

    return MARK.sub(replace, text)


def bare(text):
    """Numbers of a page's sentences without a key that are no constants."""
    for other in (r"^```.*?^```", r"<!-- table .*?<!-- end -->", r"^ *(\||#).*?$", r"^    .*?$"):
        text = re.sub(other, "", text, flags=re.M | re.S if "```" in other or "table" in other else re.M)
    text = re.sub(r"`[^`]*`", "", MARK.sub("", text))
    text = re.sub(r"\]\([^)]*\)|<!--.*?-->", "", text, flags=re.S)
    return [number for number in re.findall(r"(?<![\w.])\d+(?:\.\d+)?(?:e-?\d+)?(?![\w-])", text) if number not in CONSTANTS]
