# SPDX-License-Identifier: GPL-2.0-or-later
"""Progress of the runs of a study: runs done, events so far, time left."""
import re
import sys
import threading
import time
from pathlib import Path

NEARLY = 0.9999  # a run is done if done.json says so


class RunProgress:
    """Progress of one run; reads only what is new in its files."""

    def __init__(self, run):
        self.run, self.events, self.seen = run, 0, 0
        time = float(run.settings.get("time") or 0)
        self.steps = float(run.settings.get("steps") or time / float(run.settings.get("dt") or 0.05) or (2e6 if run.program == "slider" else 1.2e6))
        # Estimated core seconds: 65 discs per unit of length, 44 million steps of a disc per second; for a chain likewise.
        # ESyS-Particle takes 30 times as long. A rupture of a plane: its spacing is space and time.
        size = float(run.settings.get("blocks" if run.program == "slider" else "length", 120))
        of_step = {"fault": 65 * size / 44e6, "slider": 2e-7 + 3e-10 * size, "esys": 65 * size / 1.4e6, "catalogue": 1e-9}
        self.cost = self.steps * of_step[run.program] if run.program in of_step else 250 * (200 / float(run.settings.get("dx") or 200))**4

    def count_events(self):
        path = Path(self.run.catalogue)
        if not path.exists() or self.run.program == "catalogue":
            return self.events
        if path.stat().st_size < self.seen:
            self.events, self.seen = 0, 0
        with open(path, "rb") as file:
            file.seek(self.seen)
            lines = file.read().splitlines(keepends=True)
        whole = [line for line in lines if line.endswith(b"\n")]
        self.seen += sum(map(len, whole))
        self.events += sum(line[:1] not in (b"#", b"e") for line in whole)
        return self.events

    def share(self):
        folder = Path(self.run.name)
        if (folder / "done.json").exists():
            return 1.0
        steps = 0
        if self.run.program == "fault":
            infos = [info for info in folder.glob("fault.restart.*.info") if info.name.split(".")[2].isdigit()]
            if infos:
                newest = max(infos, key=lambda info: int(info.name.split(".")[2])).read_text()
                told = dict(line.split(" = ", 1) for line in newest.splitlines() if " = " in line)
                steps = int(told["step"]) - int(told["settle"])
        elif (folder / "output.txt").exists():
            with open(folder / "output.txt", "rb") as file:
                file.seek(max(0, (folder / "output.txt").stat().st_size - 2000))
                told = re.findall(rb"step (\d+) of (\d+)", file.read())
            if told:
                steps, self.steps = map(int, told[-1])
        return min(NEARLY, steps / self.steps)


def length_of_time(seconds):
    for unit, name, least in ((86400, "days", 2), (3600, "h", 2), (60, "min", 2)):
        if seconds >= least * unit:
            return f"{seconds / unit:.1f} {name}"
    return f"{seconds:.0f} s"


def line_of(runs, begun, elapsed):
    """The progress line. begun: share of the work that was done at the start; elapsed: seconds since then."""
    shares = [run.share() for run in runs]
    share = share_of_work(runs, shares)
    failed = sum(bool(run.run.failed) for run in runs)
    done = f"{sum(share == 1.0 for share in shares) - failed} of {len(runs)} runs done" + (f", {failed} failed" if failed else "")
    left = f", about {length_of_time(elapsed * (1 - share) / (share - begun))} left" if begun < share < 1 else ""
    return f"{done}, {sum(run.count_events() for run in runs)} events so far, {100 * share:.0f} % of the steps{left}"


def share_of_work(runs, shares=None):
    shares = shares or [run.share() for run in runs]
    return sum(run.cost * share for run, share in zip(runs, shares)) / sum(run.cost for run in runs)


def report_progress(study, minutes):
    """Prints a line on standard error now and every `minutes` minutes, until the program ends."""
    runs = [RunProgress(run) for run in study.runs.values()]
    begun, start = share_of_work(runs), time.monotonic()

    def tell():
        try:
            print(line_of(runs, begun, time.monotonic() - start), file=sys.stderr, flush=True)
        except (OSError, ValueError):
            pass  # a file is being replaced; it is read next time

    def go_on():
        while True:
            time.sleep(60 * minutes)
            tell()

    tell()  # not by the thread, which a study without anything to do would not wait for
    threading.Thread(target=go_on, daemon=True).start()
