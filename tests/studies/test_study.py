# SPDX-License-Identifier: GPL-2.0-or-later
"""inputs/study.sh honours additions and changes, or refuses them by name; nothing is silently ignored."""
import csv
import fcntl
import json
import os
import re
import shutil
import signal
import sys
import time
from pathlib import Path
from types import SimpleNamespace

import pytest

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from data_files import header  # noqa: E402
from programs import INPUTS, SOURCE, Program, refused, run, start  # noqa: E402

sys.path[:0] = [str(INPUTS / "studies"), str(SOURCE / "python")]
from lsm import LOADING  # noqa: E402
from progress import RunProgress  # noqa: E402
from recipes import RecipeError, found, ratio  # noqa: E402
from study_tables import Study, TableError, read_runs, with_defaults  # noqa: E402

HEAD = "run,program,length,viscosity,seed,steps,settings\n"
FAULT = "f_{seed},fault,24,,1,2000,preset=absorbing width=20 settle=100 velocity=0.02 stress=0.003\n"
BLOCKS = "run,program,blocks,seed,steps,settings\n"
CHAIN = "run,program,blocks,seed,steps,settings\nc_{seed},slider,100,1,1e5,velocity=0.05 warmup=0\n"
RECIPE = """def numbers(run):
    return {"count": f"count {run.catalogue}", "sizes": f"count {run.catalogue} --size 1e-3"}


def table(run, found):
    row = {"events": found.count.catalogues[0].events}
    return row
"""
AVERAGED = """
from recipes import over_seeds, log


def _n(run, found):
    return {"n": found.count.catalogues[0].events}


def _m(run, found):
    return {"m": log(found.count.catalogues[0].events)}


tables = {"differences": lambda study: over_seeds(study, _n, _m)}
"""
# Records of Snakemake, and locks
NOTES = r"\.snakemake|/\.lock|/lock$"


@pytest.fixture
def binaries():
    return Program.built("lmp").path.parent


@pytest.fixture
def study(binaries):
    """study(words): runs the study of the table my.csv in the folder out"""
    if not shutil.which("snakemake"):
        pytest.skip("no snakemake")
    return Program("study.sh", INPUTS / "study.sh", env={"LSM_BIN": str(binaries), "LSM_OUTPUT": "out"},
                   errors=lambda result: [line for line in result.err.splitlines() if line.startswith("study.sh:")])


@pytest.fixture
def plan(work, binaries):
    """plan(table, recipe, **settings): the study of these texts, checked as study.sh does"""

    def planned(table, recipe=None, **config):
        Path("my.csv").write_bytes(table if isinstance(table, bytes) else table.encode())
        if recipe:
            Path("my.py").write_text(recipe)
        found = Study(with_defaults({**config, "table": "my.csv", "bin": str(binaries)}))
        found.check()
        return found

    return planned


def with_columns(**columns):
    """The recipe with further columns."""
    return RECIPE.replace("    return row\n", "".join(f'    row["{name}"] = {one}\n' for name, one in columns.items()) + "    return row\n")


def write(table, recipe=RECIPE):
    Path("my.csv").write_text(table)
    Path("my.py").write_text(recipe)


def table(name="out/table.csv"):
    with open(name) as lines:
        return {row["run"]: row for row in csv.DictReader(lines)}


def counted(name):
    """Events of a catalogue."""
    return str(sum(line[0] not in "#e" for line in open(f"out/{name}")))


def when(pattern="out/*/done.json"):
    return {path: path.stat().st_mtime_ns for path in Path().glob(pattern)}


def test_runs_that_are_added_are_run(study):
    write(HEAD + FAULT)
    run(study, "my.csv")
    assert list(table()) == ["f_1"] and table()["f_1"]["events"] == counted("f_1/fault.catalogue.csv") != "0"
    first = when()
    write(HEAD + FAULT.replace(",1,2000", ",1-2,2000") + FAULT.replace("f_{seed}", "damped").replace("24,,", "24,0.02,"))
    run(study, "my.csv")
    assert list(table()) == ["f_1", "f_2", "damped"]
    assert all(row["events"] == counted(f"{name}/fault.catalogue.csv") for name, row in table().items())
    assert first.items() <= when().items(), "what was done is done again"
    # A run that is removed from the table is not in the results any more, but is kept.
    write(HEAD + FAULT.replace(",1,2000", ",2,2000"))
    run(study, "my.csv")
    assert list(table()) == ["f_2"] and Path("out/f_1/done.json").exists()
    run(study, "my.csv seeds=1 only=f_")
    assert list(table()) == ["f_2"]


def test_a_run_that_is_removed_is_run_again(study):
    write(CHAIN.replace("0,1,1e5", "0,1-2,1e5"))
    assert run(study, "my.csv").err.endswith(f"Results in {Path('out').absolute()}:\n  table.csv\n")
    before, kept = table(), when("out/c_2/done.json")
    shutil.rmtree("out/c_1")
    run(study, "my.csv")
    assert Path("out/c_1/catalogue.csv").exists() and table() == before and when("out/c_2/done.json") == kept
    assert "Nothing to be done" in run(study, "my.csv -n").out


def test_other_settings_are_refused_and_nothing_is_lost(study):
    write(HEAD + FAULT)
    run(study, "my.csv shorten=2")
    assert table()["f_1"]["steps"] == "1000"
    refused(study, "my.csv", r"my.csv:2: .*out/f_1 was begun with other settings \(steps=1000\), expected steps=2000; move it away", but=NOTES)
    Path("out/table.csv").unlink()
    for changed, said in ((FAULT.replace("24,,", "24,0.5,"), r"\(no viscosity\), expected viscosity=0.5"),
                          (FAULT.replace("stress=0.003", "stress=0.004"), r"\(stress=0.003\), expected stress=0.004")):
        write(HEAD + changed)
        refused(study, "my.csv shorten=2", said, but=NOTES)
    assert not Path("out/table.csv").exists()
    # The order of columns and settings does not count.
    write("settings,steps,seed,length,program,run\nstress=0.003 velocity=0.02 settle=100 width=20 preset=absorbing,2000,1,24,fault,f_1\n")
    run(study, "my.csv shorten=2")
    assert table()["f_1"]["steps"] == "1000"
    write(HEAD + FAULT)
    refused(study, "my.csv shorten=2 ranks=2", "out/f_1 was run on 1 ranks, expected 2", but=NOTES)


def test_a_changed_recipe_makes_again_what_it_changes(study):
    write(CHAIN)
    run(study, "my.csv")
    first = when("out/*/numbers/*.json")
    write(CHAIN, with_columns(large="found.sizes.sizes[0].events"))
    run(study, "my.csv")
    assert when("out/*/numbers/*.json") == first and int(table()["c_1"]["large"]) > 0
    write(CHAIN, with_columns(large="found.sizes.sizes[0].events").replace("--size 1e-3", "--size 1e9"))
    run(study, "my.csv")
    count, sizes = Path("out/c_1/numbers/count.json"), Path("out/c_1/numbers/sizes.json")
    assert when("out/*/numbers/*.json")[count] == first[count] and when("out/*/numbers/*.json")[sizes] != first[sizes]
    assert table()["c_1"]["large"] == "0"
    write(CHAIN, RECIPE.replace("found.count", "2 * found.count"))
    run(study, "my.csv")
    assert table()["c_1"]["events"] == str(2 * int(counted("c_1/catalogue.csv")))
    pages = RECIPE + "figures = {'sizes': dict(command='histograms')}\npages = {'report': dict(title='First')}\n"
    write(CHAIN, pages)
    run(study, "my.csv")
    drawn, events = when("out/figures/sizes.png"), int(counted("c_1/catalogue.csv"))
    assert f" {events} " in Path("out/report.html").read_text()
    model = "'Second title', begin=lambda run: 2500 * run.shorten, label=lambda run: run.name + ' of one model'"
    write(CHAIN, pages.replace("'First'", model).replace("histograms", "histograms --guide=-1:1:10"))
    run(study, "my.csv")
    page = Path("out/report.html").read_text()
    later = sum(line[0] not in "#e" and float(line.split(",")[1]) >= 2500 for line in open("out/c_1/catalogue.csv"))
    assert "Second title" in page and re.search(rf"c_1 of one model +{later} ", page) and later < events
    assert when("out/figures/sizes.png") != drawn


def test_scripts_of_results_give_numbers(study):
    """A recipe may use them, and programs of the module lsm, beside commands of postproc."""
    own = '"own": f"match.py {run.catalogue} {run.catalogue} --threshold 1e-3 --within 1", "sizes"'
    columns = with_columns(of="found.own.matches[0].n_first", same="found.own.matches[0].same").replace('"sizes"', own)
    write(CHAIN, columns + "figures = {'scaled': dict(command='lsm.scaling --threshold 0')}\n")
    run(study, "my.csv")
    assert json.loads(Path("out/figures/scaled.json").read_text())["scaling"][0]["points"][0]["n"] == int(counted("c_1/catalogue.csv"))
    assert Path("out/figures/scaled.png").stat().st_size
    assert int(table()["c_1"]["same"]) == int(table()["c_1"]["of"]) > 0


RUPTURE = "run,program,dx,ranks,settings\n{dx}_m,rupture_tpv5,2000 1500,1,length=36000 width=12000 depth=18000 tend=2 surface=mirror\n"


def test_ruptures_of_a_plane(study):
    """The study ruptures with coarse lattices: numbers beside the reference, and a table of all stations."""
    write(RUPTURE, (INPUTS / "studies/ruptures.py").read_text())
    run(study, "my.csv")
    rows = table()
    assert list(rows) == ["2000_m", "1500_m"] and all(row["ruptures"] == counted(f"{name}/rupture.ruptures.csv") for name, row in rows.items())
    with open("out/stations.csv") as lines:
        stations = list(csv.DictReader(lines))
    assert len(stations) == 20 and {row["dx"] for row in stations} == {"2000", "1500"}
    of_one = [row for row in stations if row["run"] == "1500_m"]
    off = sum((float(row["end_slip"]) - float(row["reference_end_slip"]))**2 for row in of_one)
    assert float(rows["1500_m"]["slip"]) == pytest.approx((off / sum(float(row["reference_end_slip"])**2 for row in of_one))**0.5, rel=1e-4)
    done = json.loads(Path("out/1500_m/done.json").read_text())
    assert done["steps"] > 10 and done["ranks"] == 1
    # Nothing is done again, and other settings are refused.
    assert "Nothing to be done" in run(study, "my.csv -n").out
    write(RUPTURE.replace("tend=2", "tend=3"), (INPUTS / "studies/ruptures.py").read_text())
    refused(study, "my.csv", r"out/2000_m was begun with other settings \(tend=2\), expected tend=3", but=NOTES)


def test_a_rupture_that_is_stopped_starts_over(study, binaries):
    folder, words = Path("out/one").absolute(), ["dx=1000", "tend=12"]
    program = Program("run.py", INPUTS / "run.py")
    with start(program, [folder, "rupture_tpv5", 1, 1, binaries, *words]) as child:
        assert child.until(lambda: (folder / "rupture.slip.bin").exists())
        child.send_signal(signal.SIGTERM)
        assert child.wait(60) == 75
    assert not (folder / "done.json").exists()


def test_what_a_command_refuses_is_an_error_and_no_empty_cell(study):
    write(CHAIN, RECIPE.replace("--size 1e-3", "--sizes 1e-3"))
    assert run(study, "my.csv", status=None).status == 1
    assert not Path("out/c_1/numbers/sizes.json").exists() and not Path("out/table.csv").exists()
    write(CHAIN, with_columns(sizes="found.sizes.catalogues[0].evnts"))
    run(study, "my.csv",
        status=1).warned(r"^study_tables.py: .*my.py:7: table: .*nothing is called 'evnts' \(did you mean events\?\), expected one of label, ")
    write(CHAIN, with_columns(sizes="found.sizes.catalogues[1].events"))
    run(study, "my.csv").warned("^table.csv: empty for all runs: sizes; the reasons are in RUN/numbers$")


def test_a_second_start_says_that_one_works_already(study):
    write(CHAIN)
    Path("out").mkdir()
    with open("out/.lock", "a") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        refused(study, "my.csv", "^study.sh: a study works in out already, expected another folder")
    run(study, "my.csv -n")


def test_what_another_user_left_is_named(study, work):
    """For example after a start with sudo, neither runs nor Snakemake could write there."""
    if os.getuid() != 0 or not shutil.which("setpriv"):
        pytest.skip("needs root, to be another user")
    other = Program("study.sh", "setpriv", "--reuid=65534", "--regid=65534", "--clear-groups", *study.command,
                    env={**study.env, "HOME": str(work / "out")}, errors=study.errors)
    if run(Program("setpriv", *other.command[:4], "head"), "-c1", INPUTS / "study.sh", status=None).status:
        pytest.skip("another user cannot read the checkout")
    write(CHAIN)
    run(study, "my.csv")
    work.chmod(0o755)
    refused(other, "my.csv", "^study.sh: cannot write to out$", but=NOTES)
    for path in "out", "out/.lock", "out/.snakemake", "out/.snakemake/log":
        os.chown(path, 65534, 65534)
    refused(other, "my.csv", "^study.sh: cannot write to out/.*, which is of root, expected a folder of one user", but=NOTES)
    for path in Path("out").rglob("*"):
        os.chown(path, 65534, 65534)
    write(CHAIN.replace("0,1,1e5", "0,1-2,1e5"))
    run(other, "my.csv")
    assert list(table()) == ["c_1", "c_2"]


RUN = Program("run.py", sys.executable, INPUTS / "run.py", errors=lambda result: [line for line in result.err.splitlines() if "run.py: " in line])


def test_options_of_two_values(binaries, work):
    run(RUN, ["c", "slider", 1, 1000, binaries, "blocks=16", "steps=1000", "friction-range=0.6 0.7"])
    assert header("c/catalogue.csv")["friction_low"] == "0.6" and header("c/catalogue.csv")["friction_high"] == "0.7"


def test_a_warning_is_not_why_a_program_failed(binaries, work):
    words = ["c", "slider", 1, 1000, binaries, "blocks=64", "scheme=printed", "dt=0.05", "steps=20000", "velocity=0.1"]
    run(RUN, words)
    assert "slider_cli: warning: " in Path("c/output.txt").read_text()
    Path("c/done.json").unlink()
    Path("c/summary.json").unlink()
    Path("c/catalogue.csv").write_text(Path("c/catalogue.csv").read_text().replace("# model = block-slider\n", ""))
    said = run(RUN, words, status=1).err
    assert "no model in the header" in said and "warning" not in said


def test_a_run_that_goes_on_is_not_done(work):
    """The number of steps is what the run says; that of the table may be a default."""
    Path("c").mkdir()
    one = RunProgress(SimpleNamespace(name="c", program="slider", settings={"paper": "yes", "blocks": "1928"}, catalogue="c/catalogue.csv"))
    for said, share in (("step 1300000 of 10000000, 5 events\n", 0.13), ("step 10000000 of 10000000, 5 events\n", 1)):
        Path("c/output.txt").write_text(said)
        assert one.share() == pytest.approx(share, abs=1e-3) and one.share() < 1
    Path("c/done.json").write_text("{}")
    assert one.share() == 1


def test_runs_that_are_stopped_are_reported(study):
    write(CHAIN.replace("0,1,1e5", "0,1-2,1e9"))
    said = run(study, "my.csv hours=0.002", status=1).err
    assert all(f"run.py: {name}: stopped, to be continued" in said for name in ("c_1", "c_2"))
    assert "\n2 of 2 runs are not done, start the study again to go on:\n  c_1\n  c_2\n" in said


def test_folders_with_odd_names(study, binaries):
    """Blanks, characters special to a shell or in format strings, and bytes that are not UTF-8."""
    work = Path("it's \"$HOME\" \\ {c}; *#& \udce9").absolute()
    work.mkdir()
    shutil.copytree(INPUTS, work / "my copy/inputs")
    for folder in "lammps-pkg/cmake", "python":
        shutil.copytree(SOURCE / folder, work / "my copy" / folder)
    (work / "my programs").symlink_to(binaries)
    (work / "a study").mkdir()
    fit = '"fit": f"fit {run.catalogue} --replicas 0 --no-picture -o OUT", "sizes"'
    recipe = with_columns(x="found.fit.fits[0].exponent").replace('"sizes"', fit)
    (work / "a study/my table.py").write_text(recipe + "drawings, pages = ['line'], {'report': dict(title='All of it')}\n")
    (work / "a study/my table.csv").write_text("run,program,length,blocks,seed,steps,settings\n" + FAULT.replace("24,,", "24,,") +
                                               CHAIN.split("\n")[1].replace("slider,", "slider,,").replace("1e5", "1e6") + "\n")
    (work /
     "my copy/inputs/studies/line.gp").write_text("set term pngcairo\nset output 'line.png'\nplot x\nset term svg\nset output 'line.svg'\nplot x\n")
    mine = Program("study.sh", work / "my copy/inputs/study.sh", env={"LSM_BIN": str(work / "my programs"), "LSM_OUTPUT": f"{work}/the out"})
    run(mine, [f"{work.name}/a study/my table.csv"])
    found = table(work / "the out/table.csv")
    assert list(found) == ["f_1", "c_1"] and all(int(row["events"]) > 0 for row in found.values()) and found["c_1"]["x"]
    page = (work / "the out/report.html").read_text()
    assert "Characteristic size against length" in page and "No module" not in page
    assert (work / "the out/line.svg").stat().st_size
    refused(study, "quick", "study.sh: a folder or a table has a line break in its name", env={"LSM_OUTPUT": "one\ntwo"})


def test_ranks_of_the_table_are_honoured_on_fewer_cores(study):
    write(
        HEAD.replace("settings", "settings,ranks") + FAULT.replace("\n", ",2\n") +
        FAULT.replace("f_", "g_").replace("24,,", "150,,").replace("\n", ",\n"))
    run(study, "my.csv --cores 1")
    for name, ranks in (("f_1", "2"), ("g_1", "1")):
        assert f"\n# ranks = {ranks}\n" in Path(f"out/{name}/fault.catalogue.csv").read_text()


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_signal_to_the_study_alone_ends_its_runs(study, number):
    write(CHAIN.replace("1e5", "1e10"))
    with start(study, "my.csv") as child:
        assert child.until(lambda: list(Path("out").glob("*/catalogue.csv")))
        time.sleep(1)
        child.send_signal(number)
        assert child.wait(60) == 1
        assert "run.py: c_1: stopped, to be continued" in child.said()
    with open("out/c_1/lock") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)  # no program works there


def test_a_full_disk_leaves_no_wrong_numbers(study, small_disk):
    write(CHAIN.replace("0,1,1e5", "0,1-2,1e6"))
    run(study, "my.csv")
    whole = table()
    folder = small_disk(1)
    with open(folder / "ballast", "wb") as file:
        file.write(bytes(1 << 20)[:(1 << 20) - 90000])
    there = {"LSM_OUTPUT": str(folder / "out")}
    assert run(study, "my.csv", status=None, env=there).status != 0
    assert not (folder / "out/table.csv").exists()
    (folder / "ballast").unlink()
    small_disk(64)
    run(study, "my.csv", env=there)
    assert table(folder / "out/table.csv") == whole


@pytest.mark.parametrize("text, said", [
    ("run,program,seed,seed\nc,slider,1,2\n", "my.csv:1: column 'seed' twice, expected once"),
    ("run,program,,seed\nc,slider,1,2\n", "my.csv:1: a column without a name, expected one"),
    ("run;program\nc;slider\n", "my.csv:1: no column 'program' in 'run;program', expected one, with commas between columns"),
    ("run,program,seed\nc,slider,3-1\n", "my.csv:2: seed '3-1', expected the smaller one first"),
    ("run,program,seed,settings\nc,slider,1,seed=5\n", "my.csv:2: settings 'seed=5', but there is seed=1 already"),
    ("run,program,settings\nc,slider,ranks=2\n", "my.csv:2: settings 'ranks=2', but ranks is a column"),
    ("run,program,ranks\nc,slider,2\n", "my.csv:2: ranks '2' of program 'slider', expected them for faults only"),
    ("run,program,ranks\nf,fault,0\n", "my.csv:2: ranks '0', expected a whole number above 0"),
    ("run,program,blocks\nc,slider,\"100\n", "my.csv:2: unexpected end of data"),
    ("run,program\n", "my.csv: no run, expected one at least"),
    ("", "my.csv: empty, expected a table of runs"),
    (BLOCKS + "s,slider,100\n", "my.csv:2: 3 cells, expected 6 as in the first line"),
    (BLOCKS + "s,chain,100,1,1e5,\n",
     "my.csv:2: program 'chain', expected fault, slider, esys, rupture_tpv101, rupture_tpv205, rupture_tpv3, rupture_tpv5 or fault_3d"),
    (BLOCKS + "s,slider,100 200,1,1e5,\n", "my.csv:2: there is a run 's' already, expected another name"),
    (BLOCKS + "s_{size},slider,100,1,1e5,\n", "my.csv:2: run 's_{size}', expected a name with columns in braces (not 'size')"),
    (BLOCKS + "a/b,slider,100,1,1e5,\n", "my.csv:2: run 'a/b', expected letters, digits, '.', '_', '+' and '-'"),
    (BLOCKS + "s,slider,100,1,many,\n", "my.csv:2: steps 'many', expected a number above 0"),
    (BLOCKS + "s,slider,100,1,1e5,kl\n", "my.csv:2: settings 'kl', expected NAME=VALUE"),
    ("run,program\n# a\nd\xe9j\xe0,slider\n".encode("latin-1"), "my.csv:3: not UTF-8, expected a table of runs in UTF-8"),
    ("run,program\ntable.csv,slider\n", "my.csv:2: run 'table.csv', expected another name, as results have this one"),
    ("run,program,stepz\nf,fault,100\n", "my.csv:2: 'stepz', which program fault does not have (did you mean steps?)"),
    ("run,program,settings\nf,fault,blocks=100\n", "my.csv:2: 'blocks', which program fault does not have"),
    ("run,program,block\nc,slider,100\n", "my.csv:2: 'block', which program slider does not have (did you mean blocks?)"),
    ("run,program,settings\na,rupture_tpv5,blocks=packing\n", "my.csv:2: 'blocks', which program rupture_tpv5 does not have"),
    *((f"run,program,{name}\nf,{program},100\n", f"my.csv:2: '{name}' is set by the study, expected no such column or setting")
      for program, name in (("fault", "prefix"), ("fault", "checkpoint"), ("slider", "resume"), ("rupture_tpv5", "prefix"))),
])
def test_tables_that_say_what_is_wrong(plan, text, said):
    with pytest.raises(TableError) as error:
        plan(text)
    assert str(error.value) == said


def read(text, **config):
    Path("t.csv").write_text(text)
    return read_runs("t.csv", config)


def test_runs_of_a_table():
    found = read(BLOCKS + "# comment\ns_{blocks}_{seed},slider,100 200,1-3,1e5,paper=yes\n", seeds="2", shorten="10")
    assert list(found) == ["s_100_1", "s_100_2", "s_200_1", "s_200_2"]
    assert found["s_200_2"].words == ["blocks=200", "seed=2", "steps=10000", "paper=yes"]
    found = read("program,length,ranks\nfault,40 240 1890,\nfault,50,3\n", only="length-[245]")
    assert {name: one.ranks for name, one in found.items()} == {"fault_length-40": 1, "fault_length-240": 4, "fault_length-50": 3}
    # Numbers keep their digits.
    assert "time=1234567.5" in read("run,program,time\nf,slider,1234567.5\n")["f"].words
    # Values of several words are quoted; a run without a name is named after them, without blanks.
    words = "leap=yes 'leaping=slip 1.5 grow 60'"
    found = read(f"run,program,law,settings\nl,fault,coulomb,{words}\n,fault,'coulomb 0.6 0.7' 'velocity-weakening mu 0.6',{words}\n")
    assert list(found) == [
        "l", "fault_law-coulomb-0.6-0.7_leap-yes_leaping-slip-1.5-grow-60", "fault_law-velocity-weakening-mu-0.6_leap-yes_leaping-slip-1.5-grow-60"
    ]
    assert found["l"].words == ["law=coulomb", "leap=yes", "leaping=slip 1.5 grow 60"]
    assert list(found.values())[2].words[0] == "law=velocity-weakening mu 0.6"


def test_tables_that_are_right(plan, work):
    assert plan("run,program,pe-series\nc,slider,{here}/pe.bin\n").runs["c"].words == [f"pe-series={work}/pe.bin"]
    assert list(plan("\ufeffrun,program\nlock,slider\n").runs) == ["lock"], "a mark of the byte order"
    assert list(plan("run,program\r\nc,slider\r\n,\r\n").runs) == ["c"], "line ends of Windows, and an empty line of a spreadsheet"
    assert list(plan("run,program,seed\nc_{seed},slider,4-6\n", seeds=2).runs) == ["c_4", "c_5"]
    # Columns of other programs may be empty.
    assert list(plan("program,run,length,blocks\nfault,f,24,\nslider,c,,100\n").runs) == ["f", "c"]
    plan("run,program,dx,settings\na,rupture_tpv3,1500,blocks=packing seed=2\n")


def test_a_run_that_failed_is_no_result(study, work):
    """Its cells are empty, curves and pages leave it out, and it is named at each start; the study has not succeeded."""
    recipe = RECIPE + AVERAGED.replace("over_seeds, log", "joined, over_seeds, log") + """
tables["all"] = lambda study: joined(study, lambda found: found.sizes.sizes)
figures, pages = {"sizes": dict(command="histograms")}, {"report": dict(title="All")}
"""
    write(CHAIN.replace("0,1,1e5", "0,1-3,1e5"), recipe)
    run(study, "my.csv")
    Path("out/c_2/done.json").write_text(json.dumps({"failed": "a link is strained by 0.78"}))
    for _ in range(2):
        said = run(study, "my.csv", status=1).err
        assert said.count("study.sh: 1 of 3 runs failed") == 2 and said.count(
            "c_2: a link is strained by 0.78") == 2 and "2 of 3 runs done, 1 failed" in said
        rows = table()
        assert rows["c_2"] == {key: "" for key in rows["c_2"]} | {"run": "c_2", "blocks": "100", "seed": "2", "settings": rows["c_1"]["settings"]}
        assert rows["c_1"]["events"] == counted("c_1/catalogue.csv") and rows["c_1"]["steps"] == "100000"
        with open("out/all.csv") as lines:
            assert {row["run"] for row in csv.DictReader(lines)} == {"c_1", "c_3"}
        with open("out/differences.csv") as lines:
            assert [row["seeds"] for row in csv.DictReader(lines)] == ["2"]
        for made in "out/report.html", "out/figures/sizes.csv":
            assert "c 1" in (text := Path(made).read_text()) and "c 2" not in text, made
    run(study, "my.csv -n").warned("1 of 3 runs failed")
    # Once its folder is moved away it is run again, and everything is as it should be.
    shutil.move("out/c_2", "failed")
    run(study, "my.csv")
    assert table()["c_2"]["events"] == counted("c_2/catalogue.csv")


@pytest.mark.parametrize("settings, said", [
    ("stress=-0.02", "Variable stress is '-0.02', but must be a number of at least 0"),
    ("faces=smooth", "Variable faces is 'smooth', but must be random or none"),
    ("'law=coulom 0.6 0.6'", "with one of the laws coulomb, .*, got 'coulom'"),
    ("leap=yes retardation=0.1", "leap.*retardation"),
])
def test_values_that_no_fault_may_have_are_refused_before_anything_runs(study, settings, said):
    write(HEAD + FAULT + f"g,fault,24,,1,2000,{settings}\n")
    Path("out").mkdir()
    refused(study, "my.csv -n", f"^study.sh: .*my.csv:3: run 'g': .*{said}", but=NOTES)


def test_each_of_many_settings_is_asked(plan):
    head = "run,program,stress,preset,law\nf_{stress}_{preset},fault,0.01 0.02 0.03 0.04 0.05 0.06,leaky absorbing,\n"
    plan(head + "g,fault,0.02,,'slip-weakening mu 0.6 mu_static 0.71 dc 0.2 heal 5'\n").check_values()
    with pytest.raises(TableError, match="my.csv:2: run 'f_-1_absorbing': Variable stress is '-1', but must be a number of at least 0"):
        plan(head.replace("0.05 0.06,leaky absorbing", "-1 0.06,absorbing leaky")).check_values()


def test_what_would_be_submitted_is_said(study):
    write(HEAD.replace("settings", "settings,ranks") + FAULT.replace("\n", ",4\n"))
    said = run(study, "my.csv hours=2 -n --profile", INPUTS / "slurm").err
    assert re.search("^  f_1: .*sbatch .* --ntasks=4 --time=120 .*--job-name=f_1 ", said, re.M)


def test_means_have_errors(study):
    write(CHAIN.replace("0,1,1e5", "0,1-2,1e5"), RECIPE + AVERAGED)
    run(study, "my.csv")
    a, b = (int(row["events"]) for row in table().values())
    with open("out/differences.csv") as lines:
        row, = csv.DictReader(lines)
    assert float(row["n"]) == (a + b) / 2 and float(row["n_error"]) == pytest.approx(abs(a - b) / 2, rel=1e-5) and row["m"] == row["m_error"] == "0"


def test_a_number_that_is_missing_has_no_value():
    some = found({"events": 3, "label": None, "times": [{"mean": 2}], "fit": {"why": "5 events, at least 10 needed"}})
    with pytest.raises(AttributeError, match=r"nothing is called 'evnts' \(did you mean events\?\), expected one of events, label"):
        some.evnts
    assert some.fit.exponent[0].error != some.fit.exponent and some.times[0].mean == 2
    for one in (some.label, some.times[1].mean, some.fit.get("leaps", 0) or some.label, 1 - some.label, ratio(3, 0), ratio(3, some.label)):
        assert not one == one, "a value of what is missing"
    assert list(some.times[1].rates) == []


def test_first_loading_is_left_out(plan):
    """Without a recipe tables and page begin when a fault is loaded, which lasts the longer the slower the plates are; a run that ends before is whole."""
    found = plan("run,program,velocity,steps\na,fault,,\nfast,fault,1e-3,\nshort,fault,,2000\nc,slider,,\n")
    for name, begin in ("a", LOADING), ("fast", 1200 + (LOADING - 1200) / 4), ("short", 0), ("c", 0):
        for number in "count", "fit", "times":
            words = found.runs[name].commands[number].split()
            assert [word for option, word in zip(words, words[1:]) if option == "--from"] == [f"{begin:.15g}"] * (begin > 0), (name, number, words)
        assert found.pages["report"]["begin"](found.runs[name]) == begin
    assert found.curves(found.pages["report"])["labels"][4:] == [f"--from={begin:.15g}" for begin in (LOADING, 2900, 0, 0)]
    assert [row["from_time"] for row in found.table("table")] == ["8000", "2900", 0, 0]


@pytest.mark.parametrize("config, said", [
    ({"shortn": 100}, "'shortn=100', expected one of hours, ranks, seeds, shorten, only, checkpoint, minutes"),
    ({"foo": 1}, "'foo=1', expected one of"),
    ({"seeds": 0}, "'seeds=0', expected a whole number above 0"),
    ({"ranks": "two"}, "'ranks=two', expected a whole number above 0"),
    ({"checkpoint": None}, "'checkpoint=', expected a whole number"),
    ({"hours": "x"}, "'hours=x', expected a number above 0"),
    ({"shorten": -1}, "'shorten=-1', expected a number above 0"),
    ({"only": "("}, "only '(', expected a regular expression"),
    ({"only": "z"}, "my.csv: no run whose name matches 'z'"),
    ({"shorten": 10}, "my.csv:2: shorten=10, but the line has neither steps nor time"),
])
def test_settings_of_a_study_that_say_what_is_wrong(plan, config, said):
    with pytest.raises(TableError) as error:
        plan("run,program,blocks\nc,slider,100\n", **config)
    assert str(error.value).startswith(said)


@pytest.mark.parametrize("recipe, said", [
    ("def numbres(run):\n    return {}\n", "my.py:1: 'numbres' (did you mean numbers?), expected one of"),
    ("a = 1\n1 +\n", "my.py:2: the recipe: invalid syntax"),
    ("def table(run, found):\n    return {'x':\n            found.count}\n",
     "my.py:3: table: AttributeError: nothing is called 'count', expected one of"),
    ("def numbers(run):\n    return {'a': run.catalog}\n", "my.py:2: numbers: AttributeError: 'Run' object has no attribute 'catalog'"),
    ("def numbers(run):\n    return {'a': run['dt']}\n", "my.py:2: numbers: KeyError: 'dt'"),
    ("figures = {'a': dict(runs='(', command='fit')}\n", "my.py: figures: a: runs '(', expected a regular expression"),
    ("figures = {'a': dict(runs='c')}\n", "my.py: figures: a: expected a command"),
    ("pages = {'a': dict(title='A', begin=lambda run: 1 / 0)}\n", "my.py:1: begin: ZeroDivisionError"),
    ("reference = '{block}'\n", "reference '{block}', expected the name of a run with columns in braces (not 'block')"),
])
def test_recipes_that_say_what_is_wrong(plan, recipe, said):
    with pytest.raises(RecipeError) as error:
        plan("run,program,blocks\nc,slider,100\n", recipe)
    assert str(error.value).startswith(said)
