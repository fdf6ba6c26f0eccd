#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Is a drop of the springs' potential energy slip, or an exchange with the load of the plates and with waves? †

slip_or_exchange.py events RUN OUT.csv.xz [FROM]    the events >= 1e-4 of a run from a time on (8000), with the work of friction and what is below
slip_or_exchange.py kinds OUT.csv FILE.csv.xz...    means of these by size
slip_or_exchange.py rates OUT FILE.csv.xz...        how often there is an event, and one that is slip: OUT.csv, OUT.png and OUT.svg
slip_or_exchange.py surrogates POSTPROC OUT.csv RUN...   events of series that have the spectrum of a run and nothing else of it
slip_or_exchange.py energies POSTPROC OUT.csv RUN...     events of other energies than that of the springs, from 8000 on
slip_or_exchange.py places OUT.csv RUN...           whether events of three steps or less sit at one place
slip_or_exchange.py switched OUT.csv RUN...         events in each 1000 time units of runs that continue others with other damping
slip_or_exchange.py quality OUT.csv RUN...          how fast blocks that were glued together stop ringing, with their quality factor
slip_or_exchange.py kinetic OUT.csv RUN...          mean kinetic energy in each 2000 time units, of the RUN.energy.txt of extra=fault_energy
slip_or_exchange.py motion OUT.csv RUN              kinetic energy by period and by radius of the disc, of the RUN.STEP.dump of extra=fault_dump
slip_or_exchange.py figure OUT RUN FROM TO...   a stretch of each run, of preset paper, preset slip and the default: OUT.png and OUT.svg
slip_or_exchange.py decides OUT POINTS.csv          numbers over viscosity and impedance, of calibrate.py collect: OUT.png and OUT.svg

RUN is the prefix of the files of a run of inputs/fault.in with ruptures=yes, FOLDER/fault in a study; energies and figure need extra=fault_energy as well.
lsm.slip says what counts as slip.
"""
import lzma
import struct
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "python"))
import lsm  # noqa: E402
from lsm import LOADING, summary  # noqa: E402
from lsm.drawing import draw  # noqa: E402
from lsm.paper import roll_off_gain  # noqa: E402
from lsm.slip import AT_ONCE, SLIP, History, excess_of, friction_share, gathered, judged, jumps, recorded, slip_share, time_and_share  # noqa: E402
from lsm.tables import memory_of, rows_of, text_of, write_table  # noqa: E402

DECADES = ((1e-4, 1e-3), (1e-3, 1e-2), (1e-2, 1e-1), (1e-1, np.inf))
MEMORY = 1.0  # of the picker, for sums of energies; that of preset paper


def name_of(run):
    """Name of a run: of its folder in a study."""
    return Path(run).resolve().parent.name if Path(run).name == "fault" else Path(run).name


def events(run, output, begin=LOADING):
    begin = float(begin)
    catalogue, history = lsm.read_catalogue(f"{run}.catalogue.csv"), History(f"{run}.slip.bin")
    kept = recorded(catalogue, history, begin)
    first = (begin - history.offset) / history.dt
    begins, ends = kept["step_start"].astype(float), kept["step_end"].astype(float)
    series = lsm.read_series(f"{run}.pe.bin")
    columns = {} if "friction_work" in kept.dtype.names else {"friction_work": history.worked(begins, ends), "friction_total": history.done(ends)}
    columns |= dict(zip(("rank", "chance"), judged(history, kept, first)[1:])) | {"together": gathered(history, kept, first)}
    columns["jump"] = jumps(np.asarray(series["pe"]), np.asarray(series["step"]), kept)
    with lzma.open(output, "wt") as file:
        file.write("# lsm-catalogue 1\n" + "".join(f"# {key} = {value}\n" for key, value in catalogue.header.items()))
        file.write(f"# selected = t_start >= {begin:g}, size >= 1e-4; rank, chance, together, jump: results/slip_or_exchange.py\n")
        file.write(",".join([*kept.dtype.names, *columns]) + "\n")
        for event, *of in zip(kept, *columns.values()):
            file.write(",".join([*(text_of(event[name]) for name in kept.dtype.names), *(f"{number:.9g}" for number in of)]) + "\n")


def kinds(output, *paths):
    rows = []
    for path in paths:
        found = lsm.read_catalogue(path)
        every, loaded = excess_of(found)
        for low, high in DECADES:
            within = (found["size"] >= low) & (found["size"] < high)
            of, excess = found[within], every[within]
            if len(of) >= 5:
                size = of["size"]
                rows.append(
                    dict(run=Path(path).name.split(".")[0], length=float(found.header["length"]), seed=found.header["seed"], smallest=low,
                         events=len(of), excess=np.sum(excess * size) / np.sum(size), friction=friction_share(size, excess, loaded[within]),
                         rank=np.mean(of["rank"]), together=np.mean(of["together"]), chance=np.mean(of["chance"]),
                         slip=slip_share(excess, of["chance"]), jump=np.mean(of["jump"] > AT_ONCE)))
    write_table(output, [
        "Events by size; excess: of their sum; friction: its share of what their springs lose, with what these are loaded with meanwhile;",
        "slip: share that is slip, beyond chance; jump: share more than half of which falls in one step (slip_or_exchange.py kinds)"
    ], rows)


FAULTS = {"damping": "hardly damped", "slip": "preset slip"}
RATES = """set logscale xy
set xrange [100:2300]
set yrange [10:1000]
set xtics (120, 240, 480, 945, 1440, 1890)
set xlabel 'length of the fault'
set ylabel 'mean time between events >= 0.01'
set key outside bottom center horizontal maxcols 2 height 1 Left reverse
set datafile separator comma
plot """ + ", ".join(f"table u (strcol(1) eq '{name}' ? $2 : NaN):{column} w p lc {colour} pt {point} t '{name}, {what}'"
                     for name, colour in (("hardly damped", 6), ("preset slip", 2)) for what, column, point in (
                         ("all", 7, 6), ("those that are slip", 9, 7))) + ", 18000/x w l dt 2 lc rgb '#888888' t 'as 1 / length: independent places'"


def rates(base, *paths):
    """Mean times between events of at least a size, and between those that are slip."""
    rows = []
    for path in map(Path, paths):
        found = lsm.read_catalogue(path)
        excess, _ = excess_of(found)
        row = dict(fault=FAULTS[path.resolve().parent.name], length=f"{float(found.header['length']):g}", seed=found.header["seed"])
        for least in (1e-3, 1e-2, 1e-1):
            time, share = time_and_share(found, excess, found["size"] >= least)
            row |= {f"all_{least:g}": time, f"share_{least:g}": share, f"slip_{least:g}": time / share if share > 0 else np.nan}
        rows.append(row)
    rows.sort(key=lambda row: (row["fault"], float(row["length"])))
    write_table(f"{base}.csv",
                ["Mean time between events of at least a size; share, slip: of those that are slip, beyond chance (slip_or_exchange.py rates)"], rows)
    draw(base, RATES, 800, 520)


# ---- events of other series


def write_series(path, pe, dt):
    head = f"# model = lsm\n# dt = {dt:.17g}\n# step0 = 0\n# time0 = 0\n# stride = 1\n".encode()
    records = np.zeros(len(pe), [("step", "<i8"), ("pe", "<f8")])
    records["step"], records["pe"] = np.arange(len(pe)), pe
    Path(path).write_bytes(b"lsm-pe-series-1\n" + struct.pack("<q", len(head)) + head + records.tobytes())


def numbers(postproc, pe, dt, memory=MEMORY):
    """Number, mean time, exponent, and gamma and B of all times, of the events >= 1e-4 of a series, by postproc."""
    with tempfile.TemporaryDirectory() as work:
        write_series(f"{work}/pe.bin", pe, dt)
        common = dict(check=True, stdout=subprocess.PIPE, text=True)
        subprocess.run([postproc, "pick", f"{work}/pe.bin", "-o", f"{work}/picked.csv", "--memory-time", str(memory)], **common)
        if not np.any(lsm.read_catalogue(f"{work}/picked.csv")["size"] >= 1e-4):
            return dict(events=0, **dict.fromkeys(("one_in", "exponent", "gamma", "B"), np.nan))
        row, = summary.rows_of(postproc, [f"{work}/picked.csv"], ["1e-4"], ["1e-4:1e-1"], shortest=0)
    keys = dict(events="events_0.0001", one_in="mean_time_0.0001", exponent="exponent_1e-4:1e-1", gamma="gamma_0.0001", B="B_0.0001")
    return {name: float(row[key]) if row[key] else np.nan for name, key in keys.items()}


def with_phases(series, rng, response=None):
    """A Gaussian series whose changes have the spectrum of those of another: random phases (Theiler et al. 1992, Physica D 58, 77).

    response: of an oscillator, by frequency; the changes are then its velocity, with the mean and the variance of those of the other
    """
    spectrum = np.abs(np.fft.rfft(np.diff(series)))
    if response is not None:
        spectrum[1:] = response[1:] * np.sqrt(np.sum(spectrum[1:]**2) / np.sum(response[1:]**2))
    phases = np.exp(2j * np.pi * rng.random(len(spectrum)))
    phases[0] = np.sign(series[-1] - series[0])  # the mean change stays
    return np.concatenate([[0.0], np.cumsum(np.fft.irfft(spectrum * phases, len(series) - 1))])


RINGING = 33.0  # period of the blocks between the plates


def oscillator(samples, dt, viscosity):
    """Velocity of a linear oscillator that has the period of the blocks, shaken by white noise, by frequency of so many samples."""
    w, own = 2 * np.pi * np.fft.rfftfreq(samples, dt), 2 * np.pi / RINGING
    return w / np.abs(own**2 - w**2 + 1j * w * viscosity)


def mean_return(series, dt, memory=MEMORY):
    """Mean time between falls of the smoothed change through zero, 2 pi sigma / sigma of the derivative, were it Gaussian (Rice 1944)."""
    keep = np.exp(-dt / memory)
    frequency = 2 * np.pi * np.fft.rfftfreq(len(series) - 1)
    power = np.abs(np.fft.rfft(np.diff(series)) * (1 - keep) / (1 - keep * np.exp(-1j * frequency)))**2
    power[0] = 0.0
    return 2 * np.pi * np.sqrt(np.sum(power) / np.sum(power * (2 * np.sin(frequency / 2) / dt)**2))


def without_slip(run, step, pe):
    """The series with the mean of all other changes in place of those within events >= 1e-3 that count as slip."""
    history, found = History(f"{run}.slip.bin"), lsm.read_catalogue(f"{run}.catalogue.csv")
    kept = found[(found["step_start"] >= step[0]) & (found["step_end"] <= min(step[-1], history.steps[-1])) & (found["size"] >= 1e-4)]
    slip = kept[(judged(history, kept, float(step[0]))[0] > SLIP) & (kept["size"] >= 1e-3)]
    changes, within = np.diff(pe), np.zeros(len(pe) - 1, bool)
    for begin, end in zip(np.searchsorted(step, slip["step_start"]), np.searchsorted(step, slip["step_end"])):
        within[begin:end] = True
    changes[within] = np.mean(changes[~within])
    return np.concatenate([[0.0], np.cumsum(changes)])


def surrogates(postproc, output, *runs):
    rows = []
    for run in runs:
        series, rng = lsm.read_series(f"{run}.pe.bin"), np.random.default_rng(1)
        dt, kept = float(series.header["dt"]), series["time"] >= LOADING
        memory = memory_of(lsm.read_catalogue(f"{run}.catalogue.csv").header)
        pe, step = np.asarray(series["pe"][kept]), np.asarray(series["step"][kept])
        others = {"run": pe, "without slip": without_slip(run, step, pe)} | {f"phases {n}": with_phases(pe, rng) for n in (1, 2, 3)}
        viscosity = float(series.header.get("viscosity", 0))
        if viscosity > 0:
            others["oscillator"] = with_phases(pe, rng, oscillator(len(pe) - 1, dt, viscosity))
        for name, other in others.items():
            rows.append(dict(run=name_of(run), series=name, **numbers(postproc, other, dt, memory), by_spectrum=mean_return(other, dt, memory)))
    write_table(output, ["Events >= 1e-4, memory of the catalogue; phases: series of the same spectrum; by_spectrum: mean time of Rice"], rows)


def energies(postproc, output, *runs):
    rows = []
    for run in runs:
        series, beside = lsm.read_series(f"{run}.pe.bin"), np.loadtxt(f"{run}.energy.txt")
        head = lsm.read_catalogue(f"{run}.catalogue.csv").header
        at = np.searchsorted(series["step"], beside[:, 0])
        kept = (at < len(series)) & (series["time"][np.minimum(at, len(series) - 1)] >= LOADING)
        pe, (step, kinetic, approach, _) = np.asarray(series["pe"][at[kept]]), beside[kept].T
        load, dt = -float(head["stress"]) * float(head["length"]) * approach, float(series.header["dt"]) * (step[1] - step[0])
        for name, energy in (("springs", pe), ("springs and load", pe + load), ("springs, load and motion", pe + load + kinetic)):
            rows.append(dict(run=name_of(run), energy=name, time=dt * (len(pe) - 1), **numbers(postproc, energy, dt)))
    write_table(output, [f"Events >= 1e-4 of sums of energies, memory {MEMORY}; load: stress x length x distance of the plates"], rows)


def places(output, *runs):
    """Do events of three steps or less sit at one place? Where the fault slips farthest around them, and around as many random times."""
    rows = []
    for run in runs:
        history, catalogue = History(f"{run}.slip.bin"), lsm.read_catalogue(f"{run}.catalogue.csv")
        kept = recorded(catalogue, history, LOADING)
        begin, end, around = kept["step_start"].astype(float), kept["step_end"].astype(float), 0.3 / history.dt
        brief = 0.5 * (begin + end)[end - begin <= 3]
        first = max((LOADING - history.offset) / history.dt, history.steps[0])
        anywhen = np.random.default_rng(1).uniform(first + around, history.steps[-1] - around, len(brief))
        shares = [
            np.bincount(np.argmax(history.slipped(at + around) - history.slipped(at - around), axis=1)).max() / len(brief) if len(brief) else np.nan
            for at in (brief, anywhen)
        ]
        rows.append(dict(run=name_of(run), events=len(kept), brief=len(brief), commonest=shares[0], at_random_times=shares[1]))
    write_table(output, ["Events >= 1e-4 of three steps or less: share of them at the place where most are (slip_or_exchange.py places)"], rows)


def switched(output, *runs):
    rows = []
    for run in runs:
        found, time = lsm.read_catalogue(f"{run}.catalogue.csv"), lsm.read_series(f"{run}.pe.bin")["time"]
        edges = np.arange(time[0], time[-1], 1000.0)
        counts = np.histogram(found["t_start"][found["size"] >= 1e-4], edges)[0]
        rows += [dict(run=name_of(run), viscosity=found.header["viscosity"], begin=1000 * n, events=count) for n, count in enumerate(counts)]
    write_table(output, ["Events >= 1e-4 in 1000 time units from `begin` after the damping was changed"], rows)


def kinetic(output, *runs):
    rows = []
    for run in runs:
        beside, head = np.loadtxt(f"{run}.energy.txt"), lsm.read_series(f"{run}.pe.bin").header
        time = (beside[:, 0] - float(head["step0"])) * float(head["dt"]) + float(head["time0"])
        for begin in np.arange(0, time[-1] - 1999, 2000.0):
            seen = (time >= begin) & (time < begin + 2000)
            if seen.any():
                rows.append(dict(run=name_of(run), begin=begin, kinetic=beside[seen, 1].mean()))
    write_table(output, ["Mean kinetic energy in 2000 time units from `begin` (slip_or_exchange.py kinetic)"], rows)


# ---- which discs move

PERIODS, RADII = (0.24, 0.5, 1, 2, 5, 10, 20, 100), (0.1, 0.12, 0.2, 0.4, 1.01)


def motion(output, run):
    frames = sorted(Path(run).parent.glob(f"{Path(run).name}.*.dump"))
    if len(frames) < 2:
        raise ValueError(f"{run}.STEP.dump: {len(frames)} files, expected at least two")
    columns = [np.array(frame.read_text().split("vx vy", 1)[1].split(), float).reshape(-1, 8) for frame in frames]
    steps = [int(frame.name.split(".")[-2]) for frame in frames]
    dt = (steps[1] - steps[0]) * float(lsm.read_catalogue(f"{run}.catalogue.csv").header["dt"])
    radius, velocity = columns[0][:, 5], np.array([frame[:, 6:8] for frame in columns])
    mass = radius**2
    power = np.abs(np.fft.rfft((velocity - velocity.mean(axis=0)) * np.hanning(len(frames))[:, None, None], axis=0))**2
    energy = power.sum(axis=2) * mass
    period = 1 / np.maximum(np.fft.rfftfreq(len(frames), dt), 1e-9)

    def shares(of):
        return dict(largest_disc=of.max() / of.sum(),
                    **{f"to_{b:g}": of[(radius >= a) & (radius < b)].sum() / of.sum()
                       for a, b in zip(RADII, RADII[1:])})

    rows = []
    for low, high in zip(PERIODS, PERIODS[1:]):
        of = energy[(period >= low) & (period < high)].sum(axis=0)
        rows.append(dict(shortest=low, longest=high, share=of.sum() / energy.sum(), **shares(of)))
    rows.append(dict(shortest="mass", longest="", share=1.0, **shares(mass)))
    write_table(output, [
        f"Kinetic energy by period, {len(frames)} frames; to_R: share of discs up to this radius; last row: of the mass (slip_or_exchange.py motion)"
    ], rows)


# ---- pictures


def stretch(run, begin, end):
    """PE, kinetic energy, frictional work a time, and events >= 1e-3 (begin, end, whether slip) of a stretch of a run."""
    series, history, catalogue = lsm.read_series(f"{run}.pe.bin"), History(f"{run}.slip.bin"), lsm.read_catalogue(f"{run}.catalogue.csv")
    shown = series[(series["time"] >= begin) & (series["time"] <= end)]
    shown = shown[::max(1, len(shown) // 3000)]
    beside = np.loadtxt(f"{run}.energy.txt")
    time = beside[:, 0] * history.dt + history.offset
    seen = (time >= begin) & (time <= end)
    at = np.arange(begin, end)
    step = (at - history.offset) / history.dt
    lines = (shown["time"], shown["pe"]), (time[seen], beside[seen, 1]), (at + 0.5, history.worked(step, step + 1 / history.dt))
    kept = recorded(catalogue, history, -np.inf)
    slip = judged(history, kept, history.steps[0])[0] > SLIP
    spans = [(max(a, begin), min(z, end), s) for a, z, s, size in zip(kept["t_start"], kept["t_end"], slip, kept["size"])
             if size >= 1e-3 and z > begin and a < end]
    return lines, spans


def figure(base, *stretches):
    script = f"set multiplot layout 3,{len(stretches) // 3} columnsfirst margins 0.08,0.98,0.09,0.94 spacing 0.1,0.05\nunset key\n"
    for title, run, begin, end in zip(("hardly damped (preset paper)", "preset slip", "damped (default)"), *[iter(stretches)] * 3):
        begin, end = float(begin), float(end)
        lines, spans = stretch(run, begin, end)
        script += "unset object\n" + "".join(
            f"set object {n} rect from {a - begin:.2f},graph 0 to {z - begin:.2f},graph 1 fc rgb '{'#f3b26b' if slip else '#c3dcf2'}' fs solid noborder behind\n"
            for n, (a, z, slip) in enumerate(spans, 1))
        for label, (x, y) in zip(("potential energy", "kinetic energy", "frictional work per time"), lines):
            first, last = label == "potential energy", label == "frictional work per time"
            script += f"set title '{title if first else ''}'\nset xlabel '{'time' if last else ''}'\nset ylabel '{label}'\nset format x '{'%g' if last else ''}'\n"
            script += f"set xrange [0:{end - begin:g}]\nset yrange [{'*' if first else 0}:*]\nset datafile separator\nplot '-' w l lt 8\n"
            script += "\n".join(f"{a - begin:.3f} {b:.6g}" for a, b in zip(x, y)) + "\ne\n"
    draw(base, script + "unset multiplot", 1400, 760)


PANELS = (  # label, column, lines of the paper and of earthquakes, how it is drawn
    ("mean time between events", "mean_time_0.0001", {"paper": 15.2}, "set logscale y\nset yrange [5:500]"),
    ("gamma of all times", "gamma_0.0001", {"paper": 0.995, "earthquakes": 0.67}, "unset logscale y\nset yrange [0:1.4]"),
    ("exponent, 10^{-4} to 0.1", "exponent_1e-4:1e-1", {"paper": 1.07}, "set yrange [0.8:1.5]"),
    ("excess of friction", "excess", {}, "set yrange [0:2]"),
    ("share of time in events", "in_events", {"paper": 1 / 3}, "set yrange [0:0.5]"),
    ("evidence of a roll-off, 2 ln L", "roll_off_gain", {"paper": 3.84},
     "set nonlinear y via sqrt(y) inverse y**2\nset yrange [0:130]\nset ytics (0, 5, 10, 20, 50, 100)"),
)


def decides(base, points):
    """Lines over the viscosity, one for each impedance: mean of the packings at length 120, with their deviation, and length 480."""
    with open(points) as lines:
        rows = [
            row | {"roll_off_gain": roll_off_gain(row)} for row in rows_of(lines)
            if row["point"].startswith("d_") and row["stopped"] == "no" and float(row["memory"]) == MEMORY
        ]
    impedances = sorted({row["impedance"] for row in rows}, key=float)
    styles = [(impedance, length, f"lc {colour} pt {point} dt {1 if length == '120' else 3}") for impedance, colour in zip(impedances, (2, 8, 6))
              for length, point in (("120", 7), ("480", 6))]
    printed = "dt 2 lc rgb '#888888'", "dt 4 lc 3"
    script = """set multiplot layout 2,3 margins 0.065,0.99,0.2,0.98 spacing 0.08,0.12
set logscale x
set xrange [3e-4:0.08]
set xlabel 'viscosity'
set datafile separator
"""
    for n, (label, key, given, how) in enumerate(PANELS):
        lines, data = [f"{value:g} w l {printed[name == 'earthquakes']} notitle" for name, value in given.items()], ""
        for impedance, length, style in styles:
            at = {}
            for row in rows:
                if row["impedance"] == impedance and row["length"] == length and row[key] != "":
                    at.setdefault(float(row["viscosity"]), []).append(float(row[key]))
            if at:
                lines.append(f"'-' w yerrorlines {style} notitle")
                data += "".join(f"{x:g} {np.mean(y):.5g} {np.std(y, ddof=1) if len(y) > 1 else 0:.5g}\n" for x, y in sorted(at.items())) + "e\n"
        if n == 0:
            script += "set key at screen 0.5,0.005 center bottom vertical maxrows 2 Left reverse samplen 3\n"
            lines += [f"keyentry w yerrorlines {style} t 'impedance {impedance}, length {length}'" for impedance, length, style in styles]
            lines += [f"keyentry w l {line} t '{name}'" for line, name in zip(printed, ("paper, limits †", "earthquakes"))]
        script += f"{how}\nset ylabel '{label}'\nplot {', '.join(lines)}\n{data}unset key\n"
    draw(base, script + "unset multiplot", 1400, 860)


def quality(output, *runs):
    """Decay of PE's amplitude in periods, until it is less than 0.3 of the first one, before waves that nothing damps are left."""
    rows, length = [], RINGING
    for run in runs:
        series = lsm.read_series(f"{run}.pe.bin")
        time, n = series["time"], int(length / (series["time"][1] - series["time"][0]))
        stretches = series["pe"][:len(time) // n * n].reshape(-1, n)
        x = np.arange(n) - 0.5 * (n - 1)
        slopes = stretches @ x / (x @ x)
        amplitude = np.std(stretches - np.outer(slopes, x), axis=1)
        last = max(2, next((k for k, a in enumerate(amplitude) if a < 0.3 * amplitude[0]), len(amplitude)))
        rate = -np.polyfit(length * np.arange(last), np.log(amplitude[:last]), 1)[0]
        rows.append(
            dict(viscosity=float(series.header["viscosity"]), impedance=float(series.header["impedance"]), first=amplitude[0], second=amplitude[1],
                 fourth=amplitude[3], stretches=last, rate=rate, quality=np.pi / (RINGING * rate)))
    comment = "Glued blocks: amplitude of PE in periods of 33 time units, rate at which it decays in so many, quality factor at a period of 33"
    write_table(output, [f"{comment} (slip_or_exchange.py quality)"], rows)


if __name__ == "__main__":
    commands = dict(quality=quality, kinetic=kinetic, motion=motion, decides=decides, events=events, kinds=kinds, rates=rates, surrogates=surrogates,
                    energies=energies, places=places, switched=switched, figure=figure)
    if len(sys.argv) < 4 or sys.argv[1] not in commands:
        sys.exit(__doc__)
    try:
        commands[sys.argv[1]](*sys.argv[2:])
    except (OSError, ValueError) as error:
        sys.exit(f"slip_or_exchange.py: {error}")
