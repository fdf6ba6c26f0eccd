# SPDX-License-Identifier: GPL-2.0-or-later
"""inputs/study.sh with small scenes: killed and resumed, with Slurm, with damaged or foreign files."""
import csv
import fcntl
import json
import os
import random
import re
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from data_files import edit, header, read_series, rows, same, same_bytes, table
from programs import INPUTS, Program, refused, run, start
from slurm import Slurm, said

sys.path.insert(0, str(INPUTS / "studies"))
from study_tables import Study, with_defaults  # noqa: E402

RUNS = """run,program,length,blocks,steps,ranks,settings
one,fault,40,,150000,1,preset=absorbing width=20 settle=500 velocity=0.01 thermo=1000
two,fault,40,,200000,2,preset=absorbing width=20 settle=500 velocity=0.01 thermo=1000
short,fault,40,,6000,1,preset=absorbing width=20 settle=500 velocity=0.01
chain,slider,,100,20000000,,velocity=0.05 dt=0.05 warmup=0 checkpoint-interval=50000 pe-series=series.bin pe-stride=100
"""
FAULT = "fault preset=absorbing length=40 width=20 settle=500 velocity=0.01 location=yes "
CHAIN = "slider blocks=100 velocity=0.05 dt=0.05 warmup=0 "


class Studies:
    """study.sh and run.py with the programs that were built."""

    def __init__(self, binaries, folder):
        self.binaries, self.folder, self.postproc = binaries, folder, Program("postproc", binaries / "postproc")

    def study(self, output):
        return Program("study.sh", INPUTS / "study.sh", env={"LSM_BIN": str(self.binaries), "LSM_OUTPUT": str(self.folder / output)})

    def __call__(self, output, *words, table="runs.csv", **more):
        """Runs the study of a table in a folder."""
        result = run(self.study(output), table, *words, **more)
        result.out += result.err
        return result

    @staticmethod
    def run_py():
        """The program that does a single run, without Snakemake."""
        return Program("run.py", INPUTS / "run.py")

    def words(self, folder, text, checkpoint=1500):
        kind, *settings = text.split()
        return [folder, kind, 1, checkpoint, self.binaries, *settings]

    def run(self, folder, text, checkpoint=1500, **more):
        return run(self.run_py(), self.words(folder, text, checkpoint), **more)

    def refused(self, folder, text, pattern):
        """Expects a refusal with all files unchanged, except those with messages of the program."""
        return refused(self.run_py(), self.words(folder, text), pattern, folder, but=r"output\.txt$|lock$|cpu\.txt$|/\.snakemake/")


def programs_in(folder):
    """Processes whose working directory is the given folder or below, including Snakemake itself."""
    found, folder = [], str(Path(folder).absolute())
    for entry in Path("/proc").glob("[0-9]*"):
        try:
            at = os.readlink(entry / "cwd")
        except OSError:
            continue
        if (at == folder or at.startswith(folder + "/")) and int(entry.name) != os.getpid():
            found.append(int(entry.name))
    return found


def send(number, *programs):
    for program in programs:
        try:
            os.kill(program, number)
        except ProcessLookupError:
            pass


def wait(condition, seconds, pause=0.05):
    limit = time.monotonic() + seconds
    while not condition() and time.monotonic() < limit:
        time.sleep(pause)
    return condition()


@pytest.fixture
def studies(lmp, slider, postproc, work):
    if not shutil.which("snakemake"):
        pytest.skip("no snakemake")
    Path("runs.csv").write_text(RUNS)
    yield Studies(slider.path.parent, work)
    send(signal.SIGKILL, *programs_in(work))


def killed(studies, name, touched):
    """One run of the study is killed at random moments, in four ways, until it has continued from a
    checkpoint four times; then it runs to its end. touched: a file that exists once there is a checkpoint."""
    began = time.monotonic()
    studies("whole", "checkpoint=4000", f"{name}/done.json")
    whole = time.monotonic() - began
    part, moments, resumed = Path("part", name), random.Random(7), 0
    for n in range(12):
        if resumed >= 4:
            break
        begun = any(part.glob(touched))
        with start(studies.study("part"), f"runs.csv checkpoint=4000 minutes=9 {name}/done.json") as child:
            # Most of these moments are after the program has started, some before.
            if n % 5 != 4:
                wait(lambda: programs_in(part), 20)
            time.sleep(whole * moments.uniform(0.03, 0.27))
            if child.poll() is not None:
                assert child.returncode == 0, f"ended on its own: {child.said()}"
                break
            if n % 4 == 0:  # Snakemake: its programs end, too
                child.kill()
            elif n % 4 == 1:  # the programs
                send(signal.SIGKILL, *programs_in(part))
            elif n % 4 == 2:  # all in one moment
                child.send_signal(signal.SIGSTOP)
                send(signal.SIGKILL, child.pid, *programs_in("part"))
            else:
                send(signal.SIGTERM, child.pid, *programs_in(part))
            if child.wait(120) == 0:
                break
        # Programs may live a little longer; sometimes the next round starts while they do.
        if n % 3 != 2:
            wait(lambda: not programs_in(part), 5)
        resumed += begun
    assert resumed >= 2, f"gone on only {resumed} times"
    studies("part", "checkpoint=4000", f"{name}/done.json")


def test_kill_slider(studies):
    killed(studies, "chain", "checkpoint.bin")
    same("whole/chain/catalogue.csv", "part/chain/catalogue.csv", 100)
    same_bytes("whole/chain/series.bin", "part/chain/series.bin")


def test_kill_fault(studies):
    # On two ranks; test_stop goes on from a restart file on one.
    killed(studies, "two", "fault.restart.*.info")
    same("whole/two/fault.catalogue.csv", "part/two/fault.catalogue.csv", 15)
    same_bytes("whole/two/fault.pe.bin", "part/two/fault.pe.bin")


def test_stop(studies, work, monkeypatch):
    """On SIGTERM the run ends with its next restart file, and reports that it is to be continued."""
    long, temporary = FAULT + "steps=60000", work / "temporary"
    temporary.mkdir()
    monkeypatch.setenv("TMPDIR", str(temporary))
    studies.run("whole", long, 3000)
    with start(studies.run_py(), studies.words("part", long, 3000)) as child:
        assert child.until(lambda: any(Path("part").glob("fault.restart.*.info")))
        child.terminate()
        assert child.wait(60) == 75, "not stopped, or not as if to go on"
    assert len(rows("part/fault.catalogue.csv")) < len(rows("whole/fault.catalogue.csv")), "ran to its end"
    at = max(int(path.name.split(".")[2]) for path in Path("part").glob("fault.restart.*.info"))
    assert any(line.split()[:1] == [str(at)] for line in Path("part/output.txt").read_text().splitlines()), \
        f"restart file {at} is not that of the last step"
    studies.run("part", long, 3000)
    same("whole/fault.catalogue.csv", "part/fault.catalogue.csv", 15)
    same_bytes("whole/fault.pe.bin", "part/fault.pe.bin")
    # The same happens at a given time, after which nothing is started.
    for seconds in 4, 20, 100:  # a busy machine takes longer to begin
        studies.run("timed", FAULT + "steps=6000000", 3000, status=75, env={"LSM_UNTIL": str(int(time.time()) + seconds)})
        if Path("timed/fault.catalogue.csv").exists():
            break
    assert Path("timed/fault.catalogue.csv").exists()
    studies.run("late", long, 3000, status=75, env={"LSM_UNTIL": "1"})
    assert not Path("late/output.txt").exists(), "begun after its time"
    # Started once more, there is nothing left to do, and the run's folder for sessions of Open MPI is gone.
    studies.run("part", long, 3000)
    assert not list(temporary.iterdir()), "a session folder is left"


def test_refuse_slider(studies):
    settings = CHAIN + "steps=300000"
    studies.run("a", settings)
    studies.refused("a", CHAIN + "steps=400000", r"begun with other settings \(.*\), expected .*steps=400000")
    Path("a/done.json").unlink()
    Path("a/summary.json").unlink()
    whole = Path("a/checkpoint.bin").read_bytes()
    Path("a/checkpoint.bin").write_bytes(whole[:1000])
    studies.refused("a", settings, "damaged checkpoint")
    Path("a/checkpoint.bin").write_bytes(whole)
    Path("a/catalogue.csv").unlink()
    studies.refused("a", settings, "catalogue.csv is missing, but there is a checkpoint")


def test_refuse_fault(studies):
    settings = FAULT + "steps=6000"
    studies.run("f", settings)
    for path in [Path("f/done.json"), *Path("f").glob("fault.restart.end*")]:
        path.unlink()
    shutil.copytree("f", "whole")
    newest = Path("f/fault.restart.6500")
    damaged = bytearray(newest.read_bytes())
    damaged[200000] ^= 0x78
    newest.write_bytes(damaged)
    studies.refused("f", settings, newest.name)
    # Without it the run continues from the previous one.
    newest.unlink()
    Path("f/fault.restart.6500.info").unlink()
    studies.run("f", settings)
    same("f/fault.catalogue.csv", "whole/fault.catalogue.csv", 5)
    # Two runs cannot be in one folder at a time.
    Path("f/done.json").unlink()
    with open("f/lock", "a") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        with pytest.raises(subprocess.TimeoutExpired):  # it waits for a minute, then gives up
            studies.run("f", settings, timeout=5)
    assert not Path("f/done.json").exists(), "two runs in one folder"


def test_disk_full(studies, small_disk):
    settings = FAULT + "steps=30000"
    small_disk(1)
    studies.run("whole", settings)
    full = studies.run("small/part", settings, status=1)
    full.warned("no space left on the disk|No space left")
    small_disk(64)
    studies.run("small/part", settings)
    same("small/part/fault.catalogue.csv", "whole/fault.catalogue.csv", 15)


def test_own_study(studies):
    assert studies("one", "-n", table="none.csv", status=None).status != 0, "a table that is not there"
    # A user's own study, without a recipe
    Path("own.csv").write_text("run,program,blocks,seed,steps,settings\nc_{seed},slider,100,1-2,3e6,velocity=0.05 warmup=0\n")
    studies("own", table="own.csv")
    numbers = table("own/table.csv")
    assert len(numbers) == 2 and os.path.getsize("own/report.html") > 0
    for row in numbers:
        run(studies.postproc, f"fit own/{row['run']}/catalogue.csv --range 1e-4:0.1 --replicas 0 --no-picture --json fit.json")
        assert float(row["exponent"]) == pytest.approx(json.loads(Path("fit.json").read_text())["fits"][0]["exponent"], rel=1e-5)
        assert int(row["events"]) == len(rows(f"own/{row['run']}/catalogue.csv"))
        assert (float(row["from_size"]), float(row["to_size"])) == (1e-4, 0.1), row
    studies("own", "-n", table="own.csv").printed("Nothing to be done")


def test_settings_of_several_words(studies):
    """They reach the program, also when the run is continued."""
    law = "slip-weakening mu 0.5 mu_static 0.6 dc 0.002 heal 5"
    Path("laws.csv").write_text("run,program,length,steps,velocity,law,settings\n"
                                f"l,fault,40,3000,1e-3,'{law}',preset=absorbing width=20 settle=500 leap=yes fast=0.01 'leaping=slip 1.5 grow 60'\n")
    studies("laws", "checkpoint=1000 l/done.json", table="laws.csv")
    head = header("laws/l/fault.catalogue.csv")
    assert head["law"] == law and head["leap"].startswith("fast 0.01 slip 1.5 ") and " grow 60 " in head["leap"], head
    whole = Path("laws/l/fault.catalogue.csv").read_bytes()
    for path in Path("laws/l").glob("*"):
        if path.name.startswith(("done.json", "fault.restart.end", "fault.restart.3500")):
            path.unlink()
    studies("laws", "checkpoint=1000 l/done.json", table="laws.csv")
    assert Path("laws/l/fault.catalogue.csv").read_bytes() == whole, "another catalogue after going on"


def test_plans(studies):
    """Every study that ships has settings that its programs know and may have, and a recipe that is one."""
    shipped = sorted(path.stem for path in (INPUTS / "studies").glob("*.csv"))
    assert len(shipped) > 10
    for name in shipped:
        one = Study(with_defaults({"table": str(INPUTS / f"studies/{name}.csv"), "bin": str(studies.binaries)}))
        one.check()
        one.check_values()
    # With figures and pages, stacks, and differences and drawings
    for name in "quick", "ruptures", "work-precision":
        studies(f"plan_{name}", "-n --quiet", table=name)


def test_recipes(studies, gnuplot, work):
    """Recipes use only commands and numbers that postproc has."""
    studies("quick", ["shorten=2", "ranks=1", "only=fault_120|_256"], table="quick")
    for file in ("figures/fig12_fault_sizes.png", "figures/fig13_slider_sizes.svg", "figures/fault_fit.json", "figures/fault_scaling.png",
                 "report.html", "table.csv", "costs.csv"):
        assert os.path.getsize(f"quick/{file}") > 0, file
    assert not Path("quick/figures/fig7_leaf_springs.png").exists(), "a figure of nothing"
    # If ESyS-Particle is missing, it is named before anything is started.
    Path("programs").mkdir()
    for path in Path("/usr/bin").iterdir():
        if path.name != "esysparticle":
            Path("programs", path.name).symlink_to(path)
    studies("whole_job", table="whole-job", env={"PATH": str(work / "programs")},
            status=1).printed(r"run ESyS-Particle needs ESyS-Particle, no program esysparticle was found \(Debian package esys-particle\)")
    assert not Path("whole_job/ours_0.06").exists(), "begun without ESyS-Particle"


ENERGY = """read_restart whole_job/ESyS-Particle/fault.restart.end
comm_modify mode single cutoff 3.6
bond_style lsm/linked
bond_coeff 1 1.0
pair_style lsm/friction coulomb 0.6 0.6
pair_coeff * * off
pair_coeff 1*4 1*6 1.0 0.07
compute contacts all pair/local p1
compute squares all reduce sumsq c_contacts inputs local
thermo_style custom step pe c_squares
thermo_modify norm no
run 0
print "whole = $(pe:%.9g)"
print "tangential = $(0.5*0.07*c_squares:%.9g)"
"""


def test_esys(studies):
    if not shutil.which("esysparticle"):
        pytest.skip("no ESyS-Particle (Debian package esys-particle)")
    # With soft contacts: ESyS-Particle begins without their tangential springs, the forces of which the links have to bear at once.
    shutil.copy(INPUTS / "studies/whole-job.py", "soft.py")
    edit(INPUTS / "studies/whole-job.csv", "soft.csv", ("hold=position", "hold=position kt=0.07"))
    studies("whole_job", "shorten=4000", table="soft.csv")
    costs = {row["run"]: row for row in csv.DictReader(open("whole_job/costs.csv"))}
    assert list(costs) == ["ESyS-Particle", "ours_0.06", "ours_0.12"] and costs["ESyS-Particle"]["steps"] == "115", costs
    assert all(float(row["time_per_core_hour"]) > 0 for row in costs.values()), costs
    # The scene is the same: its PE at the beginning of shear is that of ours without the tangential springs of
    # contacts, which are unstrained there.
    _, steps, _, pe = read_series("whole_job/ESyS-Particle/fault.pe.bin")
    assert len(steps) == 114 and steps[0] == 20000
    ours = [line.split() for line in open("whole_job/ours_0.06/output.txt") if line.split()[:1] == ["20000"]][-1]
    Path("energy.in").write_text(ENERGY)
    said = run(Program("lmp", studies.binaries / "lmp"), "-in energy.in -log none")
    whole, tangential = (float(re.search(f"^{name} = (.*)", said.out, re.M)[1]) for name in ("whole", "tangential"))
    assert whole == pytest.approx(float(ours[3]), rel=1e-5) and tangential > 0
    assert pe[0] == pytest.approx(whole - tangential, rel=0.005)
    studies.run("odd", "esys length=40 massstep=0 dt=0.06 steps=10", status=1).warned("hold 'stress', ESyS-Particle has 'position'")


def test_slurm(studies, work):
    Path("runs.csv").write_text("run,program,length,blocks,seed,steps,settings\n"
                                "fault_{seed},fault,40,,1-2,150000,preset=absorbing width=20 settle=500 velocity=0.01\n"
                                "chain,slider,,100,1,20000000,velocity=0.05 warmup=0\n")

    def queued(state, job=None):
        names = said("squeue", "-h", "-t", state, "-o", "%i %j").splitlines()
        return [line.split()[0] for line in names if (job or "fault" in line or "chain" in line) and (not job or line.endswith(" " + job))]

    with Slurm(work / "slurm"):
        studies("here", "checkpoint=5000 ranks=1")
        # At first the node is occupied by another job.
        other = said("sbatch", "--parsable", "--exclusive", "--output=/dev/null", "--wrap", "sleep 100")
        assert other, "sbatch"
        with start(studies.study("there"), f"runs.csv checkpoint=5000 ranks=1 --profile {INPUTS}/slurm") as child:
            assert wait(lambda: len(queued("PD")) == 3, 30), "three jobs do not wait"
            said("scancel", other)

            def begun(*faults):
                """The first of the named faults that has a restart file."""
                found = []
                wait(lambda: found.extend(name for name in faults if any(Path("there", name).glob("fault.restart.*.info"))) or found, 60, 0.1)
                assert found, f"no restart file of {faults}: {child.said()}"
                return found[0]

            # The fault that Slurm starts first is cancelled by hand, and the other one is signalled to end as
            # before its time limit.
            first = begun("fault_1", "fault_2")
            job = queued("R", first)
            assert job, f"{first} has ended before it was cancelled"
            said("scancel", job[0])
            second = begun("fault_2" if first == "fault_1" else "fault_1")
            job = queued("R", second)
            assert job, f"{second} has ended before it was told to"
            said("scancel", "--signal=TERM", "--batch", job[0])
            assert wait(lambda: said("squeue", "-h", "-j", job[0], "-o", "%T") == "PENDING", 30, 0.1), "not queued again"
            assert not Path(f"there/{second}/done.json").exists(), "told to end, but ended by itself"
            said("scontrol", "update", f"JobId={job[0]}", "StartTime=now")  # Slurm waits for two minutes otherwise
            assert child.wait(200) == 0, child.said()
            assert "Trying to restart job" in child.said(), "the cancelled job was not queued again"
    for name in "fault_1", "fault_2":
        same(f"here/{name}/fault.catalogue.csv", f"there/{name}/fault.catalogue.csv", 15)
    same("here/chain/catalogue.csv", "there/chain/catalogue.csv", 100)
    same("here/table.csv", "there/table.csv", 3)
