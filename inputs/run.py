#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Starts one run of a study, or continues it where it was stopped.

run.py FOLDER fault|slider|esys|rupture_SCENE RANKS CHECKPOINT BIN NAME=VALUE...

FOLDER has settings.txt (the settings of the run; others need another folder), output.txt (the output of the
program), the files of the program, and done.json once the run is done. SIGTERM, or the time LSM_UNTIL (seconds
since 1970), ends the run at its next restart file or checkpoint. SIGINT, SIGHUP or the end of the caller ends it
at once, and the steps since the last restart file are repeated. Neither loses an event. A fault by ESyS-Particle
(esys) starts over, and so does a rupture (rupture_tpv5: the scene rupture_tpv5.in), which takes minutes. Exit
status: 0 done, 75 stopped, to be continued, 1 failed.

"""
import ctypes
import fcntl
import gzip
import json
import lzma
import os
import re
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from variables import declared

STOPPED, LOCKED = 75, ("flock", "-n", "-s", "-F", "lock")
INPUTS = Path(__file__).resolve().parent
EXPORTS = re.findall(r"^export (.*)$", (INPUTS / "mpi-settings.sh").read_text(), re.M)
MPI = dict(word.split("=", 1) for line in EXPORTS for word in line.split())


class Failed(Exception):
    pass


def die_with_parent(number=signal.SIGHUP):
    ctypes.CDLL(None).prctl(1, int(number))  # PR_SET_PDEATHSIG


def replace_all(texts):
    """Replaces all files, {path: text or bytes}, or none. A link in the place of a temporary file is not followed."""
    written = []
    try:
        for path, text in texts.items():
            new = path.with_name(path.name + ".new")
            descriptor = os.open(new, os.O_WRONLY | os.O_CREAT | os.O_TRUNC | os.O_NOFOLLOW, 0o666)
            written.append((new, path))
            with open(descriptor, "wb") as file:
                file.write(os.fsencode(text) if isinstance(text, str) else text)
        for new, path in written:
            new.replace(path)
    except BaseException:
        for new, _ in written:
            new.unlink(missing_ok=True)
        raise


def replace(path, text):
    replace_all({path: text})


def alone_in(folder):
    """Locks the folder. The ranks of a killed run, which may live a little longer, hold the lock as well."""
    lock = open(folder / "lock", "a")
    for _ in range(600):
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
            fcntl.flock(lock, fcntl.LOCK_SH)
            return lock
        except BlockingIOError:
            time.sleep(0.1)
    raise Failed(f"{folder}: another run works in it")


def events_in(catalogue):
    with {".xz": lzma.open, ".gz": gzip.open}.get(catalogue.resolve().suffix, open)(catalogue, "rt") as lines:
        return sum(line[0] not in "#e" and line.endswith("\n") for line in lines)


class Job:
    """One run of a program in a folder. OWN: settings that are made here; known(binaries): those that the program has."""
    catalogue, on_ranks = "catalogue.csv", False

    def __init__(self, folder, ranks, checkpoint, binaries, settings):
        self.folder, self.ranks, self.checkpoint, self.binaries, self.settings = folder, ranks, checkpoint, binaries, settings

    def lmp(self, scene, log, *pairs):
        """A scene on so many ranks; the file `lock` stays locked as long as they run."""
        variables = [word for pair in (*pairs, *self.settings) for word in ("-var", *pair.split("=", 1))]
        return ["mpirun", "-np", self.ranks, *LOCKED, f"{self.binaries}/lmp", "-in", f"{INPUTS}/{scene}.in", "-log", log, *variables]

    def stop(self, child):
        child.terminate()

    def told(self):
        path = self.folder / "summary.json"
        return json.loads(path.read_text()) if path.exists() else {}

    def steps(self):
        """Number of steps, or None unless all are done."""
        return None if self.told().get("interrupted") else self.told().get("steps")


class Fault(Job):
    catalogue, on_ranks = "fault.catalogue.csv", True
    OWN = {"prefix", "restart", "overwrite", "checkpoint"}

    @staticmethod
    def known(_):
        """Variables that fault.variables declares, and those of scenes for `extra`."""
        of_extras = (re.findall(r"^variable\s+(\w+)\s+index\b", path.read_text(), re.M) for path in INPUTS.glob("fault_*.in"))
        return {one.name for one in declared()}.union(*of_extras)

    def command(self):
        # The newest complete restart file; lmp checks that it is intact and of the same run.
        steps = [int(info.name.split(".")[2]) for info in self.folder.glob("fault.restart.*.info") if info.name.split(".")[2].isdigit()]
        begin = f"restart=fault.restart.{max(steps)}" if steps else "overwrite=yes"
        return self.lmp("fault", "none", begin, "prefix=fault", f"checkpoint={self.checkpoint}")

    def stop(self, _):
        # fault.in looks for this file after each restart file.
        (self.folder / "fault.stop").touch()

    def steps(self):
        info = self.folder / "fault.restart.end.info"
        if not info.exists():
            return None
        told = dict(line.split(" = ", 1) for line in info.read_text().splitlines() if " = " in line)
        return int(told["step"]) - int(told["settle"])


class Rupture(Job):
    """A scene of ruptures, rupture_*.in or fault_3d.in; its slip history is rupture.slip.bin."""
    catalogue, on_ranks, OWN = "rupture.ruptures.csv", True, Fault.OWN
    scene = None  # of each subclass

    @classmethod
    def known(cls, _):
        """Variables of the table that the scene reads, or one that it includes."""
        text = (INPUTS / f"{cls.scene}.in").read_text()
        while not (table := re.search(r"^lsm_variables\s+(\S+)", text, re.M)):
            text = (INPUTS / re.search(r"^include_beside\s+(\S+)", text, re.M)[1]).read_text()
        return {one.name for one in declared(INPUTS / table[1])} | cls.OWN

    def command(self):
        for name in ("cpu.txt", "rupture.log"):  # it starts over
            (self.folder / name).unlink(missing_ok=True)
        return self.lmp(self.scene, "rupture.log", "prefix=rupture", "overwrite=yes")

    def steps(self):
        log = self.folder / "rupture.log"
        said = log.read_text() if log.exists() else ""
        return int(re.findall(r"^Loop time of .* for (\d+) steps", said, re.M)[-1]) if "\nTotal wall time:" in said else None


RUPTURES = {
    path.stem: type(path.stem, (Rupture,), {"scene": path.stem})
    for path in [*sorted(INPUTS.glob("rupture_tpv*.in")), INPUTS / "fault_3d.in"]
}


class Slider(Job):
    OWN = {"catalogue", "checkpoint", "json", "progress", "resume", "overwrite", "config", "help", "version"}

    @staticmethod
    def known(binaries):
        """Options that slider_cli --help lists."""
        said = subprocess.run([f"{binaries}/slider_cli", "--help"], check=True, capture_output=True, text=True).stdout
        return set(re.findall(r"^ +(?:-\w,)?--([a-z][\w-]*)", said, re.M))

    def command(self):
        words = []
        for key, value in (pair.split("=", 1) for pair in self.settings):
            words += [f"--{key}"] if value == "yes" else [f"--{key}", *(value.split() if key == "friction-range" else [value])]
        resumed = (self.folder / "checkpoint.bin").exists()
        if resumed and not (self.folder / self.catalogue).exists():
            raise Failed(f"{self.folder}/{self.catalogue} is missing, but there is a checkpoint; move the folder away to begin again")
        return [
            *LOCKED, f"{self.binaries}/slider_cli", *words, "--catalogue", self.catalogue, "--checkpoint", "checkpoint.bin", "--json", "summary.json",
            "--progress", "--resume" if resumed else "--overwrite"
        ]


class Esys(Job):
    """A fault computed by ESyS-Particle; once it is done, summary.json has its steps of shear and its CPU time."""
    catalogue, OWN, known = "fault.catalogue.csv", Fault.OWN, Fault.known

    def command(self):
        return [*LOCKED, f"{INPUTS.parent}/tests/bench/esys_fault.sh", str(self.binaries), *self.settings]


PROGRAMS = {"fault": Fault, "slider": Slider, "esys": Esys, **RUPTURES}


def begun_otherwise(folder, settings):
    """Text for an error if a run with other settings, NAME=VALUE, was started in the folder; empty if not."""
    path = folder / "settings.txt"
    if not any(any(folder.glob(pattern)) for pattern in ("*.restart.*.info", "checkpoint.bin", "done.json")):
        return ""
    had, wanted = (dict(pair.split("=", 1) for pair in pairs) for pairs in (path.read_text().splitlines() if path.exists() else [], settings))
    names = [name for name in {**had, **wanted} if had.get(name) != wanted.get(name)]
    told, asked = (" ".join(f"{name}={pairs[name]}" if name in pairs else f"no {name}" for name in names) for pairs in (had, wanted))
    return "" if not names else (f"{folder} was begun with other settings ({told}), expected {asked}; "
                                 "move it away, or give the study another folder (LSM_OUTPUT)")


def seconds_left():
    """Seconds until the time LSM_UNTIL (in seconds since 1970)."""
    return float(os.environ.get("LSM_UNTIL", "inf")) - time.time()


def work(job, folder):
    """Runs the program until it ends. Returns its exit status, whether it was asked to stop, and its output."""
    output = folder / "output.txt"
    said = output.stat().st_size if output.exists() else 0
    told = []
    # Each run has a session folder of its own: two mpirun that start at the same moment would interfere in a common one.
    with open(output, "ab") as file, tempfile.TemporaryDirectory(prefix="lsm-run-", ignore_cleanup_errors=True) as session:
        child = subprocess.Popen(job.command(), cwd=folder, stdin=subprocess.DEVNULL, stdout=file, stderr=file,
                                 env={**os.environ, **MPI, "OMPI_MCA_orte_create_session_dirs": "1", "OMPI_MCA_orte_tmpdir_base": session},
                                 start_new_session=True, preexec_fn=lambda: die_with_parent(signal.SIGTERM))

        def stop(number, _):
            told.append(number)
            if number in (signal.SIGTERM, signal.SIGALRM):
                job.stop(child)
            else:
                child.terminate()

        for number in (signal.SIGTERM, signal.SIGALRM, signal.SIGINT, signal.SIGHUP):
            signal.signal(number, stop)
        if seconds_left() < 1e9:
            signal.setitimer(signal.ITIMER_REAL, max(0.001, seconds_left()))
        code = child.wait()
    return code, bool(told), output.read_bytes()[said:].decode(errors="replace")


def run(folder, kind, ranks, checkpoint, binaries, *settings):
    folder = Path(folder).resolve()
    if kind not in PROGRAMS:
        raise Failed(f"program {kind!r}, expected {' or '.join(PROGRAMS)}")
    folder.mkdir(parents=True, exist_ok=True)
    lock = alone_in(folder)
    if otherwise := begun_otherwise(folder, [f"program={kind}", *settings]):
        raise Failed(otherwise)
    replace(folder / "settings.txt", "\n".join([f"program={kind}", *settings]) + "\n")
    job = PROGRAMS[kind](folder, ranks, checkpoint, Path(binaries).resolve(), list(settings))
    (folder / "fault.stop").unlink(missing_ok=True)
    cpu = folder / "cpu.txt"
    if job.steps() is None:
        if seconds_left() < 0:
            return STOPPED
        code, told, said = work(job, folder)
        # With the CPU time of earlier parts of the run; that of a killed part is lost.
        used = resource.getrusage(resource.RUSAGE_CHILDREN)
        replace(cpu, f"{(float(cpu.read_text()) if cpu.exists() else 0.0) + used.ru_utime + used.ru_stime:.2f}\n")
        if (code != 0 or job.steps() is None) and told:
            return STOPPED
        if code != 0:
            why = re.findall(r"^(?:ERROR|slider_cli: (?!warning: |.*: \d+ events at step)).*$", said, re.M)
            why = why[-1] if why else f"its program ended with {code}, see output.txt"
            if "link is strained" not in why:
                raise Failed(f"{folder}: {why}" + ("; no space left on the disk" if shutil.disk_usage(folder).free < 2**20 else ""))
            # A repetition with these settings would fail in the same way.
            print(f"run.py: {folder}: {why}", file=sys.stderr)
            replace(folder / "done.json", json.dumps({"failed": why}) + "\n")
            return 0
    done = dict(steps=job.steps(), events=events_in(folder / job.catalogue), cpu_s=float(cpu.read_text()) if cpu.exists() else None, ranks=int(ranks))
    if kind == "esys":
        done["cpu_s"] = job.told()["cpu_s"]  # without its master process, which only waits in a busy loop
    replace(folder / "done.json", json.dumps(done) + "\n")
    lock.close()
    return 0


if __name__ == "__main__":
    die_with_parent()
    try:
        status = run(*sys.argv[1:])
        if status == STOPPED:
            print(f"run.py: {sys.argv[1]}: stopped, to be continued", file=sys.stderr)
        sys.exit(status)
    except (Failed, OSError) as error:
        print(f"run.py: {error}", file=sys.stderr)
        sys.exit(1)
