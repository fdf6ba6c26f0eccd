# SPDX-License-Identifier: GPL-2.0-or-later
"""Numbers of sentences of all pages but the article: where in the CSV files of this folder each stands, or how it follows from them."""
from pathlib import Path
from statistics import median
from typing import NamedTuple

from lsm import paper
from lsm.analysis import mean_and_error, numbers_of
from lsm.tables import number, read
import fault_3d
import sources
import speed_tables
import validation_tables
from values import Value

FOLDER = Path(__file__).resolve().parent
BLOCKS = (256, 614, 972, 1450, 1928)


class Cell(NamedTuple):
    """The number in a column of the one row whose other columns are as in `where`; error: the column with its error."""
    key: str
    file: str
    column: str
    where: dict = {}
    error: str = ""
    unit: str = ""

    def value(self):
        rows = [row for row in read(FOLDER / self.file) if all(row[name] == text for name, text in self.where.items())]
        if len(rows) != 1:
            raise ValueError(f"{self.key}: {len(rows)} rows of {self.file} have {self.where}, expected one")
        return Value(self.key, float(rows[0][self.column]), number(rows[0], self.error) if self.error else float("nan"), self.unit, 1, self.file)


CELLS = (
    Cell("single.ledger", "accuracy_fault.csv", "error_ledger", {"variant": "standard", "method": "located", "dt": "0.03"}),
    Cell("absorbing_step.released", "accuracy_catalogues.csv", "released", {"dt": "0.12", "onset": "located"}, "released_error"),
)
COSTS = {"ledger": "energy ledger", "location": "location of events", "pressure": "pressure every step"}
SAVED = {"contacts": "contacts of discs of the same block", "records": "all records"}
NATURE = (("california", "Southern California", "1000"), ("weakening", "fault 120 weakening", "0.001"))
FAST, SLOW = {"run": "2.5e-4_no_leaps"}, {"run": "2.5e-8_leaps_2.5e-4"}
CHAIN = {"blocks": "256", "seed": "1"}
BEYOND = (
    *(Cell(f"nature.after.{name}", "nature.table.csv", "after", dict(label=label, threshold=least), "after_error") for name, label, least in NATURE),
    Cell("walk.short.springs_256", "walk.csv", "short", {"station": "chain-256"}, "short_error"),
    *(Cell(f"slow.gamma.{name}", "slow-driving.csv", "gamma", where, "gamma_error") for name, where in (("fast", FAST), ("slow", SLOW))),
    *(Cell(f"chain.gamma.{name}", "slow-driving-slider.csv", "gamma", CHAIN | where, "gamma_error")
      for name, where in (("fast", {"velocity": "1e-2", "leap": "0"}), ("slow", {"velocity": "1e-7", "leap": "1e-3"}))),
)
PEERS = {"harmonic": "bond harmonic", "esys": "ESyS-Particle"}


def slider_values(postproc):
    """Exponents of event sizes of the chains in the default settings, below 1: least and largest over lengths and seeds."""
    paths = [FOLDER / f"catalogues/slider_ours_{blocks}_seed_{seed}.catalogue.csv.xz" for blocks in BLOCKS for seed in (1, 2, 3)]
    fits = numbers_of(postproc, "fit", *paths, "--range", "0.01:1", "--replicas", "0", "--no-comparison", "--no-picture")["fits"]
    found = [one["exponent"] for one in fits]
    for what, choose in ("least", min), ("most", max):
        yield Value(f"slider.small.{what}", choose(found), n=len(found), source="catalogues/slider_ours_*")


def speed_values():
    """How many times as many particle-steps we make as others on one and two cores, what options cost, and whole jobs."""
    file = "speed/timings.csv"
    found = {(label, ranks): rounds for (label, _, ranks), rounds in speed_tables.timings("peers").items()}
    for key, label in PEERS.items():
        for ranks in (1, 2):
            if (label, ranks) in found:
                ratio = speed_tables.ratio_of(found[label, ranks], found["ours", ranks])
                yield Value(f"speed.{key}.{ranks}", ratio, float("nan"), "", len(found[label, ranks]), file)
    for ranks in (1, 2):
        native = [label for label, at in found if at == ranks and "native" in label and not label.startswith("ours")]
        yield Value(f"speed.native.{ranks}", min(speed_tables.ratio_of(found[label, ranks], found["ours", ranks]) for label in native), source=file)
        over = [float(row[f"harmonic_{ranks}"]) for row in speed_tables.machines()]
        for name, choose in ("least", min), ("most", max):
            yield Value(f"speed.machines.harmonic.{ranks}.{name}", choose(over), n=len(over), source="speed/machines.csv")
        rest, shear = (speed_tables.middle(speed_tables.timings(table)[label, 1890, ranks])
                       for table, label in (("lengths", "ours"), ("campaign", "slice")))
        yield Value(f"speed.shear.{ranks}", shear / rest, source=file)
    features = {key[0]: rounds for key, rounds in speed_tables.timings("features").items()}
    cost = {label: speed_tables.ratio_of(features[label], features["base of " + label]) for label in speed_tables.CHANGES}
    for key, label in COSTS.items():
        yield Value(f"speed.cost.{key}", cost[label], source=file)
    for ranks in (1, 2):
        yield Value(f"speed.dashpots.{ranks}", speed_tables.dashpots(ranks), source=file)
    for length in 120, 1890:
        yield Value(f"speed.model.{length}", speed_tables.model_over_measured(length), source=file)
    yield Value("speed.cost.law", max(cost[label] for label in speed_tables.LAWS), n=len(speed_tables.LAWS), source=file)
    for name in "contacts", "records":
        yield Value(f"speed.saved.{name}", 1 - speed_tables.saved(SAVED[name]), source=file)
    rows = read(FOLDER / "speed/slider.csv")
    for scheme in "printed", "verlet":
        plain, active = (median(float(row[key]) for row in rows if row["scheme"] == scheme) for key in ("plain_s", "active_s"))
        yield Value(f"speed.active.{scheme}", plain / active, source="speed/slider.csv")
    rates = {row["run"]: float(row["time_per_core_hour"]) for row in read(FOLDER / "speed/whole-job.csv")}
    yield Value("speed.job.same", rates["ours_0.06"] / rates["ESyS-Particle"], source="speed/whole-job.csv")
    raised = [float(row["error_size"]) for row in read(FOLDER / "accuracy_fault.csv") if row["method"].startswith("floor") and row["dt"] == "0.03"]
    yield Value("single.raised.least", min(raised), n=len(raised), source="accuracy_fault.csv")
    rates = {(row["dt"], row["onset"]): float(row["time_per_core_hour"]) for row in read(FOLDER / "accuracy_catalogues.csv")}
    yield Value("absorbing_step.gain", rates["0.12", "located"] / rates["0.03", "located"], source="accuracy_catalogues.csv")
    first = {row["part"]: float(row["seconds"]) for row in read(FOLDER / "speed/jobs.csv")}
    for part, seconds in ("programs", first["programs"]), ("fault", first["fault"]), ("total", sum(first.values())):
        yield Value(f"speed.first.{part}", seconds / 60, unit="minutes", source="speed/jobs.csv")
    counts = [row for row in read(FOLDER / "speed/scale.csv") if row["ranks"] == "8"]
    for name, row in (("120", counts[0]), ("1890", counts[-1])):
        yield Value(f"speed.kilobytes.{name}", float(row["bytes"]) / 1000, source="speed/scale.csv")


def calibrated():
    """Points of the calibration, with a memory of 1."""
    return [row for row in paper.completed(FOLDER / "calibration/points.csv.xz") if float(row["memory"]) == 1]


def calibration_values():
    """How many points there are, and how many meet the printed numbers of sizes and times together."""
    rows = calibrated()
    met = [all(paper.STATEMENTS_BY_NAME[key].deviation(row) <= 1 for key in ("exponent", "gamma", "B")) for row in rows]
    for key, count in ("points", len(rows)), ("together", sum(met)):
        yield Value(f"calibration.{key}", count, n=len(rows), source="calibration/points.csv.xz")


def slow_values():
    """Drops of slow plates over those of fast ones, in as much displacement, with leaps that hide least; large ones that both have."""
    rows = read(FOLDER / "slow-driving.csv")
    full, = [row for row in rows if row["run"] == FAST["run"]]
    careful, = [row for row in rows if row["fast"] == "1e-4"]
    ratio = number(careful, "events_2") / number(full, "events_2") * number(full, "displacement") / number(careful, "displacement")
    yield Value("slow.ratio.0.01", ratio, float("nan"), "", 1, "slow-driving.csv")
    matched = [(number(row, "same") / number(row, "of"), number(row, "chance") / number(row, "of")) for row in rows if row["same"]]
    same, chance = zip(*matched)
    for name, value in ("least", min(same)), ("chance", sum(chance) / len(chance)):
        yield Value(f"slow.matched.{name}", value, float("nan"), "", len(matched), "slow-driving.csv")


def law_values():
    """Main shocks of laws without a slow process, which have no event long after them, and the exponent of Omori's law of the ageing law."""
    laws = {}
    for row in read(FOLDER / "laws.csv"):
        laws.setdefault(row["run"].rsplit("_", 1)[0], []).append(row)
    fast = [row for law in ("coulomb", "static", "slip-weakening", "velocity-weakening") for row in laws[law] if number(row, "after_far") == 0]
    yield Value("laws.shocks.fast", sum(number(row, "main_shocks") for row in fast), float("nan"), "", len(fast), "laws.csv")
    some = [number(row, "omori_p") for row in laws["ageing"]]
    yield Value("laws.omori.ageing", *mean_and_error(some), "", len(some), "laws.csv")


def all_values(postproc):
    return [
        *(cell.value() for cell in CELLS + BEYOND), *calibration_values(), *slow_values(), *law_values(), *slider_values(postproc), *speed_values(),
        *sources.source_values(), *fault_3d.all_values(), *validation_tables.rupture_values()
    ]
