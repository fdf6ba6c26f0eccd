#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Speed of the fault in LAMMPS beside other programs, cost of its parts and features, cost against length, set-up.

LMP has the styles of this package, STOCK_LMP is LAMMPS of the same version with BPM, GRANULAR and MOLECULE. FOLDER takes the
scenes, which are made once for each LMP, all timings (timings.csv) and the tables (tables.md). Runs that are compared take turns,
in rounds; tables hold medians over the rounds, and medians of the ratios within each round.
"""
import argparse
import csv
import datetime
import itertools
import math
import os
import re
import shutil
import sys
import time
from pathlib import Path

sys.dont_write_bytecode = True
HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent), str(HERE.parent.parent / "inputs")]
from bench_tables import PARTS, Tables  # noqa: E402
from convert import convert  # noqa: E402
from programs import INPUTS, Program, run  # noqa: E402
from run import MPI  # noqa: E402

WHAT = ("peers", "parts", "features", "lengths", "scale", "setup", "analysis", "causes", "dashpots", "campaign")
LENGTHS = (120, 240, 480, 945, 1440, 1890, 3780)
HOURS = 24 * 3600  # no run takes as long
COLUMNS = ("table", "label", "length", "ranks", "round", "atoms", "steps", "seconds", "cpu_percent", *PARTS, "resident")
# What is changed in a slice of a run, before it
CHANGES = {
    "nothing recorded": 'thermo_style custom step\nuncompute events\nif "$(is_defined(compute,ruptures))" then "uncompute ruptures"\n',
    "lists never rebuilt": "neigh_modify delay 0 every 1000000 check no\n",
}
CHANGES["neither location nor ruptures"] = (CHANGES["nothing recorded"] +
                                            "compute events all lsm/events catalogue slice.catalogue.csv series slice.pe.bin\n")
# Each feature takes turns with the base. With another law some contacts slip at first: the cost of the law is timed, and not that of
# lists that are rebuilt until the discs are at rest again.
CALM = dict(warmup=3000, viscosity=0.2)
RATE = "mu 0.6 a 0.01 b 0.015 dc 0.001 v0 0.0005"
FEATURES = {
    "PE and picking without files": dict(files="progress yes"),
    "catalogue without PE series": dict(files="catalogue ours.catalogue.csv overwrite yes"),
    "location of events": dict(location="yes"),
    "energy ledger": dict(ledger="yes"),
    "ranks sum PE every step": dict(block=1),
    "no friction (lsm/free)": dict(pairs="lsm/free", **CALM),
    "contacts of all discs": dict(name="_all", contacts="all"),  # its own fault, as overlapping discs would fly apart
    "static friction above dynamic": dict(mus=0.7),
    "slip weakening": dict(otherlaw="yes", law="slip-weakening mu 0.5 mu_static 0.6 dc 0.002 heal 5", **CALM),
    "velocity weakening": dict(otherlaw="yes", law="velocity-weakening mu 0.6 vc 0.02", **CALM),
    "rate and state (ageing)": dict(otherlaw="yes", law=f"rate-state-ageing {RATE}", **CALM),
    "rate and state (slip)": dict(otherlaw="yes", law=f"rate-state-slip {RATE}", **CALM),
    "links that can break": dict(ratio=1.5),
    "dashpots of links and contacts": dict(delay=0.02),
    "no viscosity": dict(viscosity=0),
    "pressure every 100 steps": dict(pressure=100),
    "pressure every step": dict(pressure=1),
    "fix that looks at each end of step": dict(foreign="yes"),
    "velocities of ghosts sent": dict(vel="yes"),
    "all lists rebuilt every 100 steps": dict(rebuild=100),
}  # yapf: disable


DASHPOTS = {"dashpots in links and contacts": {}, "no dashpots": dict(retardation=0, prefix="undamped", overwrite="yes")}


def say(*words):
    print(time.strftime("%H:%M:%S"), *words, file=sys.stderr, flush=True)


def variables(given):
    return [word for key, value in given.items() for word in ("-var", key, str(value))]


def timing(text):
    """What LAMMPS or ESyS-Particle printed about its last run, of all ranks. \\raises ValueError if there is no run"""
    loops = re.findall(r"^Loop time of (\S+) .* (\d+) steps.* (\d+) \S+$", text, re.M)
    if not loops:
        raise ValueError("no timing")
    seconds, steps, atoms = loops[-1]
    cpu = re.findall(r"^(\S+)% CPU use with", text, re.M)
    found = dict(seconds=seconds, steps=steps, atoms=atoms, cpu_percent=cpu[-1] if cpu else "")
    parts = re.findall(r"^(\w+) +\|[^|]*\| *([^|]*?) *\|", text, re.M)
    found |= {name.lower(): value for name, value in parts if name.lower() in PARTS}
    return found | {"resident": sum(map(int, re.findall(r"^resident (\d+)", text, re.M)))}


def shares_of_cpu():
    """Time that other machines took from this one, and all time."""
    cells = list(map(int, Path("/proc/stat").read_text().split()[1:9]))
    return cells[7], sum(cells)


class Bench:

    def __init__(self, lmp, stock, folder, quick, rounds, seconds, length, runs, native, native_esys):
        self.lmp, self.stock, self.runs, self.quick = lmp.resolve(), stock.resolve(), runs and runs.resolve(), quick
        self.native = [path.resolve() for path in native or ()]
        self.esys = {"ESyS-Particle": shutil.which("esysparticle"), "ESyS-Particle, -march=native": native_esys and native_esys.resolve()}
        self.rounds, self.seconds = rounds or (2 if quick else 7), seconds or (0.3 if quick else 1)
        self.few = min(self.rounds, max(2, (self.rounds + 1) // 2))
        self.length, self.cause_length = length or 1890, length or 480
        self.cores = len(os.sched_getaffinity(0))
        self.ranks = (1, 2) if self.cores > 1 else (1,)
        self.most = self.ranks[-1]
        self.measure = ["/usr/bin/time", "-f", "resident %M"] if Path("/usr/bin/time").exists() else []
        folder.mkdir(parents=True, exist_ok=True)
        os.chdir(folder)
        self.timings = self.table("timings", COLUMNS)

    def table(self, name, columns):
        """A function that adds a row to NAME.csv, which begins anew."""
        with open(f"{name}.csv", "w") as file:
            file.write(",".join(columns) + "\n")

        def add(row):
            with open(f"{name}.csv", "a", newline="") as file:
                csv.DictWriter(file, columns, lineterminator="\n", restval="").writerow(row)

        return add

    def mpi(self, ranks, *words, measured=True, **more):
        """Runs a program on so many ranks. Returns what it printed. \\raises AssertionError if it fails"""
        program = Program(Path(str(words[0])).name, HERE.parent / "mpirun.sh", "-np", ranks, *(self.measure if measured else []), env=MPI)
        done = run(program, [str(word) for word in words], timeout=HOURS, **more)
        return done.out + done.err

    def lammps(self, ranks, program, scene, given, log, *words, **more):
        text = self.mpi(ranks, program, "-in", scene, *variables(given), "-log", log, "-screen", "none", *words, **more)
        return text + Path(more.get("cwd", "."), log).read_text()

    def note(self, table, label, length, ranks, number, text):
        self.timings(dict(table=table, label=label, length=length, ranks=ranks, round=number) | timing(text))

    def in_rounds(self, what, rounds=None):
        rounds = rounds or self.few
        for number in range(1, rounds + 1):
            say(f"{what}, round {number} of {rounds}")
            yield number

    def steps(self, length, millions):
        """Number of steps of a run with so many million particle-steps per second."""
        return max(20, int(millions * 1e6 * self.seconds / (65.2 * length)))

    # ---- scenes

    def scene(self, length, contacts="fault"):
        """fault_LENGTH.restart and .data, and what other programs read; with contacts of all discs fault_LENGTH_all."""
        name = f"fault_{length}" + ("_all" if contacts == "all" else "")
        made = [Path(f"{name}.{ending}") for ending in ("restart", "geo")]
        if all(path.exists() and path.stat().st_mtime > self.lmp.stat().st_mtime for path in made):
            return
        say(f"making the fault of length {length}")
        self.lammps(self.most, self.lmp, HERE / "make.in", dict(length=length, name=name, contacts=contacts), "make.log", measured=False)
        convert(name)

    def ours(self, table, label, length, ranks, number, name="", lmp=None, **given):
        given = dict(name=f"fault_{length}{name}", steps=self.steps(length, 60 * ranks)) | given
        self.note(table, label, length, ranks, number, self.lammps(ranks, lmp or self.lmp, HERE / "ours.in", given, "ours.log"))

    def slice(self, table, label, folder, ranks, number, **given):
        """A part of the run of fault.in in a folder, from its newest restart file, with everything that it records."""

        def header(path):
            return dict(re.findall(r"^(\w+) = (.*)$", path.read_text(), re.M))

        info = max(folder.glob("*.restart.*.info"), key=lambda path: float(header(path)["step"]))
        prefix, restart = info.name.split(".restart.")[0], info.with_suffix("")
        shutil.rmtree("slice", ignore_errors=True)
        Path("slice").mkdir()
        beside = [folder / f"{prefix}.{ending}" for ending in ("catalogue.csv", "pe.bin", "ruptures.csv", "slip.bin")]
        for path in (INPUTS / "fault.in", INPUTS / "fault.variables", HERE / "slice.in", info, restart, *filter(Path.exists, beside)):
            shutil.copy(path, "slice")
        Path("slice/change.in").write_text(CHANGES.get(label, ""))
        length = int(header(info)["length"])
        environment = dict(SLICE_WARM="50", SLICE_STEPS=str(self.steps(length, 60 * ranks)), SLICE_CHANGE="change.in")
        text = self.lammps(ranks, self.lmp, "fault.in", dict(restart=restart.name, extra="slice") | given, "slice.log", cwd="slice", env=environment)
        self.note(table, label, length, ranks, number, text)

    # ---- what is measured

    def peers(self):
        self.scene(self.length)
        if not self.esys["ESyS-Particle"]:
            print("ESyS-Particle is not installed and left out (Debian package esys-particle)", file=sys.stderr)
        name = f"fault_{self.length}"
        kinds = [("", self.lmp, self.stock, ("",))]
        if self.native:
            kinds.append((", -march=native", *self.native, ("", "/omp")))
        for number in self.in_rounds("peers", self.rounds):
            for (flags, lmp, stock, suffixes), ranks in itertools.product(kinds, self.ranks):
                self.ours("peers", "ours" + flags, self.length, ranks, number, lmp=lmp)
                for label, links, rate in (("harmonic", "harmonic", 25), ("bpm/spring", "bpm", 15), ("harmonic with contacts", "contacts", 20)):
                    given = dict(name=name, steps=self.steps(self.length, rate * ranks), links=links)
                    for suffix in suffixes if links == "harmonic" else suffixes[:1]:
                        words = ["-sf", "omp", "-pk", "omp", "1"] if suffix else []
                        text = self.lammps(ranks, stock, HERE / "stock.in", given, "stock.log", *words)
                        self.note("peers", f"bond {label}{suffix}{flags}", self.length, ranks, number, text)
            for label, ranks in itertools.product(self.esys, self.ranks):
                # In addition to its workers ESyS-Particle has a process that directs them and never sleeps.
                if self.esys[label] and number <= self.few and ranks < self.cores:
                    for path in Path(".").glob(f"{name}.esys.*"):
                        path.unlink()
                    words = (HERE / "esys_particle.py", name, ranks, self.length, self.steps(self.length, 10), 3)
                    try:
                        self.note("peers", label, self.length, ranks, number, self.mpi(ranks + 1, self.esys[label], *words))
                    except (AssertionError, ValueError) as error:
                        self.esys[label] = None
                        print(f"{label} failed and is left out: {error}", file=sys.stderr)

    def parts(self):
        """Each run leaves out one more feature; particles do not move, so that the contacts are the same."""
        self.scene(self.length)
        for number in self.in_rounds("parts"):
            for ranks in self.ranks:
                self.ours("parts", "everything", self.length, ranks, number)
                without = {}
                for part in ("events", "plates", "integration", "contacts", "links"):
                    without |= {"contacts": dict(pairs="none"), "integration": dict(move="no")}.get(part, {part: "no"})
                    self.ours("parts", part, self.length, ranks, number, **without)

    def features(self):
        self.scene(self.length)
        self.scene(self.length, "all")
        for number in self.in_rounds("features", self.rounds):
            for label, given in ({"nothing recorded": dict(events="no")} | (FEATURES if number <= self.few else {})).items():
                self.ours("features", f"base of {label}", self.length, self.most, number)
                self.ours("features", label, self.length, self.most, number, **given)

    def lengths(self):
        """Also the bandwidth of caches and memory for the same amount of data."""
        for length in LENGTHS:
            self.scene(length)
        for number in self.in_rounds("lengths"):
            for length in LENGTHS:
                for ranks in self.ranks:
                    self.ours("lengths", "ours", length, ranks, number)
        add = self.table("triad", ("ranks", "megabytes", "gb_per_second"))
        if not self.compiled("triad", "-O3", "-march=native", "-o", "triad", HERE / "triad.c"):
            return
        for ranks in self.ranks:
            say(f"triad, {ranks} ranks")
            text = self.mpi(ranks, Path("triad").resolve(), 0.25, 0.5, 1, 2, 4, 8, 16, 32, 64, measured=False)
            for megabytes, rate in re.findall(r"^triad (\S+) (\S+)", text, re.M):
                add(dict(ranks=ranks, megabytes=megabytes, gb_per_second=rate))

    def compiled(self, what, *words):
        done = run(Program("mpicc", "mpicc"), [str(word) for word in words], status=None)
        if done.status:
            print(f"mpicc failed, {what} is left out: {done.err}", file=sys.stderr)
        return done.status == 0

    def scale(self):
        """Messages between ranks are counted, not timed, as the difference between two runs, so that set-up does not count."""
        counts = ("messages", "bytes", "collectives", "nonblocking")
        add = self.table("scale", ("length", "ranks", "particles", "largest_share", "ghosts", *counts, "pe"))
        if not self.compiled("what ranks send", "-O2", "-shared", "-fPIC", "-o", "count_mpi.so", HERE / "count_mpi.c"):
            return
        for length in (120, 480, self.length):
            self.scene(length)
            for ranks in (1, 2, 4, 8):
                say(f"scale, length {length}, {ranks} ranks")
                sums, text = [], ""
                for steps in (100, 200):
                    program = ["env", f"LD_PRELOAD={Path('count_mpi.so').resolve()}", self.lmp]
                    words = ["-in", HERE / "ours.in", *variables(dict(name=f"fault_{length}", steps=steps)), "-log", "scale.log", "-screen", "none"]
                    text = self.mpi(ranks, *program, *words, measured=False)
                    sums.append([sum(map(float, cells)) for cells in zip(*(line.split()[2:6] for line in re.findall(r"^count_mpi .*", text, re.M)))])
                log = Path("scale.log").read_text()
                ave, largest = map(float, re.search(r"^Nlocal: +(\S+) ave +(\S+) max", log, re.M).groups())
                ghosts, pe = (re.search(pattern, log, re.M)[1] for pattern in (r"^Nghost: +(\S+)", r"^PE (\S+)"))
                found = dict(length=length, ranks=ranks, particles=timing(log)["atoms"], largest_share=f"{largest / ave:.4f}",
                             ghosts=f"{float(ghosts):.1f}", pe=pe)
                add(found | {key: f"{(b - a) / ranks / 100:.3f}" for key, a, b in zip(counts, *sums)})

    def setup(self):
        columns = ("create", "first_step", "read_restart", "write_restart")
        add = self.table("setup", ("ranks", "round", *columns))
        for number in self.in_rounds("setup"):
            for ranks in self.ranks:
                text = self.lammps(ranks, self.lmp, HERE / "make.in", dict(length=self.length, name="setup", settle=1), "setup.log", measured=False)
                cells = re.search(r"^setup create (\S+) first_step (\S+) read_restart (\S+) write_restart (\S+)", text, re.M).groups()
                add(dict(ranks=ranks, round=number) | dict(zip(columns, cells)))
        for path in ("setup.restart", "setup.data"):
            Path(path).unlink()

    def analysis(self):
        """postproc beside LMP on a catalogue of sizes 1e-3 to 1 with exponent 1.07, intervals exponential."""
        import numpy as np
        add, postproc = self.table("analysis", ("events", "command", "seconds", "kilobytes")), self.lmp.with_name("postproc")
        if not (postproc.exists() and self.measure):
            print(f"no {postproc} or no GNU time, the analysis is left out", file=sys.stderr)
            return
        events, random = (100000 if self.quick else 10000000), np.random.default_rng(1)
        low = 1e-3**-0.07
        sizes = (low + random.uniform(size=events) * (1 - low))**(-1 / 0.07)
        waits, lasts = random.exponential(300, events).astype(int), random.uniform(0, 300, events).astype(int)
        ends = np.cumsum(waits + lasts + 2)
        with open("analysis.catalogue.csv", "w") as file:
            file.write("# lsm-catalogue 1\n# model = lsm\n# dt = 0.12\n# completeness = 0.001\n"
                       "event_id,t_start,t_end,step_start,step_end,size,pe_start,pe_end\n")
            file.writelines(f"{n},{start * 0.12:.2f},{end * 0.12:.2f},{start},{end},{size:.9g},1.5,{1.5 - size:.9g}\n"
                            for n, (start, end, size) in enumerate(zip((ends - lasts - 1).tolist(), ends.tolist(), sizes.tolist()), 1))
        commands = ("histograms", "magnitudes", "fit --replicas 0 --no-comparison", "intervals --replicas 0 --shuffles 0")
        timed = Program("postproc", "/usr/bin/time", "-o", "analysis.time", "-f", "%e,%M", postproc)

        def time_of(command, label=None):
            run(timed, command, "analysis.catalogue.csv --no-picture -o analysed --overwrite", timeout=HOURS)
            seconds, kilobytes = Path("analysis.time").read_text().split()[-1].split(",")
            add(dict(events=events, command=label or command, seconds=seconds, kilobytes=kilobytes))

        for _ in self.in_rounds("analysis"):
            for command in commands:
                time_of(command)
        say("analysis, random series")
        time_of("intervals --replicas 0", "intervals with random series")
        Path("analysis.catalogue.csv").unlink()

    def run_of_fault(self, name, steps, **given):
        """Folder of a run of fault.in that is made once for each LMP."""
        length = self.cause_length
        folder = Path(f"{name}_{length}")
        made = folder / "fault.restart.end.info"
        if not (made.exists() and made.stat().st_mtime > self.lmp.stat().st_mtime):
            say(f"making a fault of length {length}, {name}")
            shutil.rmtree(folder, ignore_errors=True)
            folder.mkdir()
            self.lammps(self.most, self.lmp, INPUTS / "fault.in",
                        dict(length=length, steps=steps, prefix="fault") | given, "make.log", cwd=folder, measured=False)
        return folder

    def dashpots(self):
        """What those of the leaky fault cost in shear."""
        folder = self.run_of_fault("shear", steps=1000 if self.quick else 60000)
        for number in self.in_rounds("dashpots", self.rounds):
            for ranks in self.ranks:
                for label, given in DASHPOTS.items():
                    self.slice("dashpots", label, folder, ranks, number, **given)

    def causes(self):
        """Why a step of a run of RUNS takes longer than one of these scenes."""
        if not self.runs:
            return
        length = self.cause_length
        self.scene(length)
        self.scene(length, "all")
        before = self.run_of_fault("before", steps=0)
        between = self.run_of_fault("between", steps=2000 if self.quick else 240000, ruptures="yes", contacts="fault")
        for number in self.in_rounds("causes"):
            self.ours("causes", "scene of the comparisons", length, 1, number)
            self.ours("causes", "with contacts of all discs", length, 1, number, name="_all", contacts="all")
            self.slice("causes", "default scene before the shear", before, 1, number)
            self.slice("causes", "contacts between the blocks only", between, 1, number)
            for label in ("in shear as in the campaign", "neither location nor ruptures", "nothing recorded", "lists never rebuilt"):
                self.slice("causes", label, self.runs / f"fault_{length}_1", 1, number)

    def campaign(self):
        """Slices of all runs of RUNS."""
        for number in self.in_rounds("campaign") if self.runs else ():
            for folder in sorted(self.runs.glob("fault_*_1")):
                for ranks in self.ranks:
                    self.slice("campaign", "slice", folder, ranks, number)


def main(only, **options):
    bench, begin, before, load = Bench(**options), time.monotonic(), shares_of_cpu(), os.getloadavg()
    for name in WHAT:
        if name in only:
            getattr(bench, name)()
    taken, whole = (b - a for a, b in zip(before, shares_of_cpu()))
    model = re.search(r"^model name\s*: (.*)$", Path("/proc/cpuinfo").read_text(), re.M)
    minutes, seconds = divmod(int(time.monotonic() - begin), 60)
    text = (f"{datetime.datetime.utcnow():%Y-%m-%d %H:%M} UTC, {model[1] if model else 'unknown processor'}, {bench.cores} cores, load before "
            f"{' '.join(f'{x:.2f}' for x in load)}, {100 * taken / max(whole, 1):.1f} % of the time taken by other machines, fault of length "
            f"{bench.length}, {bench.rounds} rounds of the comparisons and {bench.few} of the rest, {minutes} min {seconds} s.\n"
            f"{Tables(Path('.')).text()}")
    Path("tables.md").write_text(text)
    print(text, end="")


def some_of(text):
    if not set(text.split(",")) <= set(WHAT):
        raise argparse.ArgumentTypeError(f"'{text}', expected some of {','.join(WHAT)}")
    return text.split(",")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("lmp", metavar="LMP", type=Path)
    parser.add_argument("stock", metavar="STOCK_LMP", type=Path)
    parser.add_argument("folder", metavar="FOLDER", type=Path)
    parser.add_argument("--quick", action="store_true", help="some three minutes: shorter runs, fewer rounds")
    parser.add_argument("--rounds", metavar="N", type=int,
                        help="rounds of peers and of recording on or off (7, quick 2); others have half as many, but at least 2")
    parser.add_argument("--seconds", metavar="S", type=float, help="a run takes about so long (1, quick 0.3)")
    parser.add_argument("--length", metavar="L", type=int, help="fault of the comparisons and of causes (1890; causes 480)")
    parser.add_argument(
        "--only", metavar="WHAT,...", type=some_of, default=WHAT,
        help=f"{', '.join(WHAT)} (all); scale runs up to 8 ranks, whatever the cores; analysis: postproc beside LMP, 1e7 events "
        "(quick 1e5)")
    parser.add_argument(
        "--runs", metavar="RUNS", type=Path,
        help="folder of a study with runs fault_LENGTH_1, done or under way (inputs/study.sh campaign); causes and campaign begin "
        "with the newest restart file of each, and are left out without it")
    parser.add_argument("--native", metavar=("LMP", "STOCK"), nargs=2, type=Path,
                        help="the same two programs, compiled with -march=native, the second with package OPENMP: further peers")
    parser.add_argument("--native-esys", metavar="PATH", type=Path, help="ESyS-Particle compiled with -O3 -march=native, a further peer")
    try:
        main(**vars(parser.parse_args()))
    except (AssertionError, OSError, ValueError) as error:
        sys.exit(f"bench_lsm.py: {error}")
