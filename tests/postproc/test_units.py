# SPDX-License-Identifier: GPL-2.0-or-later
"""SI units of the fault: the same conversion in magnitudes, export and lsm.units."""
import json
import math
import re
import sys
import xml.etree.ElementTree as xml
from pathlib import Path

import numpy as np
import pytest
from data_files import table, write_catalogue
from programs import SOURCE, refused, run

sys.path.insert(0, str(SOURCE / "python"))
import lsm  # noqa: E402

ROCK = "--unit-length 100 --p-speed 6000 --density 2700"
# Computed by hand from the speeds of P-waves, 2.00, and S-waves, 1.05, and the density 0.286 in model units.
VELOCITY = 6000 / 2.00
TIME = 100 / VELOCITY
MODULUS = 2700 * (1.05 * VELOCITY)**2
MOMENT = MODULUS * 100**3
ENERGY = 2700 / 0.286 * VELOCITY**2 * 100**3


@pytest.fixture
def catalogue():
    """catalogue(path, ...): events at 0, 10, 25 with moments 1, 0.1, 10."""

    def write(path, model="lsm", **header):
        t = np.array([0.0, 10.0, 25.0])
        write_catalogue(path, t, np.array([0.5, 0.05, 2.0]), dict(model=model, length=40, stress=0.022, velocity=0.00025, **header), t_end=t + 1,
                        pe_start=[3] * 3, pe_end=[2] * 3, slip_moment=[1.0, 0.1, 10.0], x_centroid=[0.0, 20.0, 30.0])

    return write


def mw(moment):
    return 2 / 3 * (math.log10(moment) - 9.1)


def test_units():
    unit = lsm.units(length=100, p_speed=6000, density=2700)
    assert unit["time"] == pytest.approx(TIME) and unit["velocity"] == pytest.approx(VELOCITY) and unit["length"] == 100
    assert unit["stress"] == pytest.approx(2700 / 0.286 * VELOCITY**2)
    assert unit["energy"] == pytest.approx(ENERGY) and unit["moment"] == pytest.approx(MOMENT)
    # A normal stress of 0.022, and the plates of the paper: 1.9 GPa, 0.75 m/s
    assert 0.022 * unit["stress"] == pytest.approx(1869e6, rel=1e-3) and 0.00025 * unit["velocity"] == pytest.approx(0.75, abs=1e-3)
    assert lsm.units(100, 6000, 2700, thickness=5000)["moment"] == pytest.approx(50 * MOMENT)


def test_speeds_are_those_of_the_packing_everywhere(postproc, catalogue):
    catalogue("c.csv")
    run(postproc, "explore c.csv -o c.html")
    page = Path("c.html").read_text(encoding="utf-8")
    assert [float(re.search(rf'"{name}":([0-9.]+)', page)[1]) for name in ("pSpeed", "sSpeed")] == [lsm.P_SPEED, lsm.S_SPEED]


def test_export(postproc, catalogue):
    catalogue("c.csv")
    run(postproc, "export c.csv -o t.csv", ROCK).printed("a unit of time is 0.03333 s; time 0 is 2000-01-01T00:00:00")
    rows = table("t.csv")
    assert [float(row["magnitude"]) for row in rows] == pytest.approx([mw(m * MOMENT) for m in (1, 0.1, 10)])
    assert {row["magnitude_type"] for row in rows} == {"Mw"} and rows[1]["time"] == f"2000-01-01T00:00:00.{round(10 * TIME * 1e6):06d}"
    assert [float(row["longitude"]) for row in rows] == pytest.approx([0, 20 * 100 / 111194.9, 30 * 100 / 111194.9])
    run(postproc, "export c.csv -o e.csv --magnitude-of size --thickness 5000", ROCK)
    rows = table("e.csv")
    assert float(rows[0]["magnitude"]) == pytest.approx(2 / 3 * (math.log10(0.5 * 50 * ENERGY) - 4.4)) and rows[0]["magnitude_type"] == "Me"


def test_moments_of_ruptures_contain_the_modulus(postproc, catalogue):
    catalogue("c.csv")
    catalogue("r.csv", events="ruptures", modulus=0.5)
    for name in "c", "r":
        run(postproc, f"export {name}.csv -o {name}.t.csv", ROCK)
    both = [[float(row["magnitude"]) for row in table(f"{name}.t.csv")] for name in "cr"]
    assert both[1] == pytest.approx([m + 2 / 3 * math.log10(2) for m in both[0]])
    run(postproc, "magnitudes r.csv -o m --no-picture", ROCK).printed("Mw = \\(2/3\\) \\(log10 M0 - 9.1\\)")


def test_quakeml(postproc, catalogue):
    catalogue("c.csv")
    run(postproc, "export c.csv --format quakeml -o q.xml", ROCK)
    run(postproc, "export c.csv --format csep -o c.t.csv", ROCK)
    bed = "{http://quakeml.org/xmlns/bed/1.2}"
    root = xml.parse("q.xml").getroot()
    assert root.tag == "{http://quakeml.org/xmlns/quakeml/1.2}quakeml"
    events = root.findall(f"{bed}eventParameters/{bed}event")
    wanted = table("c.t.csv")
    assert len(events) == len(wanted) == 3 and len({event.get("publicID") for event in events}) == 3
    for event, row in zip(events, wanted):
        value = {
            path: event.find("/".join(bed + part for part in path.split("/"))).text
            for path in ("origin/time/value", "origin/longitude/value", "magnitude/mag/value", "magnitude/type")
        }
        assert value["origin/time/value"] == row["time_string"] + "Z" and value["magnitude/type"] == "Mw"
        assert value["magnitude/mag/value"] == row["mag"] and value["origin/longitude/value"] == row["lon"]
        assert event.find(f"{bed}preferredOriginID").text == event.find(f"{bed}origin").get("publicID")
    # postproc can read it itself.
    run(postproc, "count q.xml --size 1e6 --json n.json")
    assert json.loads(Path("n.json").read_text())["sizes"][0]["events"] == sum(float(row["mag"]) >= 4 for row in wanted) > 0


def test_nothing_is_chosen(postproc, catalogue):
    catalogue("c.csv")
    catalogue("slider.csv", model="block-slider")
    chosen = {"--time-unit": "1", "--start-date": "2000-01-01", "--magnitude-constant": "0"}
    for left_out in chosen:
        words = " ".join(f"{option} {value}" for option, value in chosen.items() if option != left_out)
        refused(postproc, f"export c.csv -o x.csv {words}", f"no {left_out}: a model has neither dates nor magnitudes, expected --unit-length")
    for left_out in "--unit-length 100", "--p-speed 6000", "--density 2700":
        for command in "export", "magnitudes":
            refused(postproc, f"{command} c.csv -o x " + ROCK.replace(left_out, ""), f"no {left_out.split()[0]}: expected all of")
    refused(postproc, f"export c.csv -o x.csv {ROCK} --time-unit day", "time-unit with --unit-length, from which it follows")
    refused(postproc, f"export c.csv -o x.csv {ROCK} --magnitude-constant 1", "magnitude-constant with --unit-length, from which it follows")
    for command in "export slider.csv -o x.csv", "magnitudes slider.csv -o x":
        refused(postproc, f"{command} {ROCK}", "slider.csv: model is 'block-slider', expected 'lsm' for SI units")


def test_catalogue_without_moments_says_how_to_record_them(postproc):
    t = np.array([0.0, 10.0])
    write_catalogue("c.csv", t, np.array([0.5, 0.05]), dict(model="lsm", length=40), t_end=t + 1, pe_start=[3] * 2, pe_end=[2] * 2)
    for command in "export c.csv -o x.csv", "magnitudes c.csv -o x":
        refused(postproc, f"{command} {ROCK}", "c.csv: has no column slip_moment.*-var location yes")
