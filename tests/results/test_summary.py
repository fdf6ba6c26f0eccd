# SPDX-License-Identifier: GPL-2.0-or-later
"""lsm.summary: one row of numbers for each catalogue, compared with the events and with postproc."""
import json
import math
import sys
from pathlib import Path

import numpy as np
import pytest
from data_files import read_catalogue, table, write_catalogue
from programs import SOURCE, run

sys.path.insert(0, str(SOURCE / "python"))
from lsm import summary  # noqa: E402


def test_summary(postproc, work):
    """Sizes span four decades, times are uneven, and every seventh event lasts one step."""
    random = np.random.default_rng(3)
    i, t, times, ends, steps = np.arange(1, 401), 0.0, [], [], []
    for n in i:
        t += 1 + int(-40 * math.log(1 - random.random())) / 2
        long = 8 if n % 7 else 1
        times.append(t)
        steps.append((int(2 * t), int(2 * t) + long))
        t += long * 0.5
        ends.append(t)
    size = 1e-5 * np.exp(9.2 * random.random(400))
    write_catalogue("c.csv", times, size, dict(model="lsm", dt=0.5, length=40), t_end=ends, step_start=[a for a, _ in steps],
                    step_end=[b for _, b in steps], pe_start=2 + size, pe_end=[2] * 400)
    found, = summary.rows_of(postproc.path, ["c.csv"], ["0", "1e-3"], ["1e-4:1e-2"], ["10:20"])
    _, events = read_catalogue("c.csv")
    apart = np.diff(events["t_start"][events["size"] >= 1e-3])
    time = events["t_end"][-1] - events["t_start"][0]
    wanted = {
        "events": 400, "events_0": 400, "events_0.001": len(apart) + 1, "mean_time_0.001": apart.mean(),
        "share_10:20_0.001": np.mean((apart >= 10) & (apart < 20)), "brief": np.mean(events["step_end"] - events["step_start"] <= 3),
        "in_events": np.sum(events["t_end"] - events["t_start"]) / time
    }
    for name, value in wanted.items():
        assert float(found[name]) == pytest.approx(value, rel=1e-5), name
    # The estimators are those of fit and intervals.
    run(postproc, "fit c.csv --range 1e-4:1e-2 --replicas 0 --no-comparison --json fit.json --no-picture")
    run(postproc, "intervals c.csv --threshold 1e-3 --method likelihood --delta 1 --replicas 0 -o times --no-picture")
    law, = json.loads(Path("fit.json").read_text())["fits"]
    assert float(found["exponent_1e-4:1e-2"]) == pytest.approx(law["exponent"], rel=1e-5)
    assert float(found["gamma_0.001"]) == pytest.approx(float(table("times.fits.csv")[0]["gamma"]), rel=1e-5)
    # From one time to another, and what a later one leaves out.
    later, = summary.rows_of(postproc.path, ["c.csv"], ["0"], begin=times[100], end=times[300], shortest=0)
    assert later["events"] == "200" and float(later["shortest_0"]) == 0
    with pytest.raises(ValueError, match="--range '2', expected LO:HI"):
        summary.rows_of(postproc.path, ["c.csv"], ranges=["2"])


def test_catalogues_with_too_few_events_have_no_fits(postproc, work):
    write_catalogue("few.csv", [1, 5], [1e-3, 2e-3], dict(model="lsm", length=40, dt=0.5))
    write_catalogue("none.csv", [], [], dict(model="lsm", length=40, dt=0.5))
    for path, events in ("few.csv", "2"), ("none.csv", "0"):
        row, = summary.rows_of(postproc.path, [path], ranges=["1e-4:1e-1"])
        assert row["events"] == events and row["gamma_0.0001"] == row["exponent_1e-4:1e-1"] == "", path
