# SPDX-License-Identifier: GPL-2.0-or-later
"""Tables of speed.md from the CSV files beside this one, as head and rows; tables.py in the folder above writes them into the page.

speed_tables.py BASE: draws them as BASE.png and BASE.svg
"""
import functools
import math
import statistics
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent.parent / "python"))
from lsm.drawing import draw, quote  # noqa: E402
from lsm.tables import read  # noqa: E402

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
    for table, what, lengths in ("lengths", "at rest", (120, 945, 1890, 3780)), ("campaign", "in shear", (120, 945, 1890)):
        found = timings(table)
        for label, length in sorted({key[:2] for key in found if key[1] in lengths}, key=lambda one: one[1]):
            one, two = found[label, length, 1], found[label, length, 2]
            out.append([
                f"{length}, {what}", f"{middle(two, 'atoms'):.0f}", f"{middle(one):.1f}", f"{middle(two):.1f}",
                *(f"{middle(two, key):.2f}" for key in ("bond", "pair", "modify", "comm", "neigh"))
            ])
    return ["length", "particles", "ns, 1 rank", "2 ranks", "links", "contacts", "integration, plates, events", "communication", "lists"], out


CHANGES = ("contacts of all discs", "nothing recorded", "location of events", "energy ledger", "static friction above dynamic", "slip weakening",
           "velocity weakening", "rate and state (ageing)", "rate and state (slip)", "no friction (lsm/free)", "links that can break", "no viscosity",
           "velocities of ghosts sent", "pressure every 100 steps", "pressure every step", "all lists rebuilt every 100 steps")

LAWS = ("static friction above dynamic", "slip weakening", "velocity weakening", "rate and state (ageing)", "rate and state (slip)")


def speed_changes_table():
    names = {key[0]: rounds for key, rounds in timings("features").items()}
    cells = [(label, f"{ratio_of(names[label], names['base of ' + label]):.2f}") for label in CHANGES]
    head = ["one thing changed, length 1890, 2 ranks", "time of a step, ratio", *["another", "ratio"] * 3]
    return head, [sum(cells[k::4], ()) for k in range(4)]


def machines():
    """Million particle-steps per second, and how many times those of bond harmonic, on 1 and 2 ranks of each machine; the first is that of the table of peers."""
    found = {(label, ranks): rounds for (label, _, ranks), rounds in timings("peers").items()}
    here = {"machine": "AMD Zen 4"}
    for ranks in (1, 2):
        here |= {
            f"millions_{ranks}": f"{1e3 / middle(found['ours', ranks]):.0f}",
            f"harmonic_{ranks}": f"{ratio_of(found['bond harmonic', ranks], found['ours', ranks]):.2f}"
        }
    return [here, *read(FOLDER / "machines.csv")]


def speed_machines_table():
    keys = "millions_1", "harmonic_1", "millions_2", "harmonic_2"
    head = ["length 1890, -O3", "million particle-steps/s, 1 rank", "over `bond harmonic`", "2 ranks", "over `bond harmonic`"]
    return head, [[row["machine"], *(row[key] for key in keys)] for row in machines()]


LEFT_OUT = {  # what a step takes without it, of a step with it: rows of "causes" (length 480, absorbing fault in shear), or inverse ratios of "features"
    "contacts of discs of the same block": ("causes", "contacts between the blocks only"),
    "rows of the catalogue with places and ruptures": ("causes", "neither location nor ruptures"), "all records": ("causes", "nothing recorded"),
    "dashpots of links and contacts": ("dashpots", "no dashpots"), "energy balance": ("features", "energy ledger"),
    "links that can break": ("features", "links that can break"), "rate and state": ("features", "rate and state (ageing)"),
    "pressure at every step": ("features", "pressure every step"), "lists built anew every 100 steps": ("features",
                                                                                                        "all lists rebuilt every 100 steps")
}


def speed_dashpots_table():
    found = timings("dashpots")
    rows = [[
        label, f"{ranks}", f"{middle(rounds):.1f}", *(f"{middle(rounds, key):.2f}" for key in ("bond", "pair", "modify", "comm")),
        f"{dashpots(ranks):.2f}" if label == DAMPED else ""
    ] for (label, _, ranks), rounds in sorted(found.items(), key=lambda one: one[0][2])]
    head = [
        "leaky fault, length 480, in shear", "ranks", "ns", "links", "contacts", "integration, plates, events", "communication", "with over without"
    ]
    return head, rows


DAMPED, FREE = "dashpots in links and contacts", "no dashpots"


def dashpots(ranks):
    """Median ratio of a step with dashpots to one without."""
    found = {key[0]: rounds for key, rounds in timings("dashpots").items() if key[2] == ranks}
    return ratio_of(found[DAMPED], found[FREE])


def saved(name):
    table, label = LEFT_OUT[name]
    if table == "dashpots":
        return 1 / dashpots(1)
    found = {key[0]: rounds for key, rounds in timings(table).items()}
    if table == "causes":
        return ratio_of(found[label], found["in shear as in the campaign"])
    return 1 / ratio_of(found[label], found["base of " + label])


def speed_saved_table():
    return ["not in the scene", "time of a step over that with it"], [[name, f"{saved(name):.2f}"] for name in LEFT_OUT]


LONG = 1e5 / 0.03  # steps of 1e5 time units
DEFAULT = 36000 / 0.03  # of a default run


def before():
    """Times of a step of the leaky fault in shear before its dashpots were stored beside the positions, over those after it, by length."""
    found = {}
    for row in read(FOLDER / "before.csv"):
        found.setdefault(int(row["length"]), {}).setdefault(row["program"], []).append(float(row["ns"]))
    return {length: statistics.median(a / b for a, b in zip(some["before"], some["after"])) for length, some in found.items()}


def speed_jobs_table():
    """A default run, and 1e5 time units, from the steady state of the leaky fault with ruptures recorded."""
    found, out, hours, earlier = timings("campaign"), [], [], before()
    for length in sorted({key[1] for key in found}):
        rounds = {ranks: one for (_, at, ranks), one in found.items() if at == length}
        one = [middle(rounds[ranks]) for ranks in (1, 2)]
        atoms = middle(rounds[1], "atoms")
        hours += [[one[0] * atoms * LONG * 1e-9 / 3600 * times for times in (1, earlier[length])]]
        out.append([
            f"{length}", f"{atoms:.0f}", *(f"{ns:.1f}" for ns in one), *(f"{ns * atoms * DEFAULT * 1e-9 / 60:.1f}" for ns in one),
            *(f"{one:.2f}" for one in hours[-1])
        ])
    out.append(["all", *[""] * 5, *(f"{sum(some):.1f}" for some in zip(*hours))])
    return [
        "length", "particles", "ns for a particle and step, 1 rank", "2 ranks", "default run (1.2e6 steps): minutes, 1 rank", "2 ranks",
        "1e5 time units: CPU hours", "before"
    ], out


def speed_lattice_table():
    """The lattice of TPV5 without friction."""
    return ["cubic lattice, one core", "ns for a node and step", "over ours"], [
        [row["program"], f"{float(row['ns']):.0f}", f"{float(row['over_ours']):.2g}"] for row in read(FOLDER.parent / "rupture_3d-peers.csv")
    ]  # yapf: disable


LATENCY, BANDWIDTH = 2000.0, 10.0  # of a network, not measured: ns for a message, bytes for a ns
NARROWEST = 7.2  # width of the part of a rank: twice what ghosts reach
ASKED = {"1e5": 1e5, "1e6": 1e6, "1e8": 1e8}


def modelled(particles, ranks, ns):
    """ns for a particle and step: work of a rank, its messages, and a sum over all ranks, by the counts of scale.csv."""
    sent = next(row for row in read(FOLDER / "scale.csv") if (row["length"], row["ranks"]) == ("1890", "2"))
    if ranks == 1:
        return ns
    step = float(sent["messages"]) * LATENCY + float(sent["bytes"]) / BANDWIDTH + 2 * LATENCY * math.log2(ranks) * float(sent["collectives"])
    return ns / ranks + step / particles


def model_over_measured(length):
    """On two ranks, from the time of one."""
    one, two = (timings("lengths")["ours", length, ranks] for ranks in (1, 2))
    return modelled(middle(one, "atoms"), 2, middle(one)) / middle(two)


def speed_scaling_table():
    ns, wide = middle(timings("lengths")["ours", 1890, 1]), 1890 / middle(timings("lengths")["ours", 1890, 1], "atoms")
    ranks = [4**n for n in range(1, 7)]
    return ["particles", *(f"{n} ranks" for n in ranks)
            ], [[name, *(f"{100 * ns / n / modelled(particles, n, ns):.0f} %" if particles * wide / n >= NARROWEST else "" for n in ranks)]
                for name, particles in ASKED.items()]


def speed_analysis_table():
    groups = {}
    for row in read(FOLDER / "analysis.csv"):
        groups.setdefault(row["command"], []).append(row)
    return ["postproc, 1e7 events", "seconds", "memory, GB"], [
        [name.replace("--", ""), *(f"{scale * statistics.median(float(row[key]) for row in some):.2g}" for key, scale in (("seconds", 1), ("kilobytes", 1e-6)))]
        for name, some in groups.items()
    ]  # yapf: disable


def picture(base):
    """Particle-steps per second of the programs, parts of a step, and what one change costs, from the tables."""

    def rows(lines):
        return "\n".join([" ".join(quote(cell.replace("`", "")) if k == 0 else cell or "NaN" for k, cell in enumerate(line))
                          for line in lines] + ["e", ""])

    peers, steps, changes = speed_peers_table()[1], speed_lengths_table()[1], speed_changes_table()[1]
    changes = sorted((line[k:k + 2] for line in changes for k in range(0, 8, 2)), key=lambda one: float(one[1]))
    parts = "links", "contacts", "integration, plates, events", "communication"
    draw(base, "".join([
        "set datafile separator\nset multiplot\nunset grid\nset grid xtics\nset style fill solid noborder\nset boxwidth 0.7\n",
        "set lmargin at screen 0.33\nset rmargin at screen 0.56\nset bmargin at screen 0.58\nset tmargin at screen 0.93\n",
        "set title 'fault of length 1890 beside other programs'\nset xlabel 'million particle-steps/s'\nset logscale x\nset xrange [0.3:500]\n",
        f"set yrange [-{len(peers)}:1]\nset key left center Left reverse\n",
        "plot '-' using 2:(-$0):ytic(1) w p lt 1 t '1 rank', '-' using 4:(-$0) w p lt 2 t '2 ranks'\n", rows(peers), rows(peers),
        "unset logscale\nset lmargin at screen 0.78\nset rmargin at screen 0.99\nset title 'cost of one change, 2 ranks'\n",
        f"set xlabel 'time of a step, ratio'\nset xrange [0.5:2]\nset yrange [-{len(changes)}:1]\nunset key\nset arrow 1 from 1,graph 0 to 1,graph 1 nohead lt 8 dt 2\n",
        "plot '-' using ($2 < 2 ? $2 : 1.97):(-$0):ytic(1) w p lt 1, '-' using ($2 < 2 ? NaN : 1.9):(-$0):2 w labels right\n", rows(changes), rows(changes),
        "unset arrow\nset lmargin at screen 0.33\nset bmargin at screen 0.14\nset tmargin at screen 0.45\nset title 'parts of a step of faults of these lengths, 2 ranks'\n",
        f"set xlabel 'ns for a particle and step'\nset xrange [0:9]\nset yrange [-{len(steps)}:1]\nset key at screen 0.5,0.01 center bottom horizontal samplen 2 Left reverse\nplot ",
        ", ".join(f"'-' using (0):(-$0):(0):({'+'.join(f'${5 + m}' for m in range(k + 1))}):(-$0-0.35):(-$0+0.35)"
                  f"{':ytic(1)' if k == 3 else ''} w boxxyerror lt {k + 1} notitle" for k in (3, 2, 1, 0)),
        *(f", keyentry w boxes lt {k} t '{part}'" for k, part in enumerate(parts, 1)), "\n", rows(steps) * 4, "unset multiplot"
    ]), 1450, 900)  # yapf: disable


TABLES = {
    "speed-peers": speed_peers_table, "speed-machines": speed_machines_table, "speed-lengths": speed_lengths_table,
    "speed-changes": speed_changes_table, "speed-saved": speed_saved_table, "speed-jobs": speed_jobs_table, "speed-lattice": speed_lattice_table,
    "speed-analysis": speed_analysis_table, "speed-dashpots": speed_dashpots_table, "speed-scaling": speed_scaling_table
}

if __name__ == "__main__":
    picture(*sys.argv[1:])
