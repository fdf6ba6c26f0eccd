#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""What the picker makes of the PE of several faults together.

superpose.py OUT.pe.bin [--load RATE] SERIES FROM TO [SERIES FROM TO]...

Adds PE series (binary, as compute lsm/events writes them) between the times FROM and TO of each, sample by sample, and writes the
sum as a series that begins at time 0: the PE of a fault made of independent pieces. Its length is that of all pieces. --load adds
RATE to the slope: pieces that only load. All stretches need as many samples, and the same time step.

superpose.py every N OUT.pe.bin SERIES

Takes every Nth step of a series, as if the time step were N times as long and the fault the same; the picker keeps its memory.

superpose.py second POSTPROC OUT FOLDER...

Picks events from every second step of the runs in these folders, and publishes them in OUT: NAME_SEED, or NAME_step_SEED, as
NAME_every_SEED.

superpose.py memory TIME POSTPROC OUT FOLDER...

Picks events of the runs in these folders with another memory of the picker, and publishes them in OUT: fault_LENGTH_SEED as
memory_LENGTH_TIME_SEED.

superpose.py study POSTPROC OUT FOLDER...

Does so for the runs in these folders (settings of each the same, but for the packing): sums of 2 to 16 stretches, and single
stretches with the load of 1 to 15 others; picks the events, and publishes them in OUT as sum_LENGTH_N and load_LENGTH_N.
"""
import array
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

from publish import LOADING, publish

MAGIC = b"lsm-pe-series-1\n"
DURATION = 12500  # time units of a stretch
NUMBERS, GROUPS = (2, 4, 8, 16), 5  # stretches in a sum, and sums of each number at most


class SeriesError(Exception):
    pass


def read(path):
    """Header of a binary PE series, its first step and PE of each step. \\raises SeriesError"""
    raw = Path(path).read_bytes()
    if raw[:16] != MAGIC:
        raise SeriesError(f"{path}: expected a binary PE series")
    begin = 24 + int.from_bytes(raw[16:24], "little")
    info = {}
    for line in raw[24:begin].decode().splitlines():
        key, equals, value = line.removeprefix("# ").partition(" = ")
        if equals:
            info[key] = value
    records = raw[begin:]
    values, steps = array.array("d"), array.array("q")
    values.frombytes(records)
    steps.frombytes(records)
    steps, pe = steps[::2], values[1::2]
    if info.get("times") == "own" or any(b - a != 1 for a, b in zip(steps, steps[1:])):
        raise SeriesError(f"{path}: expected a series that holds each step")
    return info, steps[0], pe


def stretch(path, begin, end):
    """Header, and PE from time `begin` on, as many steps as there are to `end`. \\raises SeriesError"""
    info, first, pe = read(path)
    dt, time0, step0 = float(info["dt"]), float(info["time0"]), int(info["step0"])
    start = round((begin - time0) / dt) + step0 - first
    count = round((end - begin) / dt)
    if start < 0 or count < 2 or start + count > len(pe):
        raise SeriesError(f"{path}: no time from {begin:g} to {end:g}, it has {time0 + (first - step0) * dt:g} to "
                          f"{time0 + (first - step0 + len(pe) - 1) * dt:g}")
    return info, pe[start:start + count]


def write(path, info, pe):
    """A series that holds each step from info["step0"] on."""
    header = "".join(f"# {key} = {value}\n" for key, value in info.items()).encode()
    both = array.array("d", bytes(16 * len(pe)))
    both[1::2] = pe
    steps = array.array("q")
    steps.frombytes(both.tobytes())
    first = int(info["step0"])
    steps[::2] = array.array("q", range(first, first + len(pe)))
    Path(path).write_bytes(MAGIC + len(header).to_bytes(8, "little") + header + steps.tobytes())


def superpose(out, parts, load=0.0, number=1):
    """\\param parts (path, from, to) of each series \\param number of pieces that each stands for with its load"""
    total, length = None, 0.0
    for path, begin, end in parts:
        info, pe = stretch(path, begin, end)
        length += float(info["length"]) * number
        if total is None:
            total, first = pe, info
        elif len(pe) != len(total) or info["dt"] != first["dt"]:
            raise SeriesError(f"{path}: {len(pe)} steps of {info['dt']}, expected {len(total)} of {first['dt']} as of {parts[0][0]}")
        else:
            total = array.array("d", map(float.__add__, total, pe))
    dt = float(first["dt"])
    if load:
        total = array.array("d", (x + load * dt * n for n, x in enumerate(total)))
    info = dict(first, step0="0", time0="0", length=f"{length:g}", superposed=str(len(parts)), load=f"{load:.6g}")
    write(out, info, total)
    return info["length"]


def every(number, out, path):
    info, first, pe = read(path)
    dt = float(info["dt"])
    start = repr(float(info["time0"]) + (first - int(info["step0"])) * dt)
    write(out, dict(info, dt=repr(dt * number), step0="0", time0=start, **{"lambda": repr(float(info["lambda"])**number)}), pe[::number])


def loading(path, begin, end):
    """Rate at which PE rises while the fault is locked, which it is most of the time: the median of its slope."""
    info, pe = stretch(path, begin, end)
    return statistics.median(b - a for a, b in zip(pe, pe[1:])) / float(info["dt"])


def stretches(folders):
    """(path, from, to) of each, the first of every run before the second ones."""
    found = []
    for folder in folders:
        path = next(Path(folder).glob("*.pe.bin"))
        info, first, pe = read(path)
        last = float(info["time0"]) + (first - int(info["step0"]) + len(pe) - 1) * float(info["dt"])
        for n in range(int((last - LOADING) / DURATION)):
            found.append((n, path, LOADING + n * DURATION, LOADING + (n + 1) * DURATION))
    return [one[1:] for one in sorted(found, key=lambda one: one[0])]


def pick(postproc, series, out, *words):
    with tempfile.TemporaryDirectory() as work:
        picked = Path(work) / "picked.csv"
        subprocess.run([postproc, "pick", series, "-o", picked, "--overwrite", *words], check=True, stdout=subprocess.DEVNULL)
        publish(picked, f"{out}.catalogue.csv.xz")


def second(postproc, out, folders):
    for folder in map(Path, folders):
        with tempfile.TemporaryDirectory() as work:
            series = Path(work) / "second.pe.bin"
            every(2, series, next(folder.glob("*.pe.bin")))
            name, seed = folder.name.removesuffix("/").rsplit("_", 1)
            pick(postproc, series, Path(out) / f"{name.removesuffix('_step')}_every_{seed}")


def with_memory(time, postproc, out, folders):
    Path(out).mkdir(parents=True, exist_ok=True)
    for folder in map(Path, folders):
        _, length, seed = folder.name.split("_")
        pick(postproc, next(folder.glob("*.pe.bin")), Path(out) / f"memory_{length}_{time}_{seed}", "--memory-time", time)


def study(postproc, out, folders):
    parts = stretches(folders)
    Path(out).mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as work:
        series = Path(work) / "sum.pe.bin"
        for number in NUMBERS:
            for group in range(min(GROUPS, len(parts) // number)):
                length = superpose(series, parts[group * number:(group + 1) * number])
                pick(postproc, series, Path(out) / f"sum_{length}_{group + 1}")
            for n, part in enumerate(parts[:GROUPS], 1):
                length = superpose(series, [part], (number - 1) * loading(*part), number)
                pick(postproc, series, Path(out) / f"load_{length}_{n}")


def main(words):
    if words in (["-h"], ["--help"]):
        return print(__doc__)
    if words[:1] == ["every"] and len(words) == 4:
        return every(int(words[1]), *words[2:])
    if words[:1] == ["second"] and len(words) > 3:
        return second(words[1], words[2], words[3:])
    if words[:1] == ["memory"] and len(words) > 4:
        return with_memory(words[1], words[2], words[3], words[4:])
    if words[:1] == ["study"] and len(words) > 3:
        return study(words[1], words[2], words[3:])
    load = 0.0
    if words[1:2] == ["--load"]:
        load = float(words[2])
        words = words[:1] + words[3:]
    if len(words) < 4 or len(words) % 3 != 1:
        sys.exit(__doc__)
    parts = [(path, float(begin), float(end)) for path, begin, end in zip(words[1::3], words[2::3], words[3::3])]
    superpose(words[0], parts, load)


if __name__ == "__main__":
    try:
        main(sys.argv[1:])
    except (SeriesError, OSError, ValueError) as error:
        sys.exit(f"superpose.py: {error}")
