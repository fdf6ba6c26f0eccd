# SPDX-License-Identifier: GPL-2.0-or-later
"""Reads and writes catalogues, PE series and slip histories, and picks events independently."""
import gzip
import lzma
import re
import struct
import sys
from pathlib import Path

import numpy as np
from programs import SOURCE

sys.path.insert(0, str(SOURCE / "python"))
import lsm  # noqa: E402
from lsm.tables import header_of, rows_of  # noqa: E402

COLUMNS = "event_id,t_start,t_end,step_start,step_end,size,pe_start,pe_end".split(",")


def lines(path):
    """The lines of a text, compressed or not."""
    raw = Path(path).read_bytes()
    raw = lzma.decompress(raw) if raw[:2] == b"\xfd7" else gzip.decompress(raw) if raw[:2] == b"\x1f\x8b" else raw
    return raw.decode().splitlines()


def header(path):
    return header_of(lines(path))


def info(path):
    """What is beside a restart file: the values of variables."""
    return dict(line.split(" = ", 1) for line in Path(path).read_text().splitlines() if " = " in line)


def unknown_keys(*headers):
    """Keys of headers that are not in the table of lammps-pkg/core/files/header_keys.cpp."""
    table = set(re.findall(r'^ +{"(\w+)",', (SOURCE / "lammps-pkg/core/files/header_keys.cpp").read_text(), re.M))
    assert len(table) > 50
    return {key for one in headers for key in one} - table


def rows(path):
    """The rows of a catalogue or table, as texts, without its header."""
    return [line for line in lines(path) if not line.startswith("#")][1:]


def same_bytes(a, b):
    assert Path(a).read_bytes() == Path(b).read_bytes(), f"{a} and {b} differ"


def same(a, b, least=10):
    """Asserts that two catalogues have the same bytes, and at least the given number of events."""
    same_bytes(a, b)
    assert len(rows(a)) >= least, f"{a} has too few events to test anything"


def table(path):
    """The rows of a CSV with a header of comments, as a list of dicts of texts."""
    return list(rows_of(lines(path)))


def read_catalogue(path):
    """Header of a catalogue, and its columns as arrays."""
    names = next(line for line in lines(path) if not line.startswith("#")).split(",")
    values = [[float(cell) for cell in row.split(",")] for row in rows(path)]
    return header(path), dict(zip(names, np.array(values).reshape(-1, len(names)).T))


def text(value):
    return f"{value:d}" if isinstance(value, (int, np.integer)) else f"{value:.17g}" if isinstance(value, (float, np.floating)) else str(value)


def write_catalogue(path, t_start, size, head=(("model", "lsm"), ("length", 40)), t_end=None, **columns):
    """Writes a catalogue of events with these times and sizes. head: dict or pairs; columns: arrays
    that replace the usual columns (PE falls to 0) or are appended to them."""
    n = len(t_start)
    usual = dict(event_id=range(1, n + 1), t_start=t_start, t_end=t_start if t_end is None else t_end, step_start=range(1, n + 1),
                 step_end=range(1, n + 1), size=size, pe_start=size, pe_end=[0] * n)
    all_columns = {**usual, **columns}
    out = ["# lsm-catalogue 1", *(f"# {key} = {value}" for key, value in dict(head).items()), ",".join(all_columns)]
    out += [",".join(text(value) for value in row) for row in zip(*all_columns.values())]
    Path(path).write_text("\n".join(out) + "\n")


def edit(source, target, *changes):
    """Copies a text file and replaces pairs of (old, new), each of which must occur."""
    said = Path(source).read_text()
    for old, new in changes:
        assert old in said, f"no '{old}' in {source}"
        said = said.replace(old, new)
    Path(target).write_text(said)


SERIES = dict(model="lsm", dt=0.03, step0=0, time0=0, stride=1)


def write_series(path, pe, head=(), step=None):
    """Writes a PE series. head: replaces or supplements SERIES."""
    pe = np.asarray(pe, "<f8")
    head = {**SERIES, **dict(head)}
    step = np.arange(len(pe)) * head["stride"] + head["step0"] if step is None else step
    said = "".join(f"# {key} = {value}\n" for key, value in head.items()).encode()
    records = np.zeros(len(pe), [("step", "<i8"), ("pe", "<f8")])
    records["step"], records["pe"] = step, pe
    Path(path).write_bytes(b"lsm-pe-series-1\n" + struct.pack("<q", len(said)) + said + records.tobytes())


def read_series(path):
    """Header, steps, times and PE of a series."""
    found = lsm.read_series(path)
    return found.header, found["step"], found["time"], found["pe"]


def history_record(cells):
    """A record of a slip history: of a line with (bins,), of a plane with (bins, bins_dip) cells."""
    vectors = cells if len(cells) == 1 else cells + (2,)
    return [("step_begin", "<i8"), ("step_end", "<i8"), ("pe", "<f8"), ("slip", "<f4", vectors), ("work", "<f4", cells), ("stress", "<f4", vectors)]


def write_history(path, steps, slip, stress=0.0, work=0.0, **head):
    """Writes a slip history: the slip of each bin between one step and the next, of a plane (step, strike, dip, component). The first
    record is the state at steps[0]."""
    slip = np.asarray(slip, "<f4")
    cells = slip.shape[1:2] if slip.ndim == 2 else slip.shape[1:3]
    plane = dict(bins_dip=cells[1], z0=0, bin_dip=1, ends="open", ends_dip="open") if len(cells) == 2 else {}
    head = {
        **dict(model="lsm", bins=cells[0], x0=0, bin=1, step0=steps[0], interval=1, time0=0, dt=1, slip_velocity=5e-3, gap=1, memory_intervals=3, modulus=0.4, driving=1e-3, quiet=100),
        **plane, **head
    }
    said = "".join(f"# {key} = {value}\n" for key, value in head.items()).encode()
    records = np.zeros(len(steps), history_record(cells))
    records["step_begin"], records["step_end"] = [steps[0], *steps[:-1]], steps
    records["slip"], records["stress"], records["work"] = slip, stress, work
    Path(path).write_bytes(b"lsm-slip-hist-%d\n" % len(cells) + struct.pack("<q", len(said)) + said + records.tobytes())


def read_dump(path):
    """The frames of a text dump of LAMMPS: step, names of the columns, rows as array."""
    said, at = Path(path).read_text().splitlines(), 0
    while at < len(said):
        assert said[at] == "ITEM: TIMESTEP", said[at]
        step, n = int(said[at + 1]), int(said[at + 3])
        first = next(k for k in range(at, len(said)) if said[k].startswith(("ITEM: ATOMS", "ITEM: ENTRIES")))
        names = said[first].split()[2:]
        yield step, names, np.array([line.split() for line in said[first + 1:first + 1 + n]], float).reshape(n, len(names))
        at = first + 1 + n


def loading_with_drops(rows=5000):
    """PE that rises for 80 steps and falls for 17 steps, repeatedly."""
    i = np.arange(rows - 1)
    return np.cumsum(np.concatenate([[1.0], np.where(i % 97 < 80, 1e-3 * (1 + i % 7), -2e-3 * (1 + i % 11))]))


def pick(reading, memory, least, step, time, pe):
    """What the picker has to find, by an independent implementation: rows of a catalogue, as tuples."""
    found, change, begin = [], 0.0, None
    for n in range(1, len(pe)):
        x = pe[n] - pe[n - 1]
        if reading == "exponential":
            change = memory * change + (1 - memory) * x
        elif reading == "average":
            change = (x + memory * change) / (1 + memory)
        else:
            change = (x + memory * change) / (1 + memory * (n - 1))
        if begin is None and change < 0:
            begin = n - 1
        elif begin is not None and change > 0:
            size = pe[begin] - pe[n - 1]
            if size > 0 and size >= least:
                found.append((len(found) + 1, time[begin], time[n - 1], step[begin], step[n - 1], size, pe[begin], pe[n - 1]))
            begin = None
    return found


def numbers(path, columns=8):
    """The first columns of a catalogue, as tuples of numbers."""
    return [tuple(float(cell) for cell in row.split(",")[:columns]) for row in rows(path)]


def power_law(exponent, low, high, n, seed=1):
    """Sizes with the cumulative distribution of a power law, in random order."""
    u = (np.random.default_rng(seed).permutation(n) + 0.5) / n
    if exponent == 1:
        return low * (high / low)**u
    a = 1 - exponent
    return (low**a + u * (high**a - low**a))**(1 / a)
