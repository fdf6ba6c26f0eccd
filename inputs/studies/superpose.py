#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""What the picker makes of the PE of several faults together, or of longer steps.

superpose.py OUT.pe.bin SERIES FROM TO [SERIES FROM TO]...

Adds PE series (binary, as compute lsm/events writes them) between the times FROM and TO of each, sample by sample, and writes the
sum as a series that begins at time 0: the PE of a fault made of independent pieces. Its length is that of all pieces. All stretches
need as many samples, and the same time step.

superpose.py every N OUT.pe.bin SERIES

Takes every Nth step of a series, as if the time step were N times as long and the fault the same; the picker keeps its memory.
"""
import array
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent.parent / "python"))
from lsm.tables import header_of  # noqa: E402

MAGIC = b"lsm-pe-series-1\n"


class SeriesError(Exception):
    pass


def read(path):
    """Header of a binary PE series, its first step and PE of each step. \\raises SeriesError"""
    raw = Path(path).read_bytes()
    if raw[:16] != MAGIC:
        raise SeriesError(f"{path}: expected a binary PE series")
    begin = 24 + int.from_bytes(raw[16:24], "little")
    info = header_of(raw[24:begin].decode().splitlines())
    records = raw[begin:begin + (len(raw) - begin) // 16 * 16]  # a killed run may leave an incomplete one
    if "lambda" not in info or info.get("model") != "lsm":
        raise SeriesError(f"{path}: expected the series of a fault")
    values, steps = array.array("d"), array.array("q")
    values.frombytes(records)
    steps.frombytes(records)
    steps, pe = steps[::2], values[1::2]
    if info.get("times") == "own" or any(b - a != 1 for a, b in zip(steps, steps[1:])):
        raise SeriesError(f"{path}: expected a series that holds each step")
    return info, steps[0], pe


def stretch(path, begin, end):
    """Header, and PE of the steps from time `begin` to time `end`. \\raises SeriesError"""
    info, first, pe = read(path)
    dt, time0, step0 = float(info["dt"]), float(info["time0"]), int(info["step0"])
    start = round((begin - time0) / dt) + step0 - first
    count = round((end - begin) / dt)
    if start < 0 or count < 2 or start + count > len(pe):
        raise SeriesError(f"{path}: no time from {begin:g} to {end:g}, it has {time0 + (first - step0) * dt:g} to "
                          f"{time0 + (first - step0 + len(pe) - 1) * dt:g}")
    return info, pe[start:start + count]


def write(path, info, pe):
    """Writes a series that has each step from info["step0"] on."""
    header = "".join(f"# {key} = {value}\n" for key, value in info.items()).encode()
    both = array.array("d", bytes(16 * len(pe)))
    both[1::2] = pe
    steps = array.array("q")
    steps.frombytes(both.tobytes())
    first = int(info["step0"])
    steps[::2] = array.array("q", range(first, first + len(pe)))
    Path(path).write_bytes(MAGIC + len(header).to_bytes(8, "little") + header + steps.tobytes())


def superpose(out, parts):
    """Writes the sum of several series. \\param parts (path, from, to) of each series"""
    total, length = None, 0.0
    for path, begin, end in parts:
        info, pe = stretch(path, begin, end)
        length += float(info["length"])
        if total is None:
            total, first = pe, info
        elif len(pe) != len(total) or info["dt"] != first["dt"]:
            raise SeriesError(f"{path}: {len(pe)} steps of {info['dt']}, expected {len(total)} of {first['dt']} as of {parts[0][0]}")
        else:
            total = array.array("d", map(float.__add__, total, pe))
    write(out, dict(first, step0="0", time0="0", length=f"{length:g}", superposed=str(len(parts))), total)


def every(number, out, path):
    info, first, pe = read(path)
    dt = float(info["dt"])
    start = repr(float(info["time0"]) + (first - int(info["step0"])) * dt)
    write(out, dict(info, dt=repr(dt * number), step0="0", time0=start, **{"lambda": repr(float(info["lambda"])**number)}), pe[::number])


def main(words):
    if words in (["-h"], ["--help"]):
        return print(__doc__)
    if words[:1] == ["every"] and len(words) == 4:
        if not words[1].isdigit() or int(words[1]) < 1:
            raise SeriesError(f"every {words[1]}, expected a number of at least 1")
        return every(int(words[1]), *words[2:])
    if len(words) < 4 or len(words) % 3 != 1:
        sys.exit(__doc__)
    parts = [(path, float(begin), float(end)) for path, begin, end in zip(words[1::3], words[2::3], words[3::3])]
    superpose(words[0], parts)


if __name__ == "__main__":
    try:
        main(sys.argv[1:])
    except (SeriesError, OSError, ValueError) as error:
        sys.exit(f"superpose.py: {error}")
