# SPDX-License-Identifier: GPL-2.0-or-later
"""Tables of speed.md from timings.csv and slider-modes.csv, as head and rows; tables.py in the folder above writes them into the page."""
import functools
import statistics
from pathlib import Path

from calibrate import read

FOLDER = Path(__file__).resolve().parent


@functools.cache
def timings(name):
    """Wall-clock and CPU time (ns) per particle and step, parts, and memory of the rounds of each (label, length, ranks)."""
    out = {}
    for row in read(FOLDER / "timings.csv"):
        if row["table"] == name:
            per = 1e9 / float(row["atoms"]) / float(row["steps"])
            one = {key: float(row[key] or 0) * per for key in ("seconds", "pair", "bond", "neigh", "comm", "modify")}
            one |= {
                "cpu": one["seconds"] * float(row["cpu_percent"] or 100) / 100, "atoms": float(row["atoms"]),
                "bytes": float(row["resident"] or 0) * 1024 / float(row["atoms"])
            }
            out.setdefault((row["label"], int(row["length"]), int(row["ranks"])), {})[row["round"]] = one
    return out


def middle(rounds, key="seconds"):
    return statistics.median(row[key] for row in rounds.values())


def ratio_of(rounds, base):
    """Median of the ratios within each round."""
    return statistics.median(row["seconds"] / base[number]["seconds"] for number, row in rounds.items() if number in base)


def speed_peers_table():
    found = {(label, ranks): rounds for (label, _, ranks), rounds in timings("peers").items()}
    out = []
    for label in dict.fromkeys(label for label, _ in found):
        name, _, native = label.partition(", ")
        row = [f"{name}, {'-O2, of Debian' if label == 'ESyS-Particle' else '-O3 ' + native if native else '-O3'}"]
        for ranks in (1, 2):
            at, ours = found.get((label, ranks)), found.get(("ours", ranks))
            row += [f"{1e3 / middle(at):.3g}", "" if at is ours else f"{ratio_of(at, ours):.3g}"] if at else ["", ""]
            last = at or last
        out.append(row + [f"{middle(last, 'bytes'):.0f}" if middle(last, "bytes") else ""])
    return ([
        "PE at every step, length 1890", "million particle-steps/s, 1 rank", "ours (-O3) is faster", "2 ranks", "ours is faster",
        "bytes for a particle, most ranks"
    ], out)


def speed_lengths_table():
    out = []
    for table, lengths in ("lengths", (120, 945, 1890, 3780)), ("paper", (1890,)):
        found = timings(table)
        for label, length in dict.fromkeys(key[:2] for key in found):
            one, two = found.get((label, length, 1)), found.get((label, length, 2))
            if length in lengths and one and two:
                out.append([
                    f"{length}" if table == "lengths" else f"{length}, {label}", f"{middle(two, 'atoms'):.0f}", f"{middle(one):.1f}",
                    f"{middle(two):.1f}", *(f"{middle(two, key):.2f}" for key in ("bond", "pair", "modify", "comm", "neigh"))
                ])
    return ["length", "particles", "ns, 1 rank", "2 ranks", "links", "contacts", "integration, plates, events", "communication", "lists"], out


def speed_changes_table():
    names = {key[0]: rounds for key, rounds in timings("features").items()}
    ratio = {label: f"{ratio_of(rounds, names['base of ' + label]):.2f}" for label, rounds in names.items() if "base of " + label in names}
    changes = [["contacts of all discs", "nothing recorded", "location of events", "energy ledger"],
               [
                   "static friction above dynamic", "slip weakening", "velocity weakening", "rate and state (ageing)", "rate and state (slip)",
                   "no friction (lsm/free)"
               ], ["links that can break", "no viscosity", "dashpots of links and contacts"],
               ["pressure every 100 steps", "pressure every step", "all lists rebuilt every 100 steps"]]
    return (["one thing changed, length 1890, 2 ranks",
             "time of a step, ratio"], [["; ".join(change), "; ".join(ratio[label] for label in change)] for change in changes])


def speed_modes_table():
    # 2048 blocks have the ratios of 1024, within 0.03
    rows = {row.pop("step"): {blocks: float(ns) for blocks, ns in row.items() if blocks != "2048"} for row in read(FOLDER / "slider-modes.csv")}
    two = rows["transforms"]
    shown = {
        "antiplane_tenth": "a tenth moves: velocity weakening", "coulomb_tenth": "Coulomb", "no_inertia_tenth": "velocity weakening, mass 0",
        "coulomb": "all move: Coulomb", "antiplane": "velocity weakening", "no_inertia_coulomb": "Coulomb, mass 0",
        "no_inertia": "velocity weakening, mass 0", "springs": "springs, velocity weakening"
    }
    out = [[text, *(f"{rows[name][blocks] / two[blocks]:.2f}" for blocks in two)] for name, text in shown.items()]
    return ["CPU time of a step over that of its two transforms; blocks",
            *two], [["two transforms, us", *(f"{1e-3 * ns:.3g}" for ns in two.values())], *out]


TABLES = {
    "speed-modes": speed_modes_table, "speed-peers": speed_peers_table, "speed-lengths": speed_lengths_table, "speed-changes": speed_changes_table
}
