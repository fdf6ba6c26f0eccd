# SPDX-License-Identifier: GPL-2.0-or-later
"""Tables as CSV, with lines "# ..." before them, and as JSON; rows are dicts."""
import csv
import json
import lzma
import math
from pathlib import Path

__all__ = ["header_of", "memory_of", "number", "plain", "read", "rows_of", "text_of", "update_table", "write_json", "write_table"]


def header_of(lines):
    """The lines "# key = value"."""
    pairs = (line[1:].partition("=") for line in lines if line.startswith("#") and "=" in line)
    return {key.strip(): value.strip() for key, _, value in pairs if key.strip()}


def memory_of(header):
    """Memory of the exponential picker, in time units."""
    return -float(header["dt"]) / math.log(float(header["lambda"]))


def rows_of(lines):
    return csv.DictReader(line for line in lines if not line.startswith("#"))


def read(path):
    """The rows of a file, also of one that is compressed as .xz, as texts."""
    path = Path(path)
    with (lzma.open if path.suffix == ".xz" else open)(path, "rt") as lines:
        return list(rows_of(lines))


def number(row, key):
    """NaN if there is none."""
    return float(row[key]) if row.get(key) else math.nan


def text_of(value):
    """A cell of a CSV file; empty if there is no number."""
    value = value.item() if hasattr(value, "item") else value
    if isinstance(value, float):
        return f"{value:.17g}" if math.isfinite(value) else ""
    return str(value)


def write_table(path, comments, rows):
    """Writes rows, with the columns of all of them, and lines of comments before them."""
    with (lzma.open if str(path).endswith(".xz") else open)(path, "wt", newline="") as file:
        file.writelines(f"# {line}\n" for line in comments)
        table = csv.DictWriter(file, list(dict.fromkeys(key for row in rows for key in row)), lineterminator="\n")
        table.writeheader()
        table.writerows({key: text_of(value) for key, value in row.items()} for row in rows)


def update_table(path, comments, rows, order=None):
    """The same with rows of runs, their column `run`, in a file in which those of other runs stay. order: of all of them"""
    there = [row for row in (read(path) if Path(path).exists() else []) if row["run"] not in {one["run"] for one in rows}]
    write_table(path, comments, sorted(there + rows, key=order) if order else there + rows)


def plain(value):
    """What JSON has: numbers of Python, lists, dicts with these, and None in place of numbers that are not finite."""
    if isinstance(value, dict):
        return {key: plain(one) for key, one in value.items()}
    if isinstance(value, (list, tuple)):
        return [plain(one) for one in value]
    value = value.tolist() if hasattr(value, "tolist") else value
    return None if isinstance(value, float) and not math.isfinite(value) else value


def write_json(path, **tables):
    """Writes tables, lists of rows, as those of postproc: null where there is no number. path: None is standard output
    \\raises OSError that names the file, on a full disk as well"""
    text = json.dumps(plain(tables), indent=1) + "\n"
    if not path:
        return print(text, end="")
    try:
        Path(path).write_text(text, encoding="utf-8")
    except OSError as error:
        raise OSError(error.errno, error.strerror, str(path)) from None
