#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Is a drop of the springs' potential energy slip, or an exchange with the load of the plates and with waves? †

slip_or_exchange.py events RUN OUT.csv.xz [FROM]    the events >= 1e-4 of a run from a time on (8000), with the work of friction and `chance`
slip_or_exchange.py figure OUT RUN FROM TO...   a stretch of each run, reflecting, leaky, absorbing: OUT.png and OUT.svg

RUN is the prefix of the files of a run of inputs/fault.in with ruptures=yes, FOLDER/fault in a study; figure needs extra=fault_energy as well.
lsm.slip says what counts as slip.
"""
import lzma
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "python"))
import lsm  # noqa: E402
from lsm import LOADING  # noqa: E402
from lsm.drawing import draw  # noqa: E402
from lsm.slip import SLIP, Friction, judged, recorded  # noqa: E402
from lsm.tables import text_of  # noqa: E402


def events(run, output, begin=LOADING):
    begin = float(begin)
    catalogue, history = lsm.read_catalogue(f"{run}.catalogue.csv"), Friction(f"{run}.slip.bin")
    kept = recorded(catalogue, history, begin)
    begins, ends = kept["step_start"].astype(float), kept["step_end"].astype(float)
    columns = {} if "friction_work" in kept.dtype.names else {"friction_work": history.worked(begins, ends), "friction_total": history.done(ends)}
    columns["chance"] = judged(history, kept, history.step(begin))[1]
    with lzma.open(output, "wt") as file:
        file.write("# lsm-catalogue 1\n" + "".join(f"# {key} = {value}\n" for key, value in catalogue.header.items()))
        file.write(f"# selected = t_start >= {begin:g}, size >= 1e-4; chance: results/slip_or_exchange.py\n")
        file.write(",".join([*kept.dtype.names, *columns]) + "\n")
        for event, *of in zip(kept, *columns.values()):
            file.write(",".join([*(text_of(event[name]) for name in kept.dtype.names), *(f"{number:.9g}" for number in of)]) + "\n")


# ---- other series


def with_phases(series, rng):
    """A Gaussian series whose changes have the spectrum of those of another: random phases (Theiler et al. 1992, Physica D 58, 77)."""
    spectrum = np.abs(np.fft.rfft(np.diff(series)))
    phases = np.exp(2j * np.pi * rng.random(len(spectrum)))
    phases[0] = np.sign(series[-1] - series[0])  # the mean change stays
    return np.concatenate([[0.0], np.cumsum(np.fft.irfft(spectrum * phases, len(series) - 1))])


# ---- pictures


def stretch(run, begin, end):
    """PE, kinetic energy, frictional work a time, and events >= 1e-3 (begin, end, whether slip) of a stretch of a run."""
    series, history, catalogue = lsm.read_series(f"{run}.pe.bin"), Friction(f"{run}.slip.bin"), lsm.read_catalogue(f"{run}.catalogue.csv")
    shown = series[(series["time"] >= begin) & (series["time"] <= end)]
    shown = shown[::max(1, len(shown) // 3000)]
    beside = np.loadtxt(f"{run}.energy.txt")
    time = history.time(beside[:, 0])
    seen = (time >= begin) & (time <= end)
    at = np.arange(begin, end)
    lines = (shown["time"], shown["pe"]), (time[seen], beside[seen, 1]), (at + 0.5, history.worked(history.step(at), history.step(at + 1)))
    kept = recorded(catalogue, history, -np.inf)
    slip = judged(history, kept, history.steps[0])[0] > SLIP
    spans = [(max(a, begin), min(z, end), s) for a, z, s, size in zip(kept["t_start"], kept["t_end"], slip, kept["size"])
             if size >= 1e-3 and z > begin and a < end]
    return lines, spans


def figure(base, *stretches):
    runs = [(title, float(begin), float(end), *stretch(run, float(begin), float(end)))
            for title, run, begin, end in zip(("reflecting", "leaky", "absorbing"), *[iter(stretches)] * 3)]
    # Equal scales beside each other: energies begin at the least of the stretch
    highest = [1.05 * max(np.ptp(lines[k][1]) if k == 0 else lines[k][1].max() for _, _, _, lines, _ in runs) for k in range(3)]
    script = f"set multiplot layout 3,{len(runs)} columnsfirst margins 0.08,0.98,0.09,0.94 spacing 0.08,0.05\nunset key\n"
    for title, begin, end, lines, spans in runs:
        script += "unset object\n" + "".join(
            f"set object {n} rect from {a - begin:.2f},graph 0 to {z - begin:.2f},graph 1 fc rgb '{'#c9b5e0' if slip else '#dddddd'}' fs solid noborder behind\n"
            for n, (a, z, slip) in enumerate(spans, 1))
        for label, (x, y), most in zip(("potential energy", "kinetic energy", "frictional work per time"), lines, highest):
            first, last, left = label == "potential energy", label == "frictional work per time", title == runs[0][0]
            script += f"set title '{title if first else ''}'\nset xlabel '{'time' if last else ''}'\nset format x '{'%g' if last else ''}'\n"
            script += f"set ylabel '{label if left else ''}'\n"
            script += f"set xrange [0:{end - begin:g}]\nset yrange [0:{most:.3g}]\nset datafile separator\nplot '-' w l lt 8\n"
            script += "\n".join(f"{a - begin:.3f} {b - (y.min() if first else 0):.6g}" for a, b in zip(x, y)) + "\ne\n"
    draw(base, script + "unset multiplot", 1400, 760)


if __name__ == "__main__":
    commands = dict(events=events, figure=figure)
    if len(sys.argv) < 4 or sys.argv[1] not in commands:
        sys.exit(__doc__)
    try:
        commands[sys.argv[1]](*sys.argv[2:])
    except (OSError, ValueError) as error:
        sys.exit(f"slip_or_exchange.py: {error}")
