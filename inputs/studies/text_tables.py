# SPDX-License-Identifier: GPL-2.0-or-later
"""What text files of the programs hold: lines "# key = value", and below them a table as CSV."""
import csv


def header_of(lines):
    return dict(line[2:].rstrip("\n").split(" = ", 1) for line in lines if line.startswith("# ") and " = " in line)


def rows_of(lines):
    return csv.DictReader(line for line in lines if not line.startswith("#"))
