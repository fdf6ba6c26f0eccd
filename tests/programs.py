# SPDX-License-Identifier: GPL-2.0-or-later
"""Starts programs for the tests: run, refused, start, interrupt, and Faults in their system calls.

Arguments: a text is split into words as a shell does ("--blocks 16 --label 'a b'"); the items of a
list are words; numbers and paths are one word each.
"""
import hashlib
import os
import re
import shlex
import shutil
import signal
import subprocess
import tempfile
import time
from pathlib import Path

SOURCE = Path(__file__).resolve().parent.parent
BUILD = Path(os.environ.get("LSM_BUILD_DIR", SOURCE / "build"))
INPUTS = SOURCE / "inputs"
TIMEOUT = 300


def skip(reason):
    import pytest  # benchmarks use this file without it
    pytest.skip(reason)


def words(*arguments):
    found = []
    for argument in arguments:
        if isinstance(argument, str):
            found += shlex.split(argument)
        elif isinstance(argument, (list, tuple)):
            found += [str(word) for word in argument]
        else:
            found.append(str(argument))
    return found


class Program:
    """A command, its environment, and how to recognise its error lines."""

    def __init__(self, name, *command, env=None, errors=None):
        self.name, self.command = name, [str(word) for word in command]
        self.env = {**os.environ, "LC_ALL": "C", **(env or {})}
        self.errors = errors or (lambda result: result.err.splitlines())
        self.errors_begin = "" if errors else f"{name}: "

    @classmethod
    def built(cls, name, *options, **more):
        """The program of that name that CMake has built; LSM_NAME in the environment replaces it."""
        path = os.environ.get("LSM_" + name.upper()) or os.environ.get("LSM_BUILT_" + name.upper()) or BUILD / "bin" / name
        if not Path(path).exists():
            skip(f"{name} is not built: no {path}")
        return cls(name, path, *options, **more)

    @property
    def path(self):
        return Path(self.command[0])


class Result:
    """Result of a program that has ended: status, out, err."""

    def __init__(self, line, status, out, err):
        self.line, self.status, self.out, self.err = line, status, out, err

    def __str__(self):
        return f"{shlex.join(self.line)} ended with {self.status}\n{self.err}{self.out[-3000:]}"

    def printed(self, pattern):
        """The match of a pattern in the output, with columns one blank apart; fails if there is none."""
        found = re.search(pattern, re.sub(" +", " ", self.out), re.M)
        assert found, f"expected '{pattern}' from {self}"
        return found

    def warned(self, pattern):
        found = re.search(pattern, self.err, re.M)
        assert found, f"expected '{pattern}' on standard error of {self}"
        return found


def run(program, *arguments, status=0, timeout=TIMEOUT, env=None, stdin=subprocess.DEVNULL, **more):
    """Runs a program until it ends. status: expected exit status, None for any."""
    line = program.command + words(*arguments)
    done = subprocess.run(line, env={**program.env, **(env or {})}, stdin=stdin, capture_output=True, timeout=timeout, encoding="utf-8",
                          errors="replace", **more)
    result = Result(line, done.returncode, done.stdout, done.stderr)
    assert status is None or result.status == status, str(result)
    return result


def snapshot(folder=".", but=None):
    """Checksums of all files below a folder. but: a pattern of files to leave out"""
    found = {}
    for path in sorted(Path(folder).rglob("*")):
        if but and re.search(but, str(path)):
            continue
        found[str(path)] = (hashlib.md5(path.read_bytes()).hexdigest() if path.is_file() else os.readlink(path) if path.is_symlink() else "")
    return found


def refused(program, arguments, pattern, folder=".", but=None, **more):
    """Expects the program to end with status 1 and one error line that matches, and all files unchanged."""
    before = snapshot(folder, but)
    result = run(program, arguments, status=1, **more)
    lines = program.errors(result)
    assert len(lines) == 1 and lines[0].startswith(program.errors_begin), f"not one line of error: {result}"
    assert re.search(pattern, lines[0]), f"expected '{pattern}': {result}"
    after = snapshot(folder, but)
    assert after == before, f"files were written or changed, {sorted(set(after.items()) ^ set(before.items()))}: {result}"
    return result


class Child(subprocess.Popen):
    """A program in the background, which does not outlive its 'with'."""

    def __init__(self, program, *arguments, env=None, **more):
        self._said = tempfile.TemporaryFile("w+", encoding="utf-8", errors="replace")
        super().__init__(program.command + words(*arguments), env={**program.env, **(env or {})}, stdin=subprocess.DEVNULL, stdout=self._said,
                         stderr=subprocess.STDOUT, **more)

    def __exit__(self, *what):
        if self.poll() is None:
            self.send_signal(signal.SIGCONT)
            self.kill()
        return super().__exit__(*what)

    def said(self):
        self._said.seek(0)
        return self._said.read()

    def until(self, condition, seconds=60, pause=0.002):
        """Waits until condition() holds. Returns False if the program ends before that."""
        limit = time.monotonic() + seconds
        while not condition():
            if self.poll() is not None:
                return False
            assert time.monotonic() < limit, f"waited for {seconds} s: {self.said()}"
            time.sleep(pause)
        return True


def start(program, *arguments, **more):
    return Child(program, *arguments, **more)


def interrupt(program, *arguments, when, by=signal.SIGKILL, **more):
    """Starts a program and sends it a signal once when() holds. Returns whether the signal ended it."""
    with start(program, *arguments, **more) as child:
        child.until(when)
        child.send_signal(by)
        status = child.wait(TIMEOUT)
    assert status in (0, -by, 128 + by), child.said()
    return status != 0


def changed(path):
    """A condition: the file has been replaced or written since this call."""

    def stamp():
        try:
            stat = os.stat(path)
        except FileNotFoundError:
            return None
        return stat.st_ino, stat.st_mtime_ns

    before = stamp()
    return lambda: stamp() != before


class Faults:
    """Injects faults into the system calls with which a program changes files: a call fails, or the
    program is killed there. paths: only calls on these files are counted."""

    CALLS = "openat,write,pwrite64,rename,unlink,unlinkat,fsync,truncate,ftruncate,flock,close"

    def __init__(self, program, paths=(), calls=CALLS):
        if not shutil.which("strace") or subprocess.run(["strace", "-o", "/dev/null", "true"], capture_output=True).returncode:
            skip("strace is missing or may not trace here")
        self.program, self.names = program, calls
        self.paths = [word for path in paths for word in ("-P", str(path))]

    def _traced(self, *options):
        return Program(self.program.name, "strace", "-f", *options, *self.paths, *self.program.command, env=self.program.env,
                       errors=self.program.errors)

    def calls(self, *arguments, seen="", **more):
        """(name, n), the n-th call of that name, for all calls from the first one that mentions `seen`."""
        with tempfile.NamedTemporaryFile("r", encoding="utf-8", errors="replace") as log:
            run(self._traced("-o", log.name, "-e", "trace=" + self.names), *arguments, **more)
            count, found, begun = {}, [], False
            for line in log:
                name = re.match(r"\d+ +([a-z0-9]+)\(", line)
                if not name:
                    continue
                count[name[1]] = count.get(name[1], 0) + 1
                begun = begun or seen in line
                if begun:
                    found.append((name[1], count[name[1]]))
        return found

    def inject(self, fault, name, n, *arguments, **more):
        """Runs the program with a fault in its n-th call of that name: signal=KILL, error=ENOSPC."""
        return run(self._traced("-o", "/dev/null", "-e", f"trace={self.names}", "-e", f"inject={name}:{fault}:when={n}"), *arguments, status=None,
                   **more)


def scene(name="fault.in", **variables):
    """Words that run a scene of inputs with values of its variables; those that are None are left out."""
    return ["-in", INPUTS / name, *(word for key, value in variables.items() if value is not None for word in ("-var", key, value))]
