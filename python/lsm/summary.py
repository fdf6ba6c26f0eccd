# SPDX-License-Identifier: GPL-2.0-or-later
"""One row of numbers for each catalogue of a model †, as texts. Exponents and densities of times are those of postproc.

  events, in_events, brief   number; share of the time within events; share of them that last 3 steps or less
  exponent_LO:HI, error_LO:HI   power law between these sizes by maximum likelihood
  events_S, mean_time_S    of the events of at least the size S: number, mean inter-event time
  share_LO:HI_S            of their inter-event times, the share in a window
  gamma_S, B_S, C_S, ...   generalised gamma density with delta = 1 of the times of at least `shortest`
"""
import math

import numpy as np

from lsm.analysis import events_of, numbers_of

BRIEF = 3  # steps
THRESHOLDS = ("1e-4", "1e-3", "1e-2", "1e-1")
NOTHING = "nothing to draw", "no bin of sizes"  # of postproc, if no catalogue has enough events


def told(value):
    return "" if value is None or math.isnan(value) else f"{value:.6g}"


def asked(postproc, command, paths, *words):
    """The fits of a command of postproc to these catalogues; none if they have too few events. \\raises ValueError"""
    try:
        return numbers_of(postproc, command, *paths, *words, "--replicas", 0, "--no-picture")["fits"]
    except ValueError as error:
        if not any(text in str(error) for text in NOTHING):
            raise
        return []


def share_within(times, window):
    """They are differences of times of steps, whose rounding is far below a millionth of an end."""
    low, high = (float(text) * (1 - 1e-6) for text in window.split(":"))
    return np.mean((times >= low) & (times < high)) if len(times) else math.nan


def simple_numbers(path, begin, end, thresholds, windows):
    """Those that rest on no fit."""
    events = events_of(path, begin, end)
    header, sizes = events.header, events["size"]
    time = events["t_end"].max() - events["t_start"][0] if len(events) else 0.0
    durations, least = events["t_end"] - events["t_start"], min(map(float, thresholds))
    row = {"events": str(len(events)), "in_events": told(durations.sum() / time) if time and header.get("events", "pe") == "pe" else ""}
    brief = durations[sizes >= least] <= (BRIEF + 0.5) * float(header.get("dt", math.nan))
    row |= {"brief": told(np.mean(brief)) if len(brief) and "dt" in header else ""}
    for text in thresholds:
        starts = events["t_start"][sizes >= float(text)]
        times, name = np.diff(starts), f"{float(text):g}"
        row |= {f"events_{name}": str(len(starts)), f"mean_time_{name}": told(np.mean(times)) if len(times) else ""}
        row |= {f"share_{window}_{name}": told(share_within(times, window)) for window in windows}
    return row


def rows_of(postproc, paths, thresholds=THRESHOLDS, ranges=(), windows=(), begin=-math.inf, end=math.inf, shortest=None, method="likelihood"):
    """A row for each catalogue, {name: text}, '' where there is no number. shortest, method: of postproc intervals. \\raises ValueError"""

    def repeated(option, texts):
        return [word for text in texts for word in (option, text)]

    common = [word for option, time in (("--from", begin), ("--to", end)) if math.isfinite(time) for word in (option, time)]
    laws = asked(postproc, "fit", paths, *repeated("--range", ranges), *common, "--no-comparison") if ranges else ()
    densities = asked(postproc, "intervals", paths, *repeated("--threshold", thresholds), *common, "--delta", 1, "--method", method, "--shuffles", 0,
                      *(["--shortest", shortest] if shortest is not None else []))
    laws, densities, rows = iter(laws), iter(densities), []
    for path in paths:
        row = simple_numbers(path, begin, end, thresholds, windows)
        for text in ranges:
            law = next(laws, {})
            row |= {f"{name}_{text}": told(law.get(key)) for name, key in (("exponent", "exponent"), ("error", "standard_error"))}
        for text in thresholds:
            density = next(densities, {})
            row |= {f"{key}_{float(text):g}": told(density.get(key)) for key in ("shortest", "gamma", "gamma_error", "B", "C")}
        rows.append(row)
    return rows
