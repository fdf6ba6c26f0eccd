#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""The accuracy report: tables, work-precision diagrams and a text, all from runs made here.

accuracy.py full|quick FOLDER SLIDER_PROGRAM FRICTION_PROGRAM POSTPROC PHYSICS_TESTS LMP INPUTS MPIEXEC...

full takes some 20 minutes on 2 cores, quick about 3. The report is FOLDER/report.md. LSM_ACCURACY_PARTS="long runs,sums" runs only
those parts (slider, single events, friction, waves, long runs, leaps, sums, ruptures, extremes, or text: none) and keeps what is in
FOLDER: tables of the other parts, long runs that have ended. The report says what is missing.
"""
import math
import os
import re
import shutil
import subprocess
import sys
import time
from pathlib import Path

sys.dont_write_bytecode = True
SCENES = Path(__file__).resolve().parent
sys.path.insert(0, str(SCENES.parent))
import fault_accuracy  # noqa: E402
from programs import Program, run  # noqa: E402

PARTS = ("slider", "single events", "friction", "waves", "long runs", "leaps", "sums", "ruptures", "extremes")
HOURS = 24 * 3600  # no part takes as long
SCHEMES = ("printed", "verlet", "rk4")
METHODS = {"located": "onset located", "step": "onset at the step", "force": "viscosity as a force", "floor 0.04": "masses of at least 0.04",
           "floor 0.09": "masses of at least 0.09"}  # yapf: disable
# Okabe-Ito colours; each line has its own point type and dash as well.
STYLE = """set datafile separator ","
set grid lc rgb "#cccccc"
set key outside right top
set pointsize 1.1
set linetype 1 lc rgb "#0072B2" pt 7 dt 1 lw 1.5
set linetype 2 lc rgb "#D55E00" pt 5 dt 2 lw 1.5
set linetype 3 lc rgb "#009E73" pt 9 dt 3 lw 1.5
set linetype 4 lc rgb "#CC79A7" pt 11 dt 4 lw 1.5
set linetype 5 lc rgb "#E69F00" pt 13 dt 5 lw 1.5
set linetype 6 lc rgb "#000000" pt 1 dt 1 lw 1
set format "10^{%T}"
set logscale xy
"""

# ---- tables: columns are counted from 1, as in what the programs write


def lines_of(name):
    """The lines of a table without its remarks, as cells after an empty one; None if the table is missing."""
    path = Path(name)
    if not path.exists():
        return None
    separator = "\t" if path.suffix == ".tsv" else ","
    return [["", *line.split(separator)] for line in path.read_text().splitlines() if not line.startswith("#")]


def rows_of(name, where=lambda row: True):
    return [row for row in (lines_of(name) or [])[1:] if where(row)]


def markdown(name):
    lines = lines_of(name)
    if lines is None:
        return f"(not run: {name})"
    text = [f"| {' | '.join(cell.replace('|', chr(92) + '|') for cell in line[1:])} |" for line in lines]
    return "\n".join([text[0], "|" + "---|" * (len(lines[0]) - 1), *text[1:]])


def remarks(name):
    path = Path(name)
    return "\n".join("- " + line[2:] for line in path.read_text().splitlines() if line.startswith("# ")) if path.exists() else ""


def number(text):
    return float(text) if text else math.nan


def order(name, where, x, y):
    """Slope of the logarithm of the error over that of the step."""
    if lines_of(name) is None:
        return "(not run)"
    points = [(math.log(number(row[x])), math.log(number(row[y]))) for row in rows_of(name, where) if number(row[y]) > 0]
    n, sx, sy = len(points), sum(p[0] for p in points), sum(p[1] for p in points)
    sxx, sxy = sum(p[0]**2 for p in points), sum(p[0] * p[1] for p in points)
    return f"{(n * sxy - sx * sy) / (n * sxx - sx * sx):.2f}" if n > 1 else "-"


def value(name, where, column):
    if lines_of(name) is None:
        return "(not run)"
    return next((row[column] for row in rows_of(name, where)), "")


# ---- diagrams


class Diagram:
    """Curves of filtered rows; nothing is drawn if a table is missing or no row is left."""

    def __init__(self, name, settings):
        self.name, self.settings, self.data, self.plots, self.missing = name, settings, "", [], False

    def add(self, table, where, using, style):
        """using, style: of a plot command in which columns are those of the table."""
        self.missing = self.missing or not Path(table).exists()
        rows = rows_of(table, where)
        if rows:
            block = f"$d{len(self.plots)}"
            self.data += f"{block} << EOD\n" + "".join(",".join(row[1:]) + "\n" for row in rows) + "EOD\n"
            self.plots.append(f"{block} using {using} with {style}")

    def line(self, table, where, x, y, title, kind, step=None):
        """A line with points; beside them the time step, if its column is given."""
        self.add(table, where, f"{x}:{y}", f"linespoints lt {kind} title '{title}'")
        if step:
            up = 0.5 if kind % 2 else -0.5  # labels of two lines that lie close together
            self.add(table, where, f"{x}:{y}:(sprintf('%g', ${step}))", f"labels left offset 0.7,{up} font ',9' tc lt {kind} notitle")

    def draw(self, more=""):
        if self.missing or not self.plots:
            return
        for kind, terminal in (("png", "pngcairo size 1000,600 font 'sans,13'"), ("svg", "svg size 1000,600 font 'sans,13'")):
            head = f"set terminal {terminal}\nset output '{self.name}.{kind}'\n{STYLE}{self.settings}\n{self.data}"
            run(Program("gnuplot", "gnuplot", "-d", "-"), input=f"{head}plot {', '.join(self.plots)}{more}\n", stdin=None)


def diagrams():
    profile = Diagram(
        "slider_event_profile", "set title 'Block-slider, one event: slip profile'\nset xlabel 'run time (s)'; "
        "set ylabel 'largest error of slip / largest slip'; set yrange [1e-11:10]; set xrange [1e-5:1e-1]")
    size = Diagram(
        "slider_event_size", "set title 'Block-slider, one event: drop of potential energy'\nset xlabel 'run time (s)'; "
        "set ylabel 'relative error of the drop of PE'; set yrange [1e-11:10]")
    long = Diagram(
        "slider_long", "set title 'Block-slider, long runs'\nunset logscale y; set format y '%g'\nset xlabel 'run time (s)'; "
        "set ylabel 'characteristic size <s^2> / <s>'")
    for n, scheme in enumerate(SCHEMES, 1):
        profile.line("slider_event.csv", lambda row: row[1] == scheme, 3, 4, scheme, n, 2)
        size.line("slider_event.csv", lambda row: row[1] == scheme, 3, 5, scheme, n)
        long.add("slider_long.csv", lambda row: row[1].startswith(scheme), "3:7:8", f"yerrorbars lt {n} title '{scheme}'")
    growth = Diagram(
        "slider_growth", "set title 'Growth of an undamped oscillation'\nset xlabel 'time step'; "
        "set ylabel 'growth rate of the amplitude (1/time)'; set yrange [1e-9:1]")
    growth.add("slider_growth.csv", lambda row: row[1].startswith("printed"), "2:3", "points lt 1 title 'printed'")
    growth.add("slider_growth.csv", lambda row: row[1].startswith("printed"), "2:4", "lines lt 6 title 'h w^2 / 4'")
    growth.add("slider_growth.csv", lambda row: row[1].startswith("verlet"), "2:(abs($3))", "points lt 3 title 'verlet, absolute'")
    for one in (profile, size, growth, long):
        one.draw()

    for name, column, axis in (("profile", 7, "rms error of displacement at the fault / rms displacement"), ("size", 8,
                                                                                                             "relative error of event size"),
                               ("ledger", 9, "residual of the ledger / work of the plates"), ("arrival", 10, "error of arrival time at a station")):
        for variant in variants():
            one = Diagram(f"fault_event_{name}_{variant}",
                          f"set title 'Fault, one event ({variant})'\nset xlabel 'CPU time (s)'; set ylabel '{axis}'")
            for n, (method, title) in enumerate(METHODS.items(), 1):
                some = rows_of("fault_event.csv", lambda row: row[1] == variant and row[4] == method)
                if any(row[column] != "nan" for row in some):
                    one.line("fault_event.csv", lambda row: row[1] == variant and row[4] == method, 6, column, title, n, 5)
            one.draw()
    for name, column, axis in (("own", 6, "displacement at the fault off that of the same law, small step"),
                               ("rigid", 8, "displacement at the fault off that without spring, small step")):
        one = Diagram(f"fault_friction_{name}",
                      f"set title 'Fault, one event: ways of solving friction'\nset xlabel 'CPU time (s)'; set ylabel '{axis}'")
        one.line("fault_friction.csv", lambda row: row[1] == "rigid" and number(row[column]) > 0, 4, column, "half steps, no spring", 1)
        for n, kt in enumerate(dict.fromkeys(row[2] for row in rows_of("fault_friction.csv", lambda row: row[1] == "spring")), 2):
            where = lambda row, kt=kt: row[1] == "spring" and row[2] == kt and number(row[column]) > 0  # noqa: E731
            one.line("fault_friction.csv", where, 4, column, f"spring kt {kt}", n)
        one.draw()
    waves = Diagram("fault_wave", "set title 'P-wave speed'; set xlabel 'CPU time (s)'; set ylabel 'relative error'; set key noenhanced")
    for n, scene in enumerate(("p_wave_lattice", "p_wave_packing"), 1):
        waves.line("fault_wave.csv", lambda row: row[1] == f"{scene}.in", 3, 5, scene, n)
    waves.draw()
    long = Diagram(
        "fault_long", "set title 'Fault, long runs: number of events against that at the smallest time step'\nunset logscale y; set format y '%g'; "
        "set offsets 0, 0, 0.05, 0.05; set key inside top right; set xrange [8e-6:2e-2]\nset xlabel 'smallest size counted'; "
        "set ylabel 'ratio of the numbers of events'")
    n = 0
    for loose, dt, ranks in (("remove", 0.03, 1), ("remove", 0.06, 1), ("remove", 0.09, 1), ("remove", 0.12, 1), ("remove", 0.15, 1),
                             ("remove", 0.15, 2), ("remove", 0.18, 1), ("keep", 0.06, 1)):

        def of(row):
            return row[1] == loose and number(row[2]) == dt and number(row[3]) == ranks

        if any(number(row[8]) != 1 for row in rows_of("fault_long.csv", of)):
            n += 1
            title = f"dt {dt}" + (f", {ranks} ranks" if ranks > 1 else "") + (", loose discs kept (against 0.03)" if loose == "keep" else "")
            long.add("fault_long.csv", of, f"($4 * 1.{4 * n:02d}):8:(sqrt($10 + $11) * $8 / $5)", f"yerrorlines lt {n} title '{title}'")
    long.draw(", 1 with lines lt 6 notitle")


def variants():
    return list(dict.fromkeys(row[1] for row in rows_of("fault_event.csv")))


# ---- text


def event_orders():
    text = ""
    for variant in variants():
        one = {(method, column): order("fault_event.csv", lambda row: row[1] == variant and row[4] == method, 5, column)
               for method in ("located", "step") for column in (7, 8)}  # yapf: disable
        text += (f"Orders ({variant}): displacement located {one['located', 7]}, step {one['step', 7]}; size located {one['located', 8]}, step "
                 f"{one['step', 8]}.\n\n")
        text += "".join(f"![{name}](fault_event_{name}_{variant}.png)\n" for name in ("profile", "size", "ledger", "arrival")) + "\n"
    return text


def report(mode, seconds):
    """The text, report.txt with {NAME ...} replaced by what the tables say."""
    processor = re.search(r"^model name\s*: (.*)$", Path("/proc/cpuinfo").read_text(), re.M)

    def slider(scheme, column):
        return value("slider_event.csv", lambda row: row[1] == scheme and number(row[2]) == 0.05, column)

    def slider_order(scheme):
        return order("slider_event.csv", lambda row: row[1] == scheme and number(row[2]) <= 0.1, 2, 4)

    def event(method, dt, column):
        return value("fault_event.csv", lambda row: row[1] == "standard" and row[4] == method and number(row[5]) == dt, column)

    def friction(kind, kt, dt, column):
        return value("fault_friction.csv", lambda row: row[1] == kind and number(row[2]) == kt and number(row[3]) == dt, column)

    def friction_order(kind):
        return order("fault_friction.csv", lambda row: row[1] == kind and (kind == "rigid" or number(row[2]) == 1) and number(row[3]) > 0.002, 3, 6)

    names = dict(markdown=markdown, remarks=remarks, slider=slider, slider_order=slider_order, event=event, friction=friction,
                 friction_order=friction_order, event_orders=event_orders, mode=mode, seconds=seconds, cores=os.cpu_count(),
                 processor=processor[1] if processor else "", ruptures=Path("ruptures.txt").read_text().rstrip("\n")
                 if Path("ruptures.txt").exists() else "(not run)", indented=lambda name: re.sub(r"^", "  ", remarks(name), flags=re.M))  # yapf: disable
    text = (SCENES / "report.txt").read_text()
    return re.sub(r"\{\{(.*?)\}\}", lambda found: str(eval(found[1], names)), text)


# ---- runs


def measure(mode, out, slider, friction, postproc, tests, lmp, inputs, mpiexec, parts):

    def done(name, *words, **more):
        print(f"== {name}", flush=True)
        return run(Program(Path(words[0]).name, words[0]), [str(word) for word in words[1:]], timeout=HOURS, **more)

    def shown(name, *words):
        print(done(name, *words).out, end="", flush=True)

    if "slider" in parts:
        shown("block-slider", slider, out, mode)
    print("== lattice solid fault", flush=True)
    fault_accuracy.measure(mode, parts, out, lmp, inputs, friction, postproc, mpiexec)
    if "waves" in parts:
        shown("waves", friction.with_name("lsm_accuracy_waves"), out, mode, lmp, SCENES)
    if "ruptures" in parts:
        work = out / "work/ruptures"
        work.mkdir(parents=True, exist_ok=True)
        spacings = (200, 100, 50) if mode == "full" else (200,)
        said = done("ruptures of a flat fault", "bash", SCENES / "ruptures.sh", lmp, inputs, *spacings, cwd=work, env={"LSM_PYTHON": sys.executable})
        (out / "ruptures.txt").write_text(said.out)
        for name in ("tpv205", "tpv3", "tpv101"):
            for ending in ("png", "svg"):
                shutil.copy(work / f"{name}.{ending}", out)
    if "extremes" in parts:
        env = {} if mode == "quick" else {"LSM_REST_STEPS": "100000000"}
        said = done("extreme cases", tests, "--gtest_filter=Extremes.*:Reproducible.*", env=env)
        cases = re.findall(r"^EXTREME\t(.*)$", said.out, re.M)
        (out / "extremes.tsv").write_text("\n".join(["case\toutcome", *cases]) + "\n")
    # The tables of the study work-precision, if they exist
    study = out.parent / "studies/work-precision"
    for name, copied in (("differences.csv", "csv"), ("work-precision.png", "png"), ("work-precision.svg", "svg")):
        if (study / name).exists():
            shutil.copy(study / name, out / f"fault_catalogues.{copied}")


def main(mode, out, slider, friction, postproc, tests, lmp, inputs, *mpiexec):
    if not shutil.which("gnuplot"):
        sys.exit("accuracy: gnuplot not found (Debian package gnuplot-nox)")
    given = os.environ.get("LSM_ACCURACY_PARTS")
    parts = given.split(",") if given else PARTS
    for name in parts:
        if name not in (*PARTS, "text"):
            sys.exit(f"accuracy: LSM_ACCURACY_PARTS: no part is called '{name}'; there are {','.join(PARTS)},text")
    out, began = Path(out).resolve(), time.monotonic()
    if not given:
        shutil.rmtree(out, ignore_errors=True)
    (out / "work").mkdir(parents=True, exist_ok=True)
    measure(mode, out, *(Path(path).resolve() for path in (slider, friction, postproc, tests, lmp, inputs)), mpiexec, parts)
    os.chdir(out)
    diagrams()
    seconds = int(time.monotonic() - began)
    Path("report.md").write_text(report(mode, seconds))
    if not given:
        shutil.rmtree("work")
    print(f"report: {out}/report.md ({seconds} s)")


if __name__ == "__main__":
    if len(sys.argv) < 10 or sys.argv[1] not in ("full", "quick"):
        sys.exit(__doc__)
    try:
        main(*sys.argv[1:])
    except (AssertionError, OSError, subprocess.SubprocessError, fault_accuracy.Failed) as error:
        sys.exit(f"accuracy: {error}")
