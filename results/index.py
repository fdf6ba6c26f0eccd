# SPDX-License-Identifier: GPL-2.0-or-later
"""What the files of this folder are, which program makes them, and of which study's runs. Each file has one line."""
import subprocess
from fnmatch import fnmatch
from pathlib import Path

FOLDER = Path(__file__).resolve().parent
# pattern of files, what they are, what makes them, study
FILES = (
    ("values.csv", "numbers of sentences", "tables.py --values", "all"),
    ("rates.* velocity.* estimators.* ruptures.*", "figures of the article, with their data", "faults.py", "article"),
    ("picked.csv ruptures_tests.csv bursts.csv trapped.csv spectrum.csv variants.csv", "what needs whole series of a run",
     "faults.py publish, faults.py discs", "article"),
    ("faults/*", "catalogues and ruptures of the three faults", "faults.py publish, publish.py", "article, paper"),
    ("campaign/*", "the absorbing fault at all lengths, drops and ruptures", "publish.py", "campaign"),
    ("validation/*", "wider blocks", "publish.py", "validation, paper"),
    ("damping.*", "energies of the three faults", "slip_or_exchange.py figure", "article, extra=fault_energy"),
    ("calibration.statements.csv calibration/*", "values that were tried, and what they give", "calibrate.py", "calibration, slider-calibration"),
    ("packing/* packing.png", "places of the discs at the fault, with seeds on a grid and at random", "packing.gp", ""),
    ("catalogues/* fig13_slider_sizes.*", "block-sliders", "publish.py, postproc histograms", "campaign"),
    ("walk/* walk.*", "stations between the block-slider and the fault", "walk.py", "walk"),
    ("nature.*", "the models beside earthquakes", "nature.py", "campaign, walk"),
    ("fault_3d/* fault_3d.*", "ruptures, patches and slip of one rupture of the fault in three dimensions", "fault_3d.py", "fault-3d"),
    ("sources.*", "duration, energies and stress drop of ruptures of the leaky fault", "sources.py", "article"),
    ("slow-driving*", "slow plates", "study.sh", "slow-driving, slow-driving-slider"),
    ("laws.csv", "six friction laws", "study.sh", "laws"),
    ("accuracy_* extremes.csv lattice.stiffness.csv waves_*", "errors of time steps, stiff and extreme cases, waves", "target accuracy, study.sh",
     "work-precision"),
    ("rupture_benchmark* rupture_crack.csv rupture_packing-stations.csv rupture_tpv3-stations.csv", "flat ruptures in two dimensions",
     "rupture_benchmark.py", ""),
    ("rupture_tpv101-stations.csv rupture_varied*", "friction that varies along a flat fault: TPV101, and a barrier",
     "rupture_benchmark.py, rupture_varied.py", ""),
    ("rupture_3d*", "TPV5", "rupture_3d.py", "ruptures"),
    ("speed.* speed/*", "timings", "targets bench-lsm, bench-slider", ""),
    ("explore.png fault_event.png rupture_event.* tutorial_*", "pictures of short runs", "pictures.sh run", ""),
)


def files():
    """Those of the folder that git knows or would add, without pages and scripts."""
    words = ["git", "ls-files", "--cached", "--others", "--exclude-standard", "."]
    names = subprocess.run(words, cwd=FOLDER, capture_output=True, text=True, check=True).stdout.split("\n")
    return [name for name in sorted(set(names)) if name and not name.endswith((".md", ".py", ".sh", ".gp")) and (FOLDER / name).exists()]


def lines_of(name):
    return [line for line in FILES if any(fnmatch(name, pattern) for pattern in line[0].split())]


def wrong():
    """Files without a line or with two, and lines without a file."""
    found = files()
    said = [f"{name}: {len(lines_of(name))} lines of index.py say what it is, expected one" for name in found if len(lines_of(name)) != 1]
    return said + [
        f"index.py: no file is called {pattern}" for line in FILES
        for pattern in line[0].split() if not any(fnmatch(name, pattern) for name in found)
    ]


def files_table():
    """What the files are."""
    rows = []
    for patterns, what, made, study in FILES:
        rows.append([" ".join(f"`{pattern}`" for pattern in patterns.split()), what, f"`{made}`", study])
    return ["files", "what they are", "made by", "study"], rows
