# SPDX-License-Identifier: GPL-2.0-or-later
"""Tables of a benchmark in Markdown, from the files that bench_lsm.py writes: bench_tables.py FOLDER. Medians over the rounds."""
import csv
import math
import statistics
import sys
from pathlib import Path

PARTS = ("pair", "bond", "neigh", "comm", "output", "modify", "other")
# Bytes that a step reads and writes per particle: clearing of forces 24; 2.53 links of 16, positions 24, forces in both directions 48;
# integration: forces 24, velocities and positions in both directions 96, mass, viscosity and type 16. And the size of these data.
BYTES_OF_STEP, BYTES_OF_DATA = 24 + 2.53 * 16 + 24 + 48 + 24 + 96 + 16, 72 + 2.53 * 16 + 16
LATENCY, BANDWIDTH = 1.5, 10  # microseconds, GB/s: of the prediction


def read(path):
    if not path.exists():
        return []
    with open(path, newline="") as file:
        return [{key: float(cell or 0) if key not in ("table", "label", "command") else cell
                 for key, cell in row.items()} for row in csv.DictReader(file)]


def median(values):
    return statistics.median(values) if values else 0.0


class Timing:
    """The rounds of one table, label, length and number of ranks; times in nanoseconds per particle and step, of all ranks together."""

    def __init__(self, rows):
        self.table, self.label, self.length, self.ranks = (rows[0][key] for key in ("table", "label", "length", "ranks"))
        self.atoms, per = rows[-1]["atoms"], [1e9 / row["atoms"] / row["steps"] for row in rows]
        self.rounds = {row["round"]: row["seconds"] / row["atoms"] / row["steps"] * 1e9 for row in rows}
        self.cost = median(list(self.rounds.values()))
        self.rate = 1e3 / self.cost
        self.cpu = median([row["seconds"] * k * row["cpu_percent"] / 100 for row, k in zip(rows, per)])
        self.parts = {key: median([row[key] * k for row, k in zip(rows, per)]) for key in PARTS}
        self.resident = median([row["resident"] for row in rows if row["resident"] > 0])

    def against(self, other, of):
        """Median over the rounds that both have of a function of both costs."""
        return median([of(cost, other.rounds[number]) for number, cost in self.rounds.items() if number in other.rounds])

    def ratio(self, other):
        return self.against(other, lambda a, b: a / b)

    def timers(self):
        """LAMMPS' own timers."""
        one = self.parts
        return [f"{x:.2f}" for x in (one["bond"], one["pair"], one["modify"], one["comm"], one["neigh"], one["output"] + one["other"])]


TIMERS = ["links", "contacts", "modify", "comm", "neigh", "other"]


def table(head, rows):
    return "\n".join(f"| {' | '.join(row)} |" if row is not None else "|" + "---|" * len(head) for row in [head, None, *rows])


class Tables:

    def __init__(self, folder):
        rows, groups = read(folder / "timings.csv"), {}
        for row in rows:
            groups.setdefault((row["table"], row["label"], row["length"], row["ranks"]), []).append(row)
        self.timings = {key: Timing(some) for key, some in groups.items()}
        self.cpu = median([row["cpu_percent"] for row in rows if row["table"] != "peers" or row["label"] == "ours"])
        self.memory = any(row["resident"] > 0 for row in rows)
        self.most = int(max([row["ranks"] for row in rows], default=1))
        self.setup, self.scale, self.analysis = (read(folder / f"{name}.csv") for name in ("setup", "scale", "analysis"))
        self.triads = {}
        for row in read(folder / "triad.csv"):
            self.triads.setdefault(row["ranks"], []).append((row["megabytes"], row["gb_per_second"]))

    def of(self, name):
        return [one for one in self.timings.values() if one.table == name]

    def bytes_of(self, one):
        return [f"{one.resident * 1024 / one.atoms:.0f}"] if self.memory else []

    def peers(self):
        head = ["program", "particles", "ranks", "million particle-steps/s", "ns", "speed of ours over it"]
        rows, some = [], self.of("peers")
        for one in some:
            base = self.timings["peers", "ours", one.length, one.ranks]
            rows.append([one.label, f"{one.atoms:.0f}", f"{one.ranks:.0f}", f"{one.rate:.1f}", f"{one.cost:.1f}",
                         "" if one is base else f"{one.ratio(base):.2f}", *self.bytes_of(one)])  # yapf: disable
        yield "Side by side, PE at every step", table(head + ["memory, bytes per particle"] * self.memory, rows)
        both = [(self.timings["peers", one.label, one.length, 1], one) for one in some if one.ranks == 2]
        if both:
            yield None, "2 ranks over 1: " + ", ".join(f"{two.label} {one.ratio(two):.2f}" for one, two in both) + "."

    def parts(self):
        names, some = ("everything", "events", "plates", "integration", "contacts", "links"), self.of("parts")
        at = {(one.label, one.ranks): one for one in some}
        ranks = range(1, self.most + 1)
        rows = [["everything", *(f"{at['everything', r].cost:.2f}" for r in ranks)]]
        for before, name in zip(names, names[1:]):
            rows.append([name, *(f"{at[before, r].against(at[name, r], lambda a, b: a - b):.2f}" for r in ranks)])
        rows.append(["what is left", *(f"{at[names[-1], r].cost:.2f}" for r in ranks)])
        yield "Parts, ns: saved when one after another is left out", table(["part", "1 rank", "2 ranks"][:self.most + 1], rows)
        yield None, "By LAMMPS' own timers (modify: integration, plates and events):\n\n" + table(
            ["ranks"] + TIMERS, [[f"{one.ranks:.0f}", *one.timers()] for one in some if one.label == "everything"])

    def features(self):
        rows = []
        for one in self.of("features"):
            if not one.label.startswith("base of "):
                base = self.timings["features", f"base of {one.label}", one.length, one.ranks]
                rows.append([one.label, f"{one.cost:.2f}", f"{base.cost:.2f}", f"{one.ratio(base):.3f}"])
        yield f"One thing changed, {self.most} ranks", table(["change", "ns", "ns without the change", "ratio"], rows)

    def causes(self):
        some = self.of("causes")
        base = next(one.cpu for one in some if one.label == "in shear as in the campaign")
        rows = [[one.label, f"{one.cpu:.2f}", f"{one.cpu - base:.2f}"] for one in some]
        yield "From the scene of the comparisons to a run, CPU time on one rank", table(["what", "ns", "more than the run, ns"], rows)

    def campaign(self):
        rows, hours_of = [], {}
        for one in self.of("campaign"):
            hours = one.cost * 1e-9 * one.atoms * 1.2e6 / 3600
            hours_of[one.ranks] = hours_of.get(one.ranks, 0) + hours
            rows.append([f"{x:.0f}" for x in (one.length, one.atoms, one.ranks)] + [f"{one.cost:.2f}", f"{hours:.3f}", *one.timers()])
        yield "Slices of the campaign", table(["length", "particles", "ranks", "ns", "hours for 1.2e6 steps"] + TIMERS, rows)
        yield None, "\n\n".join(f"{ranks:.0f} ranks: {hours:.2f} hours, {ranks * hours:.2f} core-hours." for ranks, hours in hours_of.items())

    def lengths(self):
        some = self.of("lengths")
        head = ["length", "particles", "ranks", "million particle-steps/s", "ns"] + TIMERS + ["memory, bytes per particle"] * self.memory
        yield "Against the length of the fault", table(
            head, [[f"{x:.0f}"
                    for x in (one.length, one.atoms, one.ranks)] + [f"{one.rate:.1f}", f"{one.cost:.2f}", *one.timers(), *self.bytes_of(one)]
                   for one in some])
        if not self.triads:
            return
        rows, shortest = [], {}
        for one in some:
            megabytes, speed = one.atoms * BYTES_OF_DATA / one.ranks * 1e-6, BYTES_OF_STEP / one.cost / one.ranks
            triad = interpolated(self.triads[one.ranks], megabytes)
            base = shortest.setdefault(one.ranks, one.cost)
            rows.append([
                f"{one.length:.0f}", f"{one.ranks:.0f}", f"{megabytes:.1f}", f"{speed:.1f}", f"{triad:.1f}", f"{speed / triad * 100:.0f} %",
                f"{base / one.cost:.2f}"
            ])
        yield (f"Against the bandwidth: {BYTES_OF_STEP:.0f} bytes for each particle and step, {BYTES_OF_DATA:.0f} bytes of data",
               table([
                   "length", "ranks", "data of a rank, MB", "GB/s of a rank", "triad with as much data, GB/s", "share",
                   "speed over that of the shortest"
               ], rows))

    def scales(self):
        rows = []
        for row in self.scale:
            base = row["pe"] if row["ranks"] == 1 else base
            rows.append([
                f"{row['length']:.0f}", f"{row['ranks']:.0f}", f"{row['particles'] / row['ranks']:.0f}", f"{row['largest_share']:.3f}",
                f"{row['ghosts']:.0f}", f"{row['messages']:.2f}", f"{row['bytes']:.0f}", f"{row['collectives']:.2f}", f"{row['nonblocking']:.2f}",
                f"{row['pe'] / base - 1:.1e}"
            ])
        yield "What ranks send each other, each step and rank (counted)", table([
            "length", "ranks", "particles of a rank, mean", "largest over mean", "ghosts", "messages", "bytes", "collective calls that wait",
            "that do not", "PE beside 1 rank"
        ], rows)
        yield None, ("Of the calls that wait 0.1 ask whether neighbour lists are out of date; every 100th step gathers PE and looks whether the run "
                     "is sound.")

    def prediction(self):
        """Microseconds of a step: computation of the largest share, messages to both neighbours at the same time, and collective calls
        that go up and down a tree."""
        several = [row for row in self.scale if row["ranks"] > 1]
        halo, waits = max(row["bytes"] for row in several), several[-1]["collectives"]
        # excess of the largest share over the mean, divided by its square root
        spread = max(0.0, *((row["largest_share"] - 1) * math.sqrt(row["particles"] / row["ranks"]) for row in several))
        costs = [(one.atoms, one.cost) for one in self.of("lengths") if one.ranks == 1]

        def time(particles, ranks):
            share = particles / ranks
            t = (share if ranks == 1 else share + spread * math.sqrt(share)) * interpolated(costs, share) * 1e-3
            if ranks == 1:
                return t
            levels = int(math.log2(ranks) + 0.999)
            plates = 2 * levels * LATENCY  # sum of the forces on the plates: beside the integration only
            return t + LATENCY + halo / 2 / BANDWIDTH * 1e-3 + waits * 2 * levels * LATENCY + max(0.0, plates - 0.25 * t)

        lengths, rows = (1890, 3780, 7560, 15120), []
        for ranks in (1, 8, 16, 32, 64, 128, 256, 512):
            cells = []
            for particles in (63.15 * length for length in lengths):
                t = time(particles, ranks)
                cells += [f"{t:.1f}", f"{particles / t:.0f}", f"{time(particles, 1) / t / ranks * 100:.0f} %"]
            rows.append([f"{ranks}", *cells])
        yield "Predicted, not measured", (
            f"Latency {LATENCY:g} us, {BANDWIDTH:g} GB/s, {halo:.0f} bytes a step to two neighbours, {waits:.2f} collective calls that wait (2 log2(ranks) "
            "latencies each), one that does not but is needed after the integration, a quarter of the arithmetic; largest share mean + "
            f"{spread:.2f} sqrt(mean), cost of a particle that of one rank with as many in the table above.\n\n") + table(
                ["ranks", *(text for length in lengths for text in (f"length {length}, us a step", "million particle-steps/s", "efficiency"))], rows)

    def setups(self):
        columns = {"create_lsm_fault": "create", "first step": "first_step", "write_restart": "write_restart", "read_restart": "read_restart"}
        yield "Set-up, seconds", table(["ranks", *columns], [[f"{ranks}"] + [
            f"{median([row[key] for row in self.setup if row['ranks'] == ranks]):.2f}" for key in columns.values()
        ] for ranks in range(1, self.most + 1)])  # yapf: disable

    def analyses(self):
        rows = []
        for command in dict.fromkeys(row["command"] for row in self.analysis):
            seconds, kilobytes = (median([row[key] for row in self.analysis if row["command"] == command]) for key in ("seconds", "kilobytes"))
            rows.append([command, f"{seconds:.1f}", f"{kilobytes / 1024:.0f}"])
        yield f"postproc on a catalogue of {self.analysis[-1]['events']:g} events", table(["command", "seconds", "memory, MB"], rows)

    def text(self):
        has = {one.table for one in self.timings.values()}
        out = [f"Median CPU use {self.cpu:.0f} %. ns are wall time per particle and step; comm of 2 ranks holds the waiting for each other."]
        for wanted, made in (("peers" in has, self.peers), ("parts" in has, self.parts), ("features" in has, self.features),
                             ("causes" in has, self.causes), ("campaign" in has, self.campaign), ("lengths"
                                                                                                  in has, self.lengths), (self.scale, self.scales),
                             (self.scale and "lengths" in has, self.prediction), (self.setup, self.setups), (self.analysis, self.analyses)):
            if wanted:
                out += [f"### {head}\n\n{body}" if head else body for head, body in made()]
        return "\n\n".join(out) + "\n"


def interpolated(points, at):
    """Linear in the logarithm of the abscissa between points (x, y), constant beyond them."""
    if at <= points[0][0]:
        return points[0][1]
    for (x0, y0), (x1, y1) in zip(points, points[1:]):
        if at <= x1:
            return y0 + (y1 - y0) * math.log(at / x0) / math.log(x1 / x0)
    return points[-1][1]


if __name__ == "__main__":
    print(Tables(Path(sys.argv[1])).text(), end="")
