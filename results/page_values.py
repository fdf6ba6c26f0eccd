# SPDX-License-Identifier: GPL-2.0-or-later
"""Numbers of sentences of all pages but the article: where in the CSV files of this folder each stands, or how it follows from them."""
from pathlib import Path
from typing import NamedTuple

from lsm import LOADING, scaling
from lsm.analysis import numbers_of
from lsm.tables import read
import speed_tables
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
        return Value(self.key, float(rows[0][self.column]), float(rows[0][self.error]) if self.error else float("nan"), self.unit, 1, self.file)


CELLS = ()
PEERS = {"harmonic": "bond harmonic", "bpm": "bond bpm/spring", "esys": "ESyS-Particle"}


def slider_values(postproc):
    """Exponents of event sizes of the chains in the default settings, by decades below and above 1: least and largest over lengths and seeds."""
    paths = [FOLDER / f"catalogues/slider_ours_{blocks}_seed_{seed}.catalogue.csv.xz" for blocks in BLOCKS for seed in (1, 2, 3)]
    fits = numbers_of(postproc, "fit", *paths, "--range", "0.01:1", "--range", "1:100", "--replicas", "0", "--no-comparison", "--no-picture")["fits"]
    for name, low in ("small", 0.01), ("large", 1):
        found = [one["exponent"] for one in fits if one["lo"] == low]
        for what, choose in ("least", min), ("most", max):
            yield Value(f"slider.{name}.{what}", choose(found), float("nan"), "", len(found), "catalogues/slider_ours_*")


def scaling_values():
    """How the characteristic size of drops and of ruptures of the absorbing fault goes with its length."""
    for name, kind, least in ("drops", "catalogue", 1e-3), ("ruptures", "ruptures", 1e-2):
        paths = sorted((FOLDER / "campaign").glob(f"fault_*.{kind}.csv.xz"),
                       key=lambda path: [int(word) for word in path.name.split(".")[0].split("_")[1:]])
        found, = scaling.scalings([scaling.load(path, LOADING) for path in paths], least)
        yield Value(f"scaling.{name}", found.fit["D"], found.fit["D_error"], "", len(paths), f"campaign/fault_*.{kind}.csv.xz")


def speed_values():
    """How many times as many particle-steps we make as others, on one and two cores."""
    found = {(label, ranks): rounds for (label, _, ranks), rounds in speed_tables.timings("peers").items()}
    for key, label in PEERS.items():
        for ranks in (1, 2):
            if (label, ranks) in found:
                ratio = speed_tables.ratio_of(found[label, ranks], found["ours", ranks])
                yield Value(f"speed.{key}.{ranks}", ratio, float("nan"), "", len(found[label, ranks]), "speed/timings.csv")


def all_values(postproc):
    return [*(cell.value() for cell in CELLS), *slider_values(postproc), *scaling_values(), *speed_values()]
