# SPDX-License-Identifier: GPL-2.0-or-later
"""Tables of validation.md, as head and rows, and the numbers of its sentences; tables.py writes them into the page."""
import itertools
import math
from pathlib import Path

import rupture_benchmark
from lsm.tables import read
from values import Value

FOLDER = Path(__file__).resolve().parent
FLAT = {"TPV205": "rupture_benchmark-stations.csv", "TPV3": "rupture_tpv3-stations.csv"}
STATIONS = FLAT | {"TPV101": "rupture_tpv101-stations.csv"}
CONVERGENCE, BARRIER = "rupture_varied-convergence.csv", "rupture_varied-barrier.csv"


def order_of(before, after, key):
    """Of convergence from one spacing to the next."""
    return math.log(before[key] / after[key]) / math.log(before["spacing"] / after["spacing"])


def with_orders(runs, show):
    """A cell for each run, with the order of convergence from the one before it. show: (key, factor, digits)"""
    key, factor, places = show
    cells = [f"{factor * run[key]:.{places}f}" for run in runs]
    return cells[:1] + [f"{cell} ({order_of(a, b, key):.1f})" for cell, (a, b) in zip(cells[1:], itertools.pairwise(runs))]


def stations_of(name, chosen):
    texts = ("run", "reference")
    return [{key: value if key in texts else float(value) for key, value in row.items()} for row in read(FOLDER / STATIONS[name]) if chosen(row)]


def flat_runs(name):
    """Differences from the boundary integral over all stations, of each spacing."""
    groups = itertools.groupby(stations_of(name, lambda row: row["reference"].startswith("boundary")), lambda row: row["spacing"])
    return [rupture_benchmark.summary(list(some)) | {"spacing": spacing} for spacing, some in groups]


FLAT_ROWS = {
    "arrival, rms (s)": ("arrival", 1, 4), "largest difference of an arrival (s)": ("arrival_max", 1, 3), "slip, rms (%)": ("slip", 100, 2),
    "largest difference of a slip (%)": ("slip_max", 100, 2), "slip rate, relative L2 (%)": ("rate_l2", 100, 1),
    "peak slip rate, rms (%)": ("peak", 100, 1)
}


def rupture_flat_table():
    """TPV205-2D and TPV3-2D: until 6 s, differences from a boundary integral."""
    runs = {name: flat_runs(name) for name in FLAT}
    spacings = [f"{run['spacing']:g} m" for run in runs["TPV205"]]
    out = [[f"{name}: {text}", *with_orders(some, show)] for name, some in runs.items() for text, show in FLAT_ROWS.items()]
    out = [row + ["-"] * (len(spacings) + 1 - len(row)) for row in out]
    return ["difference until 6 s (order of convergence)", *spacings], out


def tpv101_runs():
    """Differences of TPV101-2D from the finest boundary integral: of coarser ones, and of the lattices."""
    coarser = [{key: float(value) for key, value in row.items()} for row in read(FOLDER / CONVERGENCE)]
    return {"boundary integral": coarser, "lattice": flat_runs("TPV101")}


def rupture_state_table():
    """TPV101-2D: until 7 s, differences from the finest boundary integral."""
    runs = tpv101_runs()
    heads = [f"{name} {run['spacing']:g} m" for name, some in runs.items() for run in some]
    rows = {text: show for text, show in FLAT_ROWS.items() if show[0] in ("arrival", "slip", "peak")}
    return ["difference until 7 s (order of convergence)", *heads], [
        [text, *(cell for some in runs.values() for cell in with_orders(some, show))] for text, show in rows.items()
    ]  # yapf: disable


def barrier_runs():
    """{(method, spacing): largest energy of a barrier that breaks, smallest of one that does not, energy release rate at a tip that is held}"""
    groups = {}
    for row in read(FOLDER / BARRIER):
        groups.setdefault((row["method"], row["spacing"]), []).append(row)
    out = {}
    for name, some in groups.items():
        free = [(float(row["energy"]), float(row["reach"]) > 9) for row in some if not row["held"]]
        out[name] = max(energy for energy, broke in free if broke), min(energy for energy, broke in free
                                                                        if not broke), next(float(row["held"]) for row in some if row["held"])
    return out


def rupture_barrier_table():
    """TPV3-2D with a barrier, MJ/m^2."""
    return ["MJ/m2", "largest energy that breaks", "smallest that stops the rupture", "energy release rate at a tip that is held"], [
        [f"{method} {spacing} m", *(f"{value:.1f}" for value in values)] for (method, spacing), values in barrier_runs().items()
    ]  # yapf: disable


def plane_runs():
    return [{key: value if key == "run" else float(value or "nan")
             for key, value in row.items()} for row in read(FOLDER / "rupture_3d-convergence.csv")]


PLANE_ROWS = {
    "arrival, rms (s)": ("arrival", 1, 3), "largest difference of an arrival (s)": ("arrival_max", 1, 2), "mean of the arrivals (s)": ("mean", 1, 3),
    "scatter of the arrivals (s)": ("scatter", 1, 3), "slip at 12 s, rms (%)": ("slip", 100, 1),
    "largest difference of a slip (%)": ("slip_max", 100, 1), "slip over time, relative L2 (%)": ("slip_l2", 100, 1),
    "slip rate, relative L2 (%)": ("rate_l2", 100, 0), "the same below 1 Hz (%)": ("rate_low_l2", 100, 0)
}


def rupture_plane_table():
    """TPV5: until 12 s, differences from a boundary integral, of the series of spacings and of runs with one value changed."""
    series = [[run for run in plane_runs() if run["run"] == f"{run['spacing']:g} m{name}"] for name in ("", " near")]
    return ["difference at ten stations (order of convergence)", *(run["run"].replace(" near", ", near borders") for runs in series for run in runs)], [
        [text, *(cell for runs in series for cell in
                 (with_orders(runs, show) if show[0] in ("arrival", "slip_l2", "rate_l2", "rate_low_l2") else
                  [f"{show[1] * run[show[0]]:.{show[2]}f}" for run in runs]))] for text, show in PLANE_ROWS.items()
    ]  # yapf: disable


def crack_table():
    """The self-similar crack: the factor of its slip beside that of the closed form."""
    rows = read(FOLDER / "rupture_crack.csv")
    spacings = dict.fromkeys(row["dx"] for row in rows)
    cells = {(row["speed"], row["dx"]): row for row in rows}
    speeds = {row["speed"]: row["exact"] for row in rows}
    return ["speed of the tips / S-wave", "exact", *(f"{dx} m" for dx in spacings)], [
        [speed, exact, *(cells[speed, dx]["factor"] for dx in spacings)] for speed, exact in speeds.items()
    ]  # yapf: disable


CHANGED = {
    "step": "contacts begin at the end of a step", "force": "viscosity as a force", "floor 0.04": "masses of 0.04 at least",
    "floor 0.09": "masses of 0.09 at least"
}


def single_event_table():
    """One event with several time steps, and at one step with other schemes and masses, beside one with a much smaller step."""
    rows = [row for row in read(FOLDER / "accuracy_fault.csv") if row["variant"] == "standard"]
    keys = {"size": "error_size", "displacement": "error_profile", "energy balance": "error_ledger"}
    some = [(row, row["dt"]) for row in rows if row["method"] == "located"]
    some += [(row, f"0.03, {text}") for method, text in CHANGED.items() for row in rows if (row["method"], row["dt"]) == (method, "0.03")]
    return ["time step", *(f"{name}, relative" for name in keys), "arrival at a station", "CPU time (s)"], [
        [name, *("-" if row[key] == "nan" else f"{float(row[key]):.1e}" for key in keys.values()), f"{float(row['error_arrival']):.2g}",
         f"{float(row['seconds']):.2g}"] for row, name in some
    ]  # yapf: disable


def waves_table():
    """Speed of short waves of the lattice over that of long ones."""
    rows = {(row["wave"], row["spacings per wave"]): row for row in read(FOLDER / "waves_lattice.csv") if row["angle (degrees)"] == "0"}
    free = {row["spacings per wave"]: row["against the half-space (%)"] for row in read(FOLDER / "waves_rayleigh.csv")}
    return ["discs in a wavelength", "P-waves (%)", "S-waves (%)", "Rayleigh waves (%)"], [
        [n, *(f"{float(rows[wave, n]['speed / that of long waves - 1 (%)']):.2f}" for wave in "PS"), f"{float(free[n]):.2f}"] for n in ("40", "20", "10", "6")
    ]  # yapf: disable


SCHEMES = {"printed": "printed", "verlet": "velocity Verlet", "rk4": "rk4, located switches"}


def slider_schemes_table():
    """Slip of one event of the block-slider at a time step of 0.05 and its half."""
    rows = {(row["scheme"], row["dt"]): row for row in read(FOLDER / "accuracy_slider.csv")}
    base = float(rows["printed", "0.05"]["seconds"])
    out = []
    for scheme, name in SCHEMES.items():
        one, half = rows[scheme, "0.05"], rows[scheme, "0.025"]
        order = math.log2(float(one["error_profile"]) / float(half["error_profile"]))
        out.append(
            [name, f"{float(one['error_profile']):.1e}", f"{float(one['error_size']):.1e}", f"{order:.1f}", f"{float(one['seconds']) / base:.2g}"])
    return ["scheme, time step 0.05", "slip, relative", "size, relative", "order", "run time over that of the printed scheme"], out


def same_packing_table():
    """ESyS-Particle and ours on one packing."""
    names = {"ESyS-Particle": "ESyS-Particle", "ours_0.06": "ours", "ours_0.12": "ours, small masses raised"}
    return ["program, time step", "events >= 0.001", ">= 0.01", ">= 0.1", "p of sizes", "p of times", "time units in a core-hour"], [
        [f"{names[row['run']]}, {row['dt']}", row["events_3"], row["events_2"], row["events_1"],
         *(f"{float(row[key]):.2f}" if row[key] else "-" for key in ("p_size", "p_time")), f"{float(row['time_per_core_hour']):.2g}"]
        for row in read(FOLDER / "speed/whole-job.csv")
    ]  # yapf: disable


def extremes_table():
    """What became of stiff and extreme cases."""
    groups = {}
    for row in read(FOLDER / "extremes.csv"):
        groups.setdefault((row["group"], row["outcome"]), []).append(row["ledger"])
    return ["case", "outcome", "energy balance, largest error"], [
        [group, outcome, f"{max(map(float, some)):.1e}" if some[0] else ""] for (group, outcome), some in groups.items()
    ]  # yapf: disable


TABLES = {name.removesuffix("_table").replace("_", "-"): made for name, made in list(globals().items()) if name.endswith("_table")}

# ---- numbers of sentences


def rupture_values():
    """Differences of the finest lattices from the boundary integrals and PyLith."""
    finest = {name.lower(): (flat_runs(name)[-1], FLAT[name]) for name in FLAT}
    plane = {run["run"]: run for run in plane_runs()}
    finest["tpv5"] = plane["150 m"], "rupture_3d-convergence.csv"
    for name, (run, file) in finest.items():
        for key in {"tpv205": ("arrival", "slip"), "tpv3": ("rate_l2",), "tpv5": ("arrival",)}[name]:
            yield Value(f"{name}.{key}", run[key], source=file)
    yield Value("tpv5.order.scatter", order_of(plane["200 m"], plane["150 m"], "scatter"), source="rupture_3d-convergence.csv")
    lattice = tpv101_runs()["lattice"][-1]
    for key in ("arrival", "slip", "peak"):
        yield Value(f"tpv101.{key}", lattice[key], source=STATIONS["TPV101"])
    breaks, _, held = next(value for (name, _), value in reversed(barrier_runs().items()) if name == "lattice")
    for key, value in ("breaks", breaks), ("held", held):
        yield Value(f"barrier.lattice.{key}", value, unit="MJ/m^2", source=BARRIER)
    static = next(float(row["static"]) for row in read(FOLDER / BARRIER) if row["static"])
    yield Value("barrier.static", static, unit="MJ/m^2", source=BARRIER)
    pylith = rupture_benchmark.summary(stations_of("TPV205", lambda row: row["reference"].startswith("PyLith") and row["spacing"] == "50"))
    for key in ("arrival", "slip"):
        yield Value(f"tpv205.pylith.{key}", pylith[key], source=FLAT["TPV205"])
