# SPDX-License-Identifier: GPL-2.0-or-later
"""Reads files of the fault and of the block-slider into NumPy.

    import lsm
    events = lsm.read_catalogue("fault.catalogue.csv")   # also .gz and .xz; ruptures as well
    events["size"], events.header["seed"]
    series = lsm.read_series("fault.pe.bin")              # series["time"], series["pe"]
    slip = lsm.read_slip("fault.slip.bin")                # slip["slip"]: records x places
    plane = lsm.read_slip("plane.slip.bin")               # plane["slip"]: records x strike x dip x components

Each function returns a Table: a NumPy structured array with the header of the file as `header`, a
dict of texts. pandas.DataFrame(events) makes a data frame. A file of another kind, or a damaged
one, raises a ValueError that names the file, the line or record, and what was expected. An
incomplete last line of a catalogue, or last record of a binary file, is left out: the run may not
have ended, or may have been killed.
"""
import gzip
import lzma
import math
import struct
import zlib

import numpy as np

from lsm.tables import header_of

__all__ = ["read_catalogue", "read_series", "read_slip", "rates", "spectrum", "units", "write_series", "Table"]

LOADING = 8000  # time units that compression and first loading of a default fault take, in which PE rises
# In packings by create_lsm_fault, in model units, as in postproc/statistics/units.h: speeds as measured
P_SPEED, S_SPEED, DENSITY = 2.00, 1.05, 0.286

_INTEGERS = ("event_id", "step_start", "step_end")
_COMMON = (*_INTEGERS, "t_start", "t_end", "size", "pe_start", "pe_end")


class Table(np.ndarray):
    """A structured array with the header of the file from which it was read."""

    def __new__(cls, records, header):
        table = np.asarray(records).view(cls)
        table.header = header
        return table

    def __array_wrap__(self, array, context=None, return_scalar=False):
        """A sum, or the largest of a column, is a number: json and round() take no arrays, and no integers of NumPy."""
        if array.ndim:
            return super().__array_wrap__(array, context)
        return array[()] if array.dtype.kind not in "iub" else array.item()

    def __array_finalize__(self, other):
        self.header = getattr(other, "header", {})

    def __reduce__(self):  # pickle knows of the array only
        make, arguments, state = super().__reduce__()
        return make, arguments, (state, self.header)

    def __setstate__(self, state):
        array, self.header = state
        super().__setstate__(array)


def _expect_positive(**numbers):
    for name, number in numbers.items():
        if not 0 < number < math.inf:
            raise ValueError(f"{name} is {number}, expected a number above 0")


def _bytes(path):
    with open(path, "rb") as file:
        raw = file.read()
    for magic, module in ((b"\x1f\x8b", gzip), (b"\xfd7zXZ\0", lzma)):
        if raw.startswith(magic):
            try:
                return module.decompress(raw)
            except (EOFError, OSError, lzma.LZMAError, zlib.error) as error:
                raise ValueError(f"{path}: cannot be decompressed ({error}), expected a complete file") from None
    for magic, name in ((b"BZh", "bzip2"), (b"\x28\xb5\x2f\xfd", "zstd"), (b"PK\3\4", "zip")):
        if raw.startswith(magic):
            raise ValueError(f"{path}: compressed by {name}, expected gzip, xz or a file that is not compressed")
    return raw


def _is_number(field):
    try:
        float(field)
    except ValueError:
        return False
    return True


def _number(path, header, name, kind=float):
    try:
        return kind(header[name])
    except (KeyError, ValueError):
        said = f"is '{header[name]}'" if name in header else "is missing"
        raise ValueError(f"{path}: parameter '{name}' {said}, expected a number") from None


def lines_of(path):
    """The complete lines of a text, compressed or not."""
    lines = [line.removesuffix("\r") for line in _bytes(path).decode("utf-8-sig", "replace").split("\n")]
    lines.pop()  # the incomplete last line, or the empty text after the last line end
    return lines


def read_catalogue(path, lenient=False):
    """Reads the events of a catalogue; columns of integers are int64, all others float64. Further columns whose first value is no number
    are left out. lenient: leaves out lines that cannot be read."""
    lines = lines_of(path)
    if not lines or not lines[0].startswith("# lsm-catalogue "):
        raise ValueError(f"{path}: no catalogue, expected '# lsm-catalogue 1' in the first line")
    if lines[0].strip() != "# lsm-catalogue 1":
        raise ValueError(f"{path}: format '{lines[0][2:].strip()}', expected 'lsm-catalogue 1'")
    first = next((n for n, line in enumerate(lines) if not line.startswith("#")), None)
    if first is None:
        raise ValueError(f"{path}: no line of columns, expected 'event_id,t_start,...'")
    names = lines[first].split(",")
    for name in names:
        if names.count(name) > 1:
            raise ValueError(f"{path}:{first + 1}: column '{name}' is there {names.count(name)} times, expected each once")
    kinds = [np.int64 if name in _INTEGERS else np.float64 for name in names]
    some = lines[first + 1].split(",") if len(lines) > first + 1 else names
    shown = [k for k, (name, field) in enumerate(zip(names, some)) if name in _COMMON or _is_number(field) or some is names]
    finite = [k for k, column in enumerate(shown) if names[column] in _COMMON]
    identity = next((k for k, column in enumerate(shown) if names[column] == "event_id"), None)
    rows = []
    for number, line in enumerate(lines[first + 1:], first + 2):
        fields, wrong = line.split(","), ""
        try:
            if len(fields) != len(names):
                raise ValueError
            row = tuple(kinds[k](fields[k]) for k in shown)
            if not all(math.isfinite(row[k]) for k in finite):
                raise ValueError
            if identity is not None and rows and row[identity] <= rows[-1][identity]:
                wrong = f"event_id {row[identity]} after {rows[-1][identity]}, expected increasing event_id"
                raise ValueError
            rows.append(row)
        except (ValueError, OverflowError):
            if not lenient:
                raise ValueError(f"{path}:{number}: " + (wrong or f"'{line}', expected {len(names)} numbers")) from None
    return Table(np.array(rows, [(names[k], kinds[k]) for k in shown]), header_of(lines[:first]))


def _binary(path, magics, what):
    raw = _bytes(path)
    if raw[:16] not in magics:
        expected = " or ".join(f"'{magic.decode().strip()}'" for magic in magics)
        raise ValueError(f"{path}: no {what}, expected {expected} in the first 16 bytes")
    if len(raw) < 24 or len(raw) - 24 < (length := struct.unpack("<q", raw[16:24])[0]) or length < 0:
        raise ValueError(f"{path}: the header is not complete")
    return header_of(raw[24:24 + length].decode("utf-8", "replace").splitlines()), memoryview(raw)[24 + length:], magics.index(raw[:16]) + 1


def _records(path, raw, kinds, empty=False):
    """The complete records; their steps, in the first column, increase, but after one that is empty. After a power failure zeros may follow."""
    kind = np.dtype(kinds)
    records = np.frombuffer(raw, kind, len(raw) // kind.itemsize)
    steps = records[kind.names[0]]
    wrong = np.flatnonzero((steps[1:] < steps[:-1]) | ((steps[1:] == steps[:-1]) & (not empty)))
    if len(wrong):
        n = wrong[0] + 1
        raise ValueError(f"{path}: record {n + 1}: step {steps[n]} after step {steps[n - 1]}, expected increasing steps")
    return records


def read_series(path):
    """Reads a PE series: columns step, time, pe."""
    header, raw, _ = _binary(path, [b"lsm-pe-series-1\n"], "PE series")
    if header.get("times") == "own":
        return Table(_records(path, raw, [("step", "<i8"), ("time", "<f8"), ("pe", "<f8")]), header)
    stored = _records(path, raw, [("step", "<i8"), ("pe", "<f8")])
    series = np.empty(len(stored), [("step", "<i8"), ("time", "<f8"), ("pe", "<f8")])
    series["step"], series["pe"] = stored["step"], stored["pe"]
    step0 = _number(path, header, "step0", int)
    series["time"] = _number(path, header, "time0") + (stored["step"] - step0) * _number(path, header, "dt")
    return Table(series, header)


def write_series(path, time, values, overwrite=False, **parameters):
    """Writes a series of your own, whose drops `postproc pick` finds: values at equal intervals of time, and parameters for its header. A
    sample is a step, from 0 on. \\raises ValueError for what is no series, FileExistsError unless overwrite; then nothing is written"""

    def refuse(what):
        raise ValueError(f"{path}: {what}")

    try:
        time, values = np.asarray(time, float), np.asarray(values, float)
    except (TypeError, ValueError) as error:
        refuse(f"{error}, expected numbers")
    for name, row in ("time", time), ("value", values):
        if row.ndim != 1:
            refuse(f"{name}s of shape {row.shape}, expected one row")
        if len(bad := np.flatnonzero(~np.isfinite(row))):
            refuse(f"{name} {bad[0] + 1} is {row[bad[0]]}, expected a finite number")
    if (n := len(time)) != len(values) or n < 2:
        refuse(f"{n} times and {len(values)} values, expected as many" if n != len(values) else f"{n} time, expected at least 2")
    if len(bad := np.flatnonzero(np.diff(time) <= 0)):
        refuse(f"time {bad[0] + 2} is {time[bad[0] + 1]:g} after {time[bad[0]]:g}, expected increasing times")
    dt = (time[-1] - time[0]) / (n - 1)
    even = time[0] + dt * np.arange(n)
    if (far := np.abs(time - even)).max() > 0.2 * dt:  # a log has rounded times
        refuse(f"time {far.argmax() + 1} is {time[far.argmax()]:g}, expected {even[far.argmax()]:g}: samples at equal intervals")
    head = dict(model="lsm", dt=repr(float(dt)), step0=0, time0=repr(float(time[0])), stride=1)
    for key, value in parameters.items():
        if key in head or key == "times" or not key.strip() or any(mark in key for mark in "=\n\r"):
            refuse(f"parameter {key!r}, expected another name")
        if len(str(value).splitlines()) != 1:
            refuse(f"parameter {key!r} is {value!r}, expected one line")
    lines = "".join(f"# {key} = {value}\n" for key, value in (head | parameters).items()).encode()
    records = np.rec.fromarrays([np.arange(n), values], [("step", "<i8"), ("pe", "<f8")])
    with open(path, "wb" if overwrite else "xb") as file:
        file.write(b"lsm-pe-series-1\n" + struct.pack("<q", len(lines)) + lines + records.tobytes())


def read_slip(path):
    """Reads a slip history: columns step_begin, step_end, pe; slip, work and stress of each place. Of a plane, slip and stress have the
    shape (records, strike, dip, component), with the components along strike and dip, and work is (records, strike, dip); dip is upwards."""
    header, raw, version = _binary(path, [b"lsm-slip-hist-1\n", b"lsm-slip-hist-2\n"], "slip history")
    names = ["bins", "bins_dip"][:version]
    shape = tuple(_number(path, header, name, int) for name in names)
    for name, bins in zip(names, shape):
        if bins < 1:
            raise ValueError(f"{path}: parameter '{name}' is {bins}, expected at least 1")
    components = (2,) if version == 2 else ()
    places = [("slip", "<f4", shape + components), ("work", "<f4", shape), ("stress", "<f4", shape + components)]
    return Table(_records(path, raw, [("step_begin", "<i8"), ("step_end", "<i8"), ("pe", "<f8")] + places, empty=True), header)


def spectrum(series, segment=None):
    """Power spectral density of PE by Welch's method (1967): columns frequency, density, error.

    The density is one-sided: its sum times the step of the frequencies is the variance. Segments of
    so many samples overlap by half; their linear trends are taken off, and they are weighted with a
    Hann window. Without segment: a power of two, at most 65536 and an eighth of the series. The
    error is one standard deviation for noise.
    """
    step, pe = series["step"], series["pe"]
    n = segment or min(1 << 16, 1 << max(3, (len(pe) // 8).bit_length() - 1))
    if not 8 <= n <= len(pe):
        raise ValueError(f"segment of {n} samples, expected from 8 to the {len(pe)} of the series")
    gap = np.flatnonzero(np.diff(step) != step[1] - step[0])
    if len(gap):
        raise ValueError(f"step {step[gap[0] + 1]} after step {step[gap[0]]}, expected a sample every {step[1] - step[0]} steps")
    spacing = (series["time"][-1] - series["time"][0]) / (len(pe) - 1)
    window, line = 0.5 - 0.5 * np.cos(2 * np.pi * np.arange(n) / n), np.arange(n) - (n - 1) / 2
    power, hop = np.sum(window**2), n - n // 2
    sums, starts = np.zeros(n // 2 + 1), range(0, len(pe) - n + 1, hop)
    for start in starts:
        part = pe[start:start + n] - np.mean(pe[start:start + n])
        sums += np.abs(np.fft.rfft((part - line * np.dot(line, part) / np.dot(line, line)) * window))**2
    count, overlap = len(starts), np.dot(window[hop:], window[:n - hop]) / power
    sides = np.where((np.arange(n // 2 + 1) == 0) | (2 * np.arange(n // 2 + 1) == n), 1.0, 2.0)  # 0 and n/2 have no counterpart
    density = sides * sums * spacing / (power * count)
    error = density * np.sqrt(2 / sides * (1 + 2 * (1 - 1 / count) * overlap**2) / count)
    return Table(np.rec.fromarrays([np.fft.rfftfreq(n, spacing), density, error], names="frequency,density,error"), getattr(series, "header", {}))


def rates(events, width, column="size"):
    """Events, and what they release, over time: columns time (centre of a bin), events, rate, released, release_rate.

    The edges of the bins are multiples of their width; empty bins count. column: "size" or "slip_moment".
    """
    _expect_positive(width=width)
    bins = np.floor(np.round(events["t_start"] / width, 9)).astype(np.int64)
    first, count = (bins.min(), bins.max() - bins.min() + 1) if len(bins) else (0, 0)
    number = np.bincount(bins - first, minlength=count)
    released = np.bincount(bins - first, events[column], count)
    time = (first + np.arange(count) + 0.5) * width
    return Table(np.rec.fromarrays([time, number, number / width, released, released / width], names="time,events,rate,released,release_rate"),
                 getattr(events, "header", {}))


def units(length, p_speed, density, thickness=None):
    """What one model unit of the fault is in SI, for a unit of length (m), a speed of P-waves (m/s), a density (kg/m^3) and a thickness (m;
    without it the unit of length): see postproc/units.md. A dict: length, time, velocity, stress, energy, moment."""
    thickness = length if thickness is None else thickness
    _expect_positive(length=length, p_speed=p_speed, density=density, thickness=thickness)
    velocity = p_speed / P_SPEED
    stress, volume = density / DENSITY * velocity**2, length**2 * thickness
    return dict(length=length, time=length / velocity, velocity=velocity, stress=stress, energy=stress * volume,
                moment=density * (S_SPEED * velocity)**2 * volume)
