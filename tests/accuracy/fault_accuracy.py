# SPDX-License-Identifier: GPL-2.0-or-later
"""Lattice solid fault: error against run time of one event and of waves; the size above which the catalogue of long runs depends neither
on the time step nor on the number of ranks; loose discs; picker readings; summation errors. Runs lmp and writes tables fault_*.csv.

Long runs that were completed in FOLDER/work with the same command are not repeated.
"""
import math
import os
import re
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np

SCENES = Path(__file__).resolve().parent
sys.path[:0] = [str(SCENES.parent), str(SCENES.parent.parent / "python")]
import lsm  # noqa: E402
from event_statistics import Estimate, agreement, exponent, gamma_density, paired, two_sample, unpaired_p  # noqa: E402
from programs import Program, run  # noqa: E402

# The same values as in fault_event.in and fault.in.
LENGTH, STRESS, VELOCITY, MEMORY, IMPEDANCE, COMPRESSION = 60.0, 0.02, 0.00025, 0.5, 0.6, 1200.0
HOURS = 24 * 3600  # no program takes as long
# name: kt, viscosity
VARIANTS = dict(standard=(1.0, 0.015), damped=(1.0, 0.05), light=(1.0, 0.005), soft=(0.1, 0.015), stiff=(10.0, 0.015))


class Failed(Exception):
    pass


def text(value):
    return f"{value:.12g}"


def around(distances):
    return distances - LENGTH * np.round(distances / LENGTH)


class Run:
    """Output of one run of lmp: CPU time of the last 'run' command on one rank; that of the whole run on all ranks, if it has a name; last
    thermo row, second column of all of them, and lines "name = number"."""

    def __init__(self, lines, cpu):
        self.seconds, self.cpu, self.last, self.second, self.printed, columns = 0.0, cpu, {}, [], {}, []
        for words in (line.split() for line in lines if line.strip()):
            if words[0] == "Step":
                columns = words
            elif words[0] == "Loop" and len(words) > 3:
                self.seconds, columns = float(words[3]), []
            elif words[1:3] == ["CPU", "use"]:
                self.seconds *= 0.01 * float(words[0].rstrip("%"))
            elif len(words) == 3 and words[1] == "=":
                self.printed[words[0]] = float(words[2])
            elif columns and len(words) == len(columns):
                try:
                    self.last = dict(zip(columns, map(float, words)))
                except ValueError:
                    continue
                self.second += list(self.last.values())[1:2]


class Fault:

    def __init__(self, folder, quick, lmp, inputs, friction, postproc, mpiexec):
        self.folder, self.work, self.quick, self.lmp, self.inputs = Path(folder), Path(folder) / "work", quick, lmp, inputs
        self.friction_program, self.postproc = friction, Program("postproc", postproc)
        self.mpiexec, self.states = " ".join(map(str, mpiexec)), {}

    def table(self, name, columns):
        """Returns a function that adds a row. \\raises OSError"""
        path = self.folder / name
        path.write_text(columns + "\n")

        def row(form, *values):
            with path.open("a") as file:
                file.write(form % values + "\n")

        return row

    def run(self, script, variables, ranks=1, name=None):
        """Runs lmp in FOLDER/work. With a name, the output is in NAME.out and the command in NAME.command, and a run that was completed with
        the same command is not repeated. \\raises Failed with the error line of lmp"""
        command = (f"{self.mpiexec} {ranks} " if ranks > 1 else "") + f"'{self.lmp}' -in '{script}' -log none"
        command += "".join(f" -var {key} '{value}'" for key, value in variables.items())
        output, mark, took = (self.work / f"{name or 'output'}{ending}" for ending in (".out" if name else ".txt", ".command", ".cpu"))
        if not name or not mark.exists() or mark.read_text().rstrip("\n") != command:
            with output.open("w") as out:
                child = subprocess.Popen(["bash", "-c", command], cwd=self.work, stdout=out, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL)
                _, status, usage = os.wait4(child.pid, 0)
                child.returncode = os.waitstatus_to_exitcode(status)
            if status:
                error = re.search(r"^.*ERROR.*$", output.read_text(errors="replace"), re.M)
                raise Failed(error[0] if error else f"{command} failed")
            if name:
                took.write_text(f"{usage.ru_utime} {usage.ru_stime}\n")
                mark.write_text(command + "\n")
        cpu = sum(map(float, took.read_text().split())) if name else 0.0
        return Run(output.read_text(errors="replace").splitlines(), cpu)

    def event_run(self, **variables):
        return self.run(SCENES / "fault_event.in", variables)

    def dumped(self, name):
        """Rows of a dump, by snapshot. \\raises Failed if there are none"""
        parts = re.split(r"^ITEM: (?:ATOMS|ENTRIES).*\n", (self.work / name).read_text(), flags=re.M)[1:]
        found = [np.array([line.split() for line in part.split("ITEM:")[0].splitlines()], float) for part in parts]
        if not found or not len(found[0]):
            raise Failed(f"{self.work / name}: nothing in it")
        return found

    def places(self, name):
        """x of the particles of a dump, by particle."""
        rows = self.dumped(name)[0]
        return dict(zip(rows[:, 0].astype(int), rows[:, 1]))

    def events(self, name):
        return lsm.read_catalogue(self.work / name)

    # ---- one event

    def prepare(self, name):
        """Loads a fault until its first event of 0.01 or more. Returns a state at least 6 time units before its start, and time, station and
        duration."""
        if name in self.states:
            return self.states[name]
        (kt, viscosity), prefix, dt = VARIANTS[name], f"load_{name}", 0.03
        # States are saved rarely at first, then often from the last of these on.
        seldom, often = 8192, 512
        shared = dict(kt=text(kt), viscosity=text(viscosity), dt=text(dt), prefix=prefix, series="no")
        self.event_run(**shared, every=seldom, steps=400000, enough=0.01)
        for event in self.events(f"{prefix}.csv"):
            if event["size"] < 0.01:
                continue
            # With this, the records of the patch are at the same times for every time step.
            step = (int(event["step_start"]) - 200) // often * often
            before = step // seldom * seldom
            if step > before:
                self.event_run(**shared, resume="yes", state=f"{prefix}.state.{before}", every=often, steps=step - before)
            # a multiple of every time step of the sweep
            span = math.ceil((event["t_end"] + 4.0 - step * dt) / 0.24) * 0.24
            x = event["x_centroid"]
            station = min(max(x - 8.0 if x + 8.0 > LENGTH else x + 8.0, 2.0), LENGTH - 2.0)
            self.states[name] = dict(state=f"{prefix}.state.{step}", time=span, station=station, duration=event["t_end"] - event["t_start"])
            return self.states[name]
        raise Failed(f"{prefix}.csv: no event of 0.01 or more")

    def arrival(self, name):
        """Time at which the velocity of the patch has changed by half of its largest change, interpolated linearly between records."""
        t, *v = np.loadtxt(self.work / name, ndmin=2).T
        change = np.hypot(v[0] - v[0][0], v[1] - v[1][0])
        half = 0.5 * change.max()
        late = [n for n in range(1, len(t)) if change[n] >= half]
        if not late:
            return math.nan
        n = late[0]
        return t[n - 1] + (t[n] - t[n - 1]) * (half - change[n - 1]) / (change[n] - change[n - 1])

    def one_event(self, saved, name, onset, treatment, dt, mass_floor=0.0):
        kt, viscosity = VARIANTS[name]
        steps = round(saved["time"] / dt)
        ran = self.event_run(resume="yes", state=saved["state"], kt=text(kt), viscosity=text(viscosity), onset=onset, treatment=treatment,
                             dt=text(dt), massfloor=text(mass_floor), steps=steps, thermo=steps, prefix="one", station=text(saved["station"]),
                             sample=round(0.12 / dt))
        ran.begin, ran.end = self.places("one.begin"), self.places("one.end")
        ran.size = max(self.events("one.csv")["size"], default=math.nan)
        ran.arrival = self.arrival("one.station")
        return ran

    @staticmethod
    def apart(a, b):
        """Sum of the squares of the distances of discs between two states."""
        return sum(float(around(np.array(a[i] - b[i])))**2 for i in a)

    def single_events(self):
        row = self.table("fault_event.csv", "variant,kt,viscosity,method,dt,seconds,error_profile,error_size,error_ledger,error_arrival")
        for name, (kt, viscosity) in VARIANTS.items():
            if self.quick and name != "standard":
                break
            saved, finest = dict(self.prepare(name)), 0.06 / 32 if self.quick else 0.06 / 64
            exact = self.one_event(saved, name, "located", "split", finest)
            slip = self.apart(exact.end, exact.begin)
            row(
                "# %s: reference dt %g in %.1f s, time %g, size %.6g, duration %.3g, rms displacement at the fault %.4g, arrival at x = %.1f after "
                "%.4g", name, finest, exact.seconds, saved["time"], exact.size, saved["duration"], math.sqrt(slip / len(exact.end)), saved["station"],
                exact.arrival - exact.last["Time"] + saved["time"])

            def sweep(method, onset, treatment, steps, mass_floor=0.0):
                for dt in steps:
                    if kt > 1.0 and dt > 0.03:
                        continue  # above the stability limit
                    tries = [self.one_event(saved, name, onset, treatment, dt, mass_floor) for _ in range(3 if dt > 0.01 else 1)]
                    one = tries[-1]
                    ledger = math.nan if method == "force" else abs(one.last["c_again[13]"]) / one.last["c_again[10]"]
                    row("%s,%g,%g,%s,%g,%.4g,%.4g,%.4g,%.4g,%.4g", name, kt, viscosity, method, dt, min(t.seconds for t in tries),
                        math.sqrt(self.apart(exact.end, one.end) / slip), abs(one.size / exact.size - 1), ledger, abs(one.arrival - exact.arrival))

            steps = (0.06, 0.03, 0.015, 0.0075, 0.00375)
            sweep("located", "located", "split", steps)
            sweep("step", "step", "split", steps)
            if name != "standard":
                continue
            sweep("force", "located", "force", steps)  # several times the run time
            # Effect of the time step and masses of preset absorbing on one event, which is recorded for longer, as larger masses delay it.
            saved["time"] += 24.0
            exact = self.one_event(saved, name, "located", "split", finest)
            slip = self.apart(exact.end, exact.begin)
            row("# floor: up to time %g, rms displacement at the fault %.4g", saved["time"], math.sqrt(slip / len(exact.end)))
            for floor in 0.04, 0.09:
                sweep(f"floor {floor}", "located", "split", (0.12, 0.06, 0.03, 0.015), floor)

    def friction(self):
        """Other ways of solving friction, by a program of their own, which also compares itself with lmp."""
        saved = dict(self.prepare("standard"))
        saved["time"] += 12.0  # the rupture comes later with other laws
        self.event_run(resume="yes", state=saved["state"], steps=0, listing="yes", prefix="list")
        by_lmp = self.one_event(saved, "standard", "located", "split", 0.03)
        constants = (LENGTH, VARIANTS["standard"][0], STRESS, VELOCITY, VARIANTS["standard"][1], IMPEDANCE, MEMORY)
        run(Program("friction", self.friction_program), self.work, self.folder / "fault_friction.csv", "quick" if self.quick else "full",
            text(saved["time"]), repr(float(by_lmp.size)), *map(text, constants), timeout=HOURS)

    def waves(self):
        row = self.table("fault_wave.csv", "scene,dt,seconds,speed,error")
        for scene, finest in (("p_wave_lattice.in", 0.00625), ("p_wave_packing.in", 0.00375)):
            runs = {dt: self.run(self.inputs / scene, {"dt": text(dt)}) for dt in (finest, *(finest * 2**k for k in (4, 3, 2, 1)))}
            exact = runs.pop(finest).printed["p_wave_speed"]
            for dt, one in runs.items():
                speed = one.printed["p_wave_speed"]
                row("%s,%g,%.3g,%.8g,%.3g", scene, dt, one.seconds, speed, abs(speed / exact - 1))

    # ---- sums

    def sums(self):
        row = self.table("precision.csv", "links,ranks,steps,pe_links,relative_error,change_over_100_steps,error_of_change")
        for ranks in 1, 2, 4:
            # The run on each number of ranks is compared with the exact sum of its own energies.
            printed = self.run(SCENES / "sums.in", {"length": 240 if self.quick else 1890, "write": "yes"}, ranks).second
            energies = [list(snapshot[:, -1]) for snapshot in self.dumped("sums.link")]
            if len(printed) != len(energies):
                raise Failed("sums.in: snapshots and thermo rows differ")
            for n in range(1, len(energies)):
                now, before = energies[n], [-e for e in energies[n - 1]]
                error = math.fsum([printed[n], *(-e for e in now)])
                row("%d,%d,%d,%.17g,%.3g,%.4g,%.3g", len(now), ranks, 100 * n, printed[n], error / math.fsum(now), math.fsum(now + before),
                    math.fsum([printed[n], -printed[n - 1], *(-e for e in now), *(-e for e in before)]))
        # A series that is disturbed by much more than these errors gives the same catalogue.
        row = self.table("precision_picker.csv", "disturbance_relative_to_pe,events,same_begin_and_end,largest_change_of_size")
        raw = (self.work / "long_remove_0.06_1.pe.bin").read_bytes()
        head = 24 + int.from_bytes(raw[16:24], "little")

        def picked(relative):
            samples = np.frombuffer(raw[head:], [("step", "<i8"), ("pe", "<f8")]).copy()
            samples["pe"] *= 1 + np.random.default_rng(1).uniform(-relative, relative, len(samples))
            (self.work / "disturbed.pe.bin").write_bytes(raw[:head] + samples.tobytes())
            return self.pick("disturbed.pe.bin", "--memory-time", MEMORY, "--min-size 1e-9")

        exact = picked(0.0)
        for relative in (1e-16, 1e-15, 1e-14, 1e-13, 1e-12, 1e-10):
            other = picked(relative)
            pairs = [(a, b) for a, b in zip(exact, other) if a["step_start"] == b["step_start"] and a["step_end"] == b["step_end"]]
            row("%g,%d,%d of %d,%.3g", relative, len(other), len(pairs), len(exact), max((abs(a["size"] - b["size"]) for a, b in pairs), default=0))

    def pick(self, series, *words):
        run(self.postproc, "pick", self.work / series, "-o", self.work / "picked.csv", "--overwrite --warmup 0", *words, timeout=HOURS)
        return self.events("picked.csv")

    # ---- long runs

    def start(self, one):
        """Runs inputs/fault.in."""
        variables = dict(preset="absorbing", length=text(LENGTH), memory=text(MEMORY), prefix=one.prefix, loose=one.loose, dt=text(one.dt),
                         massstep=text(one.mass_step), settle=round(COMPRESSION / one.dt), steps=round(one.time / one.dt), checkpoint=1000000000,
                         overwrite="yes", thermo=100000, series="yes" if one.series else "no")
        one.seconds = self.run(self.inputs / "fault.in", variables, one.ranks, one.prefix).cpu
        events = self.events(f"{one.prefix}.catalogue.csv")
        one.events = events[events["t_start"] >= COMPRESSION + WARMUP]

    def long_runs(self):
        ways = [("remove", 0.03, 1, True), ("remove", 0.06, 1, True), ("remove", 0.15, 1, True, 0.15), ("remove", 0.15, 2, False, 0.15)]
        if not self.quick:
            ways = [("remove", 0.015, 1, True), ("remove", 0.03, 1, False), ("remove", 0.06, 1, True), ("remove", 0.09, 1, False),
                    ("remove", 0.12, 1, False, 0.12), ("remove", 0.15, 1, True, 0.15), ("remove", 0.15, 2, False, 0.15),
                    ("remove", 0.18, 1, False, 0.18), ("keep", 0.03, 1, False), ("keep", 0.06, 1, False)]  # yapf: disable
        ways = [LongRun(15000.0 if self.quick else 90000.0, *way) for way in ways]
        # Two runs on one rank are done at a time, those on more ranks one after the other.
        with ThreadPoolExecutor(2) as two:
            list(two.map(self.start, [one for one in ways if one.ranks == 1]))
        for one in ways:
            if one.ranks > 1:
                self.start(one)
        row = self.table("fault_long_runs.csv",
                         "loose,dt,massstep,ranks,time,events,time_in_events,after_30_to_40,largest,released,seconds,time_per_core_hour")
        row(
            "# inputs/fault.in at length %g, events after the first %g time units of shear, by their begin. after_30_to_40: share of the events of "
            "1e-3 and more that begin 30 to 40 time units after the one before (the blocks swing with a period near 34). released: sum of the sizes; "
            "seconds: CPU time of all ranks", LENGTH, WARMUP)
        for one in ways:
            times, sizes = Sample(one, 1e-3).intervals, one.events["size"]
            row("%s,%g,%g,%d,%g,%d,%.3f,%.3f,%.4g,%.4g,%.0f,%.3g", one.loose, one.dt, one.mass_step, one.ranks, one.time, len(sizes),
                math.fsum(one.events["t_end"] - one.events["t_start"]) / (one.time - WARMUP),
                sum(30 < t < 40 for t in times) / len(times), max(sizes), math.fsum(sizes), one.seconds, 3600 * one.time / one.seconds)
        long = self.table(
            "fault_long.csv", "loose,dt,ranks,threshold,events,poisson_error,dispersion,ratio,in_both,only_in_first,only_here,brief,"
            "exponent,exponent_error,gamma,gamma_error,B,B_error,p_size,p_interval")
        verdicts = self.table("fault_completeness.csv",
                              "loose,up_to_dt,shortest,threshold,p_counts,p_exponent,p_gamma,p_B,p_size,p_interval,p_pairs,depends")
        for loose in "remove", "keep":
            same = [one for one in ways if one.loose == loose]
            compare(same, long)
            while len(same) > 1:
                for shortest in 0.0, MEMORY:
                    judge(same, shortest, verdicts)
                same = [one for one in same if one.dt != same[-1].dt]
        pickers = self.table("fault_picker.csv", "reading,memory,dt,events_1e-5,events_1e-4,events_3e-4,events_1e-3,events_1e-2,mean_duration_1e-3")
        for one in ways:
            for reading, memory in PICKERS if one.series else ():
                words = ("--memory-time", memory) if memory else ("--lambda", 0.99)
                events = self.pick(f"{one.prefix}.pe.bin", "--picker", reading, *words, "--min-size 0")
                events = events[events["t_start"] >= COMPRESSION + WARMUP]
                counts = [int(np.sum(events["size"] >= threshold)) for threshold in THRESHOLDS]
                large = events[events["size"] >= 1e-3]
                row_of = (reading, text(memory) if memory else "lambda 0.99", one.dt, *counts, math.fsum(large["t_end"] - large["t_start"]))
                pickers("%s,%s,%g,%d,%d,%d,%d,%d,%.3g", *row_of[:-1], row_of[-1] / counts[3])

    # ---- leaps

    def leaps(self):
        """Compares large events with and without leaps, and long catalogues by two-sample tests, and measures the cost per large event."""
        # The first run is without leaps; others of the same velocity are compared with it. Pairs of runs at other velocities follow,
        # without and with leaps.
        runs = [(2.5e-5, 0.0, 900000), (2.5e-5, 2.5e-4, 60000), (2.5e-5, 5e-5, 500000), (2.5e-4, 0.0, 60000), (2.5e-4, 2.5e-4, 60000),
                (2.5e-8, 2.5e-4, 60000)]
        if not self.quick:
            runs = [(2.5e-5, 0.0, 1600000), (2.5e-5, 2.5e-4, 210000), (2.5e-5, 1e-4, 440000), (2.5e-5, 5e-5, 950000), (2.5e-4, 0.0, 300000),
                    (2.5e-4, 2.5e-4, 300000), (2.5e-6, 2.5e-4, 200000), (2.5e-7, 2.5e-4, 200000), (2.5e-8, 2.5e-4, 200000)]
        row = self.table(
            "fault_leaps.csv", "velocity,fast,events,steps_per_event,model_time_per_event,seconds_per_event,paired,of,shift,"
            "scatter_of_shift,median_size_error,p_size,p_time")
        row(
            "# inputs/fault.in at length %g, events of %g and more; paired: with the run without leaps, by end and size; shift of the ends: times "
            "velocity / %g, so in time units of the paper's driving; p: that of two-sample tests (Kolmogorov-Smirnov) of sizes from 1e-3 on and of "
            "the times between them against the first run, times in the same units", LENGTH, LARGE, VELOCITY)
        first_ten = self.table("fault_leaps_first.csv", "event,start,size,centroid,fast,late,size_error,centroid_off")
        first_ten("# the first ten events of %g and more at %g without leaps, and the same with them; start, late: times velocity / %g", LARGE,
                  runs[0][0], VELOCITY)
        done, slow = {}, None
        for velocity, fast, steps in runs:
            name, unit = f"slow_{text(velocity)}_{text(fast)}", velocity / VELOCITY
            variables = dict(preset="absorbing", length=text(LENGTH), prefix=name, velocity=text(velocity), steps=text(steps), series="no",
                             location="yes", checkpoint=1000000000, overwrite="yes", thermo=100000)
            variables |= dict(leap="yes", fast=text(fast)) if fast else {}
            seconds = self.run(self.inputs / "fault.in", variables, 1, name).cpu
            events = done[velocity, fast] = self.events(f"{name}.catalogue.csv")
            large = events[events["size"] >= LARGE]
            if len(large) < 3:
                raise Failed(f"{name}: fewer than three large events")
            slow = slow or (large, sizes_and_times(events, unit))
            pairs = partners(slow[0], large) if fast and velocity == runs[0][0] else []
            shifts, errors = [], []
            for n, (event, at) in enumerate(zip(slow[0], pairs)):
                cells = ["-"] * 3
                if at is not None:
                    other = large[at]
                    shifts.append((other["t_end"] - event["t_end"]) * unit)
                    errors.append(abs(other["size"] / event["size"] - 1))
                    cells = ["%.4g" % ((other["t_start"] - event["t_start"]) * unit), "%.3g" % (other["size"] / event["size"] - 1),
                             "%.3g" % abs(around(other["x_centroid"] - event["x_centroid"]))]  # yapf: disable
                if n < 10:
                    first_ten("%d,%.6g,%.4g,%.4g,%g,%s", n + 1, event["t_start"] * unit, event["size"], event["x_centroid"], fast, ",".join(cells))
            intervals = len(large) - 1
            mine, cost = sizes_and_times(events, unit), (large[-1]["step_end"] - large[0]["step_end"]) / intervals
            row("%g,%g,%d,%.0f,%.4g,%.3g,%d,%d,%.3g,%.3g,%.3g,%.3g,%.3g", velocity, fast,
                len(large), cost, (large[-1]["t_end"] - large[0]["t_end"]) / intervals, seconds * cost / steps, len(shifts), len(pairs),
                quantile(shifts, 0.5), 0.5 * (quantile(shifts, 0.75) - quantile(shifts, 0.25)), quantile(errors,
                                                                                                         0.5), *map(two_sample, slow[1], mine))
        # Plates that always move at the fast velocity never leap.
        for velocity in [v for v, f in done if not f and (v, v) in done]:
            a, b = done[velocity, 0.0], done[velocity, velocity]
            same = len(a) == len(b) and all((a[key] == b[key]).all() for key in ("step_start", "step_end", "size"))
            row("# at %g with leaps %s of %d events are those without, to the last digit", velocity, "all" if same else "NOT all", len(a))


WARMUP, NEAR_START = 3000.0, 5.0  # time of shear after which the stress has reached its level; largest time between the starts of an event in two runs
THRESHOLDS, LARGE = (1e-5, 1e-4, 3e-4, 1e-3, 1e-2), 1e-2
PICKERS = (("exponential", 0), ("exponential", 0.45), ("exponential", 1.0), ("exponential", 3.0), ("exponential", 10.0), ("average", 0), ("literal",
                                                                                                                                          0))


class LongRun:

    def __init__(self, span, loose, dt, ranks, series, mass_step=0.0):
        self.loose, self.dt, self.ranks, self.series, self.mass_step = loose, dt, ranks, series, mass_step
        self.time = span / 2 if loose == "keep" else span
        self.prefix = f"long_{loose}_{text(dt)}_{ranks}"


class Sample:
    """Statistics of the events of a catalogue from a threshold on, of at least a duration. dispersion: variance / mean of counts in 30 equal
    stretches, 1 for a Poisson process; brief: number of events shorter than the memory of the picker."""

    def __init__(self, of, threshold, shortest=0.0):
        durations = of.events["t_end"] - of.events["t_start"]
        kept = (of.events["size"] >= threshold) & (durations >= shortest)
        self.starts, self.sizes = list(of.events["t_start"][kept]), list(of.events["size"][kept])
        self.intervals, self.brief = list(np.diff(self.starts)), int(np.sum(durations[kept] < MEMORY))
        stretches = 30
        at = (np.array(self.starts) - COMPRESSION - WARMUP) / ((of.time - WARMUP) / stretches)
        counts = np.bincount(np.minimum(at.astype(int), stretches - 1), minlength=stretches)
        n = len(self.sizes)
        self.dispersion = float(np.var(counts, ddof=1)) / (n / stretches) if n else math.nan
        self.count = Estimate(n, math.sqrt(n))
        self.exponent = exponent(self.sizes, threshold, 0.1 if threshold < 1e-2 else 1.0)
        self.gamma, self.b = gamma_density(self.intervals)


def least_of(values):
    """The smallest p of several tests, times their number."""
    return min(1.0, min(values, default=1.0) * len(values))


def compare(runs, row):
    """Compares runs that differ only in time step and ranks, the finest first: one row for each run and threshold."""
    for threshold in THRESHOLDS:
        finest = Sample(runs[0], threshold) if runs else None
        for one in runs:
            s = Sample(one, threshold)
            both, only_first, only_here = paired(finest.starts, s.starts, NEAR_START)
            row("%s,%g,%d,%g,%.0f,%.1f,%.2f,%.3f,%d,%d,%d,%d,%.3f,%.3f,%.3f,%.3f,%.1f,%.1f,%.3f,%.3f", one.loose, one.dt, one.ranks, threshold,
                *s.count, s.dispersion, s.count.value / finest.count.value, both, only_first, only_here, s.brief, *s.exponent, *s.gamma, *s.b,
                two_sample(finest.sizes, s.sizes), two_sample(finest.intervals, s.intervals))


def judge(runs, shortest, row):
    """Determines the size above which these runs agree."""
    start, any_depends = math.nan, False  # the smallest threshold above all those at which the runs differ
    loose, up_to = runs[0].loose, runs[-1].dt
    for threshold in THRESHOLDS:
        samples = [Sample(one, threshold, shortest) for one in runs]
        finest, others, dt = samples[0], samples[1:], [one.dt for one in runs]
        enough = all(len(s.sizes) >= 30 for s in samples)
        # Events are clustered: the error of a count is at least that from the counts in stretches.
        counts = [Estimate(math.log(s.count.value), math.sqrt(max(1.0, s.dispersion) / s.count.value)) if s.sizes else Estimate() for s in samples]
        p = [least_of(agreement(dt, estimates)) for estimates in (counts, *([getattr(s, of) for s in samples] for of in ("exponent", "gamma", "b")))]
        p += [least_of([two_sample(getattr(finest, of), getattr(s, of)) for s in others]) for of in ("sizes", "intervals")]
        p.append(least_of([unpaired_p(*paired(finest.starts, s.starts, NEAR_START)[1:]) for s in others]))
        depends = least_of(p) < 0.05
        row("%s,%g,%g,%g,%.3g,%.3g,%.3g,%.3g,%.3g,%.3g,%.3g,%s", loose, up_to, shortest, threshold, *p,
            "too few events" if not enough else "yes" if depends else "no")
        if enough:
            any_depends |= depends
            start = math.nan if depends else threshold if math.isnan(start) else start
    verdict = (f"from size {text(start)} on nothing is seen to depend on it"
               if not math.isnan(start) else "they depend on it up to the largest size looked at" if any_depends else "too few to tell")
    row("# loose discs %s, time steps up to %g, %s: %s", loose, up_to,
        "events not shorter than the memory of the picker" if shortest else "all events", verdict)


def partners(first, second):
    """For each large event of one run, the index of the nearest event of the other run within half the mean inter-event time whose size differs by
    at most a factor of 2, or None. Events near the end of the run are left out."""
    near = 0.5 * (first[-1]["t_end"] - first[0]["t_end"]) / (len(first) - 1)
    found, taken = [], set()
    for event in first:
        if event["t_end"] > second[-1]["t_end"] - near:
            break
        least, best = math.inf, None
        for n, other in enumerate(second):
            apart, size = abs(other["t_end"] - event["t_end"]) / near, abs(math.log(other["size"] / event["size"]))
            if n not in taken and apart <= 1 and size <= math.log(2) and apart + size <= least:
                least, best = apart + size, n
        found.append(best)
        taken.add(best)
    return found


def quantile(values, q):
    return sorted(values)[int(q * (len(values) - 1))] if values else math.nan


def sizes_and_times(events, unit, smallest=1e-3):
    """Sizes of at least the smallest, and the inter-event times in time units of the paper's driving."""
    kept = events[events["size"] >= smallest]
    return list(kept["size"]), list(np.diff(kept["t_start"]) * unit)


def measure(mode, parts, *settings):
    """Runs the parts that are wanted and says how long they took. settings: as Fault without quick"""
    fault = Fault(settings[0], mode == "quick", *settings[1:])
    for name, part in (("single events", fault.single_events), ("friction", fault.friction), ("waves", fault.waves), ("long runs", fault.long_runs),
                       ("leaps", fault.leaps), ("sums", fault.sums)):
        if name in parts:
            begin = time.monotonic()
            part()
            print(f"{name}: {time.monotonic() - begin:.0f} s", flush=True)
