#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Publishes catalogues in results: compressed and, as their header says, without the smallest events.

OUT/NAME.catalogue.csv.xz has the events >= 1e-4 of each folder NAME of a study of faults, all of sliders; with --events those of
this size. OUT/NAME.ruptures.csv.xz has the ruptures of faults that recorded them. The header of a long fault has the size from
which it is complete, which is larger than that in fault.in. With --statements OUT/statements.csv has what the paper says in words
about its fault, run by run, from all ruptures and the slip histories, which are not published.
"""
import argparse
import csv
import json
import lzma
import subprocess
import sys
import tempfile
from pathlib import Path

EVENTS, RUPTURES = 1e-4, 1e-3
LOADING = 4500  # time units that are left out of statements: compression, and PE rising for the first time
# Length of a fault, and size from which the number of its events does not depend on how often PE is sampled: results/faults.md
COMPLETE = ((900, "1e-3"), (480, "3e-4"))


def complete(line, length):
    """Header line with the size above which the catalogue of a fault of this length is complete."""
    for shortest, size in COMPLETE:
        if length >= shortest and float(line.split("=")[1]) < float(size):
            return f"# completeness = {size}\n"
    return line


def publish(source, out, least=EVENTS):
    """A catalogue without events smaller than `least`; all other lines are unchanged."""
    kept, length = [], 0.0
    for line in Path(source).read_text().splitlines(keepends=True):
        if line.startswith("# min_size = ") and least > 0:
            line = f"# min_size = {least:g}\n# thinned = sizes below {least:g} left out\n"
        elif line.startswith("# length = "):
            length = float(line.split("=")[1])
        elif line.startswith("# completeness = "):
            line = complete(line, length)
        elif line[0] not in "#e" and float(line.split(",")[5]) < least:
            continue
        kept.append(line)
    new = Path(f"{out}.new")
    new.write_bytes(lzma.compress("".join(kept).encode(), preset=9))
    new.replace(out)


class Refused(Exception):
    pass


def catalogue_of(folder):
    """\\raises Refused unless the folder has a catalogue, and the study has done its run"""
    done = folder / "done.json"
    if (folder / "settings.txt").exists() and not done.exists():
        raise Refused(f"{folder}: not done yet, expected a run that has come to its end")
    if done.exists() and "failed" in json.loads(done.read_text()):
        raise Refused(f"{folder}: {json.loads(done.read_text())['failed']}, expected a run that has come to its end")
    for name in ("fault.catalogue.csv", "catalogue.csv"):
        if (folder / name).is_file():
            return folder / name
    raise Refused(f"{folder}: no catalogue, expected the folder of a run of a study")


def statements_of(postproc, catalogue):
    """Rows of postproc statements, of one run."""
    with tempfile.TemporaryDirectory() as work, open(catalogue) as lines:
        header = dict(line[2:].rstrip("\n").split(" = ", 1) for line in lines if line[0] == "#" and " = " in line)
        said = subprocess.run([postproc, "statements", catalogue, "--from",
                               str(LOADING), "-o", f"{work}/out", "--json", f"{work}/out.json"], capture_output=True, text=True)
        if said.returncode:
            raise Refused(said.stderr.strip())
        rows = json.loads(Path(f"{work}/out.json").read_text())["statements"]
    return [{"run": catalogue.parent.name, "length": header["length"], "seed": header["seed"], **row} for row in rows]


def main(out, folders, events=None, ruptures=RUPTURES, statements=None):
    catalogues = [catalogue_of(Path(folder)) for folder in folders]
    rows = [row for source in catalogues if statements and source.name.startswith("fault") for row in statements_of(statements, source)]
    Path(out).mkdir(parents=True, exist_ok=True)
    for source in catalogues:
        least = events if events is not None else EVENTS if source.name.startswith("fault") else 0.0
        publish(source, Path(out) / f"{source.parent.name}.catalogue.csv.xz", least)
        if (source.parent / "fault.ruptures.csv").exists():
            publish(source.parent / "fault.ruptures.csv", Path(out) / f"{source.parent.name}.ruptures.csv.xz", ruptures)
    if rows:
        with open(Path(out) / "statements.csv", "w", newline="") as file:
            table = csv.DictWriter(file, rows[0], lineterminator="\n")
            table.writeheader()
            table.writerows(rows)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--events", type=float, metavar="SIZE", help="smallest event (1e-4; sliders: all)")
    parser.add_argument("--ruptures", type=float, metavar="SIZE", default=RUPTURES, help="smallest rupture (%(default)s)")
    parser.add_argument("--statements", metavar="POSTPROC", help="the program that measures them")
    parser.add_argument("out", metavar="OUT", type=Path)
    parser.add_argument("folders", metavar="FOLDER", type=Path, nargs="+")
    try:
        main(**vars(parser.parse_args()))
    except (Refused, OSError) as error:
        sys.exit(f"publish.py: {error}")
