# SPDX-License-Identifier: GPL-2.0-or-later
"""What a study says while it runs: runs done, events so far, time left; and at its end, which runs failed or are not done."""
import datetime
import os
import re
import signal
import sys
import threading
import time
from pathlib import Path
from types import SimpleNamespace

import yaml

NEARLY = 0.9999  # a run is done if done.json says so


def say(*lines):
    print(*lines, sep="\n  ", file=sys.stderr, flush=True)


def refuse(error):
    """Ends with one line of error before anything is started."""
    say(f"study.sh: {error}")
    os._exit(1)


def pass_on(number):
    """Passes a signal to this process on to the runs, before Snakemake, which waits for their end, hears of it."""
    before = signal.getsignal(number)

    def handler(number, frame):
        for children in Path("/proc/self/task").glob("*/children"):
            for child in children.read_text().split():
                os.kill(int(child), number)
        before(number, frame)

    signal.signal(number, handler)


def not_done(study):
    return [run for run in study.runs.values() if not Path(run.name, "done.json").exists()]


def say_submissions(study, minutes):
    """With -n, the commands by which the profile of a cluster would submit the runs."""
    profile = os.environ.get("LSM_PROFILE")
    command = yaml.safe_load(Path(profile).read_text()).get("cluster") if profile else None
    if command and {"-n", "--dry-run", "--dryrun"} & set(sys.argv):
        words = [dict(rule="simulation", wildcards=SimpleNamespace(run=run.name), threads=run.ranks,
                      resources=SimpleNamespace(ranks=run.ranks, runtime=minutes)) for run in not_done(study)]  # yapf: disable
        say("What would be submitted for each run:", *(f"{one['wildcards'].run}: {command.format(**one)}" for one in words))


def say_failures(study):
    """Names the runs that failed. They are done, as a repetition would fail in the same way, but no result."""
    failed = [f"{run.name}: {run.failed}" for run in study.runs.values() if run.failed]
    if failed:
        again = "left out of all results; with other settings, or its folder moved away, a run begins again"
        say(f"study.sh: {len(failed)} of {len(study.runs)} runs failed and are {again}:", *failed)
    return bool(failed)


def say_results(study):
    say(f"Results in {os.getcwd()}:", *study.results())
    if say_failures(study):
        os._exit(1)


def say_rest(study):
    say_failures(study)
    if rest := not_done(study):
        say(f"{len(rest)} of {len(study.runs)} runs are not done, start the study again to go on:", *(run.name for run in rest))


class RunProgress:
    """Progress of one run; reads only what is new in its files."""

    def __init__(self, run):
        self.run, self.events, self.seen = run, 0, 0
        time = float(run.settings.get("time") or 0)
        self.steps = float(run.settings.get("steps") or time / float(run.settings.get("dt") or 0.05) or (2e6 if run.program == "slider" else 1.2e6))
        # Estimated core seconds: 65 discs per unit of length, 44 million steps of a disc per second; for a chain likewise.
        # ESyS-Particle takes 30 times as long. A rupture of a plane: its spacing is space and time.
        size = float(run.settings.get("blocks" if run.program == "slider" else "length", 120))
        of_step = {"fault": 65 * size / 44e6, "slider": 2e-7 + 3e-10 * size, "esys": 65 * size / 1.4e6}
        self.cost = self.steps * of_step[run.program] if run.program in of_step else 250 * (200 / float(run.settings.get("dx") or 200))**4

    def count_events(self):
        path = Path(self.run.catalogue)
        if not path.exists():
            return self.events
        if path.stat().st_size < self.seen:
            self.events, self.seen = 0, 0
        with open(path, "rb") as file:
            file.seek(self.seen)
            whole = [line for line in file.read().splitlines(keepends=True) if line.endswith(b"\n")]
        self.seen += sum(map(len, whole))
        self.events += sum(line[:1] not in (b"#", b"e") for line in whole)
        return self.events

    def share(self):
        folder, steps = Path(self.run.name), 0
        if (folder / "done.json").exists():
            return 1.0
        if self.run.program == "fault":
            infos = (dict(re.findall(r"^(step|settle) = (\d+)$", path.read_text(), re.M)) for path in folder.glob("fault.restart.*.info"))
            steps = max((int(told["step"]) - int(told["settle"]) for told in infos), default=0)
        elif (output := folder / "output.txt").exists():
            with open(output, "rb") as file:
                file.seek(max(0, output.stat().st_size - 2000))
                told = re.findall(rb"step (\d+) of (\d+)", file.read())
            steps, self.steps = map(int, told[-1]) if told else (0, self.steps)
        return min(NEARLY, steps / self.steps)


def share_of_work(runs):
    return sum(run.cost * run.share() for run in runs) / sum(run.cost for run in runs)


def line_of(runs, begun, elapsed):
    """The progress line. begun: share of the work that was done at the start; elapsed: seconds since then."""
    share, failed = share_of_work(runs), sum(bool(run.run.failed) for run in runs)
    done = f"{sum(run.share() == 1.0 for run in runs) - failed} of {len(runs)} runs done" + (f", {failed} failed" if failed else "")
    left = f", about {datetime.timedelta(seconds=round(elapsed * (1 - share) / (share - begun)))} left" if begun < share < 1 else ""
    return f"{done}, {sum(run.count_events() for run in runs)} events so far, {100 * share:.0f} % of the steps{left}"


def report_progress(study, minutes):
    """Prints a line on standard error now and every `minutes` minutes, until the program ends."""
    runs = [RunProgress(run) for run in study.runs.values()]
    begun, start = share_of_work(runs), time.monotonic()

    def tell():
        try:
            say(line_of(runs, begun, time.monotonic() - start))
        except (OSError, ValueError, KeyError):
            pass  # a file is being replaced; it is read next time

    def go_on():
        while True:
            time.sleep(60 * minutes)
            tell()

    tell()  # not by the thread, which a study without anything to do would not wait for
    threading.Thread(target=go_on, daemon=True).start()


def begin(study, minutes):
    """Before the first run."""
    pass_on(signal.SIGINT)
    pass_on(signal.SIGTERM)
    study.check_programs()
    report_progress(study, minutes)
