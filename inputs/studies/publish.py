#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Publishes catalogues in results: compressed and, as their header says, without the smallest events.

OUT/NAME.catalogue.csv.xz has the events >= 1e-4 of each folder NAME of a study of faults, all of sliders; with --events those of
this size. OUT/NAME.ruptures.csv.xz has the ruptures of faults that recorded them. The header of a fault has the size from
which it is complete, if it was run with a smaller one. Files of OUT that it wrote earlier of runs with the same settings are
replaced, others are not; nothing is written where something is refused or the disk is full, or before all is made.
"""
import argparse
import itertools
import json
import lzma
import math
import sys
from pathlib import Path

INPUTS = Path(__file__).resolve().parent.parent
sys.path[:0] = [str(INPUTS), str(INPUTS.parent / "python")]
from lsm.tables import header_of  # noqa: E402
from run import events_in, replace, replace_all  # noqa: E402
from variables import defaults  # noqa: E402

EVENTS, RUPTURES = 1e-4, 1e-3
MAGIC = "# lsm-catalogue 1\n"
CHANGING = ("program", "steps", "min_size", "thinned", "completeness")  # of the header of one run, longer or published otherwise
# Size above which a fault's catalogue is complete, as runs state it now; the headers of earlier runs have a smaller one.
COMPLETE = defaults()["completeness"]


class Refused(Exception):
    pass


def compressed(text):
    """As xz -9, but for the dictionary, which is no larger than the text: clearing 64 MB takes longer than all else."""
    content = text.encode()
    dictionary = min(max(len(content), 4096), 1 << 26)
    return lzma.compress(content, filters=[{"id": lzma.FILTER_LZMA2, "preset": 9, "dict_size": dictionary}])


def thinned(source, least):
    """The text of a catalogue without events smaller than `least`; all other lines are unchanged. \\raises Refused"""
    kept, fault = [], False
    lines = Path(source).read_text().splitlines(keepends=True)
    if not lines or lines[0] != MAGIC:
        raise Refused(f"{source}: no catalogue, expected one")
    for number, line in enumerate(lines, 1):

        def refuse(expected):
            raise Refused(f"{source}:{number}: '{line.rstrip()}', expected {expected}")

        if not line.endswith("\n"):
            refuse("a whole line")
        try:
            value = float(line.split("=", 1)[1]) if line.startswith(("# min_size = ", "# length = ", "# completeness = ")) else 0.0
        except ValueError:
            value = math.nan
        if not math.isfinite(value):
            refuse("a number")
        if line.startswith("# min_size = ") and least > value:
            line = f"# min_size = {least:g}\n# thinned = sizes below {least:g} left out\n"
        elif line.startswith("# length = "):
            fault = True
        elif line.startswith("# completeness = ") and fault and value < float(COMPLETE):
            line = f"# completeness = {COMPLETE}\n"
        elif line[0] not in "#e":
            try:
                small = float(line.split(",")[5]) < least and least > 0
            except (IndexError, ValueError):
                refuse("an event")
            if small:
                continue
        kept.append(line)
    return "".join(kept)


def check_replaced(path, text):
    """\\raises Refused if the file exists and is no catalogue, or one of another run: with other values of what both headers state"""
    if not path.exists():
        return
    try:
        with lzma.open(path, "rt") as lines:
            head = list(itertools.takewhile(lambda line: line.startswith("#"), lines))
    except (lzma.LZMAError, UnicodeDecodeError, EOFError):
        head = []
    if head[:1] != [MAGIC]:
        raise Refused(f"{path}: exists already and holds something else, expected a new name")
    had, new = header_of(head), header_of(text.splitlines())
    other = [key for key in had if key in new and had[key] != new[key] and key not in CHANGING]
    if other:
        raise Refused(f"{path}: exists already, of another run with {other[0]} = {had[other[0]]}, not {new[other[0]]}, expected a new name")


def publish(source, out, least=EVENTS):
    """Writes a catalogue without events smaller than `least`."""
    replace(Path(out), compressed(thinned(source, least)))


def catalogue_of(folder):
    """\\raises Refused unless the folder has a catalogue and its run is done"""
    done = folder / "done.json"
    if (folder / "settings.txt").exists() and not done.exists():
        raise Refused(f"{folder}: not done yet, expected a run that has come to its end")
    told = json.loads(done.read_text()) if done.exists() else {}
    if "failed" in told:
        raise Refused(f"{folder}: {told['failed']}, expected a run that has come to its end")
    for name in ("fault.catalogue.csv", "catalogue.csv"):
        if not (folder / name).is_file():
            continue
        events = events_in(folder / name)
        if events != told.get("events", events):
            raise Refused(f"{folder}: {events} events in {name}, but {told['events']} in done.json, expected the catalogue of that run")
        return folder / name
    raise Refused(f"{folder}: no catalogue, expected the folder of a run of a study")


def main(out, folders, events=None, ruptures=RUPTURES):
    catalogues, texts = {}, {}
    for folder in folders:
        source = catalogue_of(Path(folder).absolute())
        name = source.parent.resolve().name
        if name in catalogues:
            raise Refused(f"{source.parent}: there is a run {name} already, {catalogues[name].parent}, expected another name")
        catalogues[name] = source
        least = events if events is not None else EVENTS if source.name.startswith("fault") else 0.0
        texts[Path(out) / f"{name}.catalogue.csv.xz"] = thinned(source, least)
        if (source.parent / "fault.ruptures.csv").exists():
            texts[Path(out) / f"{name}.ruptures.csv.xz"] = thinned(source.parent / "fault.ruptures.csv", ruptures)
    for path, text in texts.items():
        check_replaced(path, text)
    Path(out).mkdir(parents=True, exist_ok=True)
    replace_all({path: compressed(text) for path, text in texts.items()})


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--events", type=float, metavar="SIZE", help="smallest event (1e-4; sliders: all)")
    parser.add_argument("--ruptures", type=float, metavar="SIZE", default=RUPTURES, help="smallest rupture (%(default)s)")
    parser.add_argument("out", metavar="OUT", type=Path)
    parser.add_argument("folders", metavar="FOLDER", type=Path, nargs="+")
    try:
        main(**vars(parser.parse_args()))
    except (Refused, OSError) as error:
        sys.exit(f"publish.py: {error}")
