# SPDX-License-Identifier: GPL-2.0-or-later
"""Reads text files of the programs: lines "# key = value" followed by a table as CSV."""
import csv
import math


def header_of(lines):
    return dict(line[2:].rstrip("\n").split(" = ", 1) for line in lines if line.startswith("# ") and " = " in line)


def rows_of(lines):
    return csv.DictReader(line for line in lines if not line.startswith("#"))


def memory_of(header):
    """Memory of the exponential picker, in time units."""
    return -float(header["dt"]) / math.log(float(header["lambda"]))
