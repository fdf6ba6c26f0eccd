# SPDX-License-Identifier: GPL-2.0-or-later
"""Slurm with one node on this machine, all in one folder, for tests that run as root."""
import os
import shutil
import socket
import subprocess
import time

import pytest

CONFIGURATION = """ClusterName=test
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={controller}
SlurmdPort={node}
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket={folder}/munge/socket
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
ReturnToService=2
KillWait=5
MpiDefault=none
NodeName={host} NodeAddr=127.0.0.1 CPUs={cpus} RealMemory=2000 State=UNKNOWN
PartitionName=all Nodes={host} Default=YES MaxTime=INFINITE State=UP OverSubscribe=NO
"""


def said(*command):
    return subprocess.run(command, capture_output=True, text=True).stdout.strip()


class Slurm:
    """Starts in the given folder and ends with its 'with'; skips the test if it cannot start."""

    def __init__(self, folder):
        if os.getuid():
            pytest.skip("Slurm: not root")
        for program in "munged", "slurmctld", "slurmd", "sbatch":
            if not shutil.which(program):
                pytest.skip(f"no {program} (Debian packages slurm-wlm, munge)")
        self.folder = folder

    def __enter__(self):
        folder, port = self.folder, os.getpid() % 10000
        for name in "state", "spool", "munge":
            (folder / name).mkdir(parents=True)
        folder.chmod(0o755)
        folder.parent.chmod(0o755)
        key = folder / "munge/key"
        key.write_bytes(os.urandom(128))
        key.chmod(0o400)
        configuration = folder / "slurm.conf"
        configuration.write_text(
            CONFIGURATION.format(host=socket.gethostname().split(".")[0], controller=20000 + port, node=30000 + port, folder=folder,
                                 cpus=os.cpu_count()))
        os.environ["SLURM_CONF"] = str(configuration)
        self.begin("munged", "--force", f"--socket={folder}/munge/socket", f"--key-file={key}", f"--pid-file={folder}/munge.pid",
                   f"--log-file={folder}/munge/log", f"--seed-file={folder}/munge/seed")
        self.begin("slurmctld")
        self.begin("slurmd")
        for _ in range(100):
            if said("sinfo", "-h", "-o", "%t") in ("idle", "mix", "alloc"):
                return self
            time.sleep(0.2)
        self.skip("the node does not come up")

    def begin(self, *command):
        done = subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        if done.returncode:
            self.skip(f"{command[0]} does not start: {done.stderr}")

    def skip(self, why):
        self.__exit__()
        pytest.skip(why)

    def __exit__(self, *_):
        subprocess.run(["scancel", "-u", "root"], capture_output=True)
        for name in "slurmd.pid", "slurmctld.pid", "munge.pid":
            path = self.folder / name
            if path.exists() and path.read_text().strip():
                os.kill(int(path.read_text()), 15)
        os.environ.pop("SLURM_CONF", None)
