# SPDX-License-Identifier: GPL-2.0-or-later
"""Reads text files of the programs: lines "# key = value" followed by a table as CSV."""
import csv
import math


def header_of(lines):
    pairs = (line[1:].partition("=") for line in lines if line.startswith("#") and "=" in line)
    return {key.strip(): value.strip() for key, _, value in pairs}


def rows_of(lines):
    return csv.DictReader(line for line in lines if not line.startswith("#"))


def memory_of(header):
    """Memory of the exponential picker, in time units."""
    return -float(header["dt"]) / math.log(float(header["lambda"]))
