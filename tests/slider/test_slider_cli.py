# SPDX-License-Identifier: GPL-2.0-or-later
"""The program slider_cli."""
import gzip
import json
import os
import re
import signal
import subprocess
import zlib
from pathlib import Path

import numpy as np
import pytest
from data_files import header, numbers, pick, read_catalogue, read_series, rows, same, same_bytes, unknown_keys
from programs import changed, interrupt, refused, run, start

SHORT = "--blocks 100 --dt 0.05 --velocity 0.05 --warmup 0 --seed 3 "
SLOW = "--velocity 1e-3 --warmup 0 --seed 3 --time 250000 --leap 1e-3 "
BULK = "--blocks 64 --kl 0.05 --velocity 0.05 --warmup 0 --seed 3 --steps 600000 --columns centroid,length "


@pytest.fixture
def ran(slider):
    """Runs slider_cli with --overwrite, as most tests write the same files again and again."""
    return lambda *arguments, **more: run(slider, "--overwrite", *arguments, **more)


@pytest.fixture
def no(slider):
    """no(arguments, pattern): expects that slider_cli refuses the arguments."""
    return lambda arguments, pattern: refused(slider, [
        "--overwrite", "--catalogue", "bad.csv", "--blocks", 16, "--time", 100, *(arguments.split() if isinstance(arguments, str) else arguments)
    ], pattern)


@pytest.mark.parametrize("way", [
    SLOW + "--blocks 128 --min-size 1e-3 --columns centroid,length", SLOW + "--blocks 128 --min-size 1e-3 --events ruptures --columns centroid",
    BULK + "--coupling inplane --mass 0 --radiation 1.5 --law coulomb",
    BULK + "--coupling antiplane --law coulomb --dynamic-friction 1 --correlation-length 0.5 --radiation 0.1"
])
def test_killed_and_resumed(slider, ran, way):
    """Again and again, with a series that has samples within leaps."""

    def words(name):
        return f"{way} --pe-stride 700 --catalogue {name}.csv --pe-series {name}.pe --checkpoint {name}.chk --checkpoint-interval 3001"

    ran(words("whole"))
    count = 0
    for by in signal.SIGKILL, signal.SIGTERM, signal.SIGKILL:
        more = "--resume" if Path("part.chk").exists() else "--overwrite"
        count += interrupt(slider, words("part"), more, when=changed("part.chk"), by=by)
    assert count >= 1, "the run was never interrupted"
    ran(words("part"), "--resume")
    same("whole.csv", "part.csv")
    same_bytes("whole.pe", "part.pe")
    same_bytes("whole.chk", "part.chk")


PART = "--catalogue part.csv --pe-series part.pe --checkpoint part.chk --checkpoint-interval 50000"


def test_resume(slider, ran):
    settings = SHORT + "--steps 1000000 --pe-stride 7 --columns length "
    ran(settings, "--catalogue whole.csv --pe-series whole.pe")
    part = settings + PART
    # Resuming a finished run changes nothing.
    ran(part)
    same("whole.csv", "part.csv")
    ran(part, "--resume")
    same("whole.csv", "part.csv")
    same_bytes("whole.pe", "part.pe")

    def not_resumed(arguments, pattern):
        refused(slider, "--overwrite --resume " + part + arguments, pattern)

    not_resumed(" --kl 0.02", "kl = 0.01.*expected.*kl = 0.02")
    # Files that do not fit are found before any file is cut, as the incomplete line would be.
    kept, series = Path("part.csv").read_bytes(), Path("part.pe").read_bytes()
    Path("part.csv").write_bytes(kept + b"999,1")
    assert b"\n# seed = 3\n" in series
    Path("part.pe").write_bytes(series.replace(b"\n# seed = 3\n", b"\n# seed = 4\n"))
    not_resumed("", "part.pe: cannot resume: parameter 'seed' is '4'")
    Path("part.pe").write_bytes(series)
    ran(part, "--resume")
    assert Path("part.csv").read_bytes() == kept, "the torn line was not cut"
    # A truncated checkpoint, one with a wrong byte, one of another version, and none.
    whole = Path("part.chk").read_bytes()
    middle = len(whole) // 2
    for name, damaged, said in (("short.chk", whole[:500], "short.chk: damaged"),
                                ("flipped.chk", whole[:middle] + bytes([whole[middle] ^ 4]) + whole[middle + 1:], "flipped.chk: damaged"),
                                ("old.chk", b"slider_cli checkpoint 1 0\n\n",
                                 "^slider_cli: old.chk: checkpoint of version 1, expected version [2-9]: finish that run with the program "
                                 "that started it, or start anew$")):
        Path(name).write_bytes(damaged)
        not_resumed(f" --checkpoint {name}", said)
    not_resumed(" --checkpoint none.chk", "none.chk: cannot be read")
    # Files of another version of the program are continued (header_keys.h).
    state = re.sub(rb"(?m)^program = .*$", b"program = slider_cli 0.9", whole.split(b"\n", 1)[1])
    Path("part.chk").write_bytes(f"slider_cli checkpoint 8 {zlib.crc32(state)}\n".encode() + state)
    ran(part, "--resume")
    same("whole.csv", "part.csv")


def test_a_finished_run_is_continued_for_longer(slider, ran):
    """Its files become those of one longer run, headers included; the number of digits of the steps changes."""
    settings = SHORT + "--columns centroid --pe-stride 7 "
    ran(settings, "--steps 1200000 --catalogue whole.csv --pe-series whole.pe --checkpoint whole.chk")
    ran(settings, "--steps 400000", PART)
    ran(settings, "--steps 900000 --resume", PART)
    refused(slider, f"{settings} --steps 800000 --resume {PART}",
            "part.chk: cannot resume: 900000 steps are done, expected at least as many with --steps or --time, not 800000")
    ran(settings, "--steps 1200000 --resume", PART)
    for name in "csv", "pe", "chk":
        same_bytes(f"whole.{name}", f"part.{name}")


# What is refused: the arguments, or the text of a configuration or stiffness file, and what the one line of error says.
BAD = """
    --frobnicate 3                                 | frobnicate
    --kl 0                                         | --kl = 0, expected
    --blocks 0                                     | --blocks = 0, expected
    --blocks many                                  | --blocks
    --steps 10.5 --time 1                          | --steps
    --dt 1.5                                       | --dt = 1.5, expected at most 0.998
    --scheme printed --dt 0.12                     | --dt = 0.12, expected less than 0.12
    --scheme printed --law coulomb                 | --scheme printed needs --coupling chain and --law velocity-weakening, without --radiation
    --scheme euler                                 | --scheme = 'euler', expected printed, verlet or adams-bashforth
    --scheme adams-bashforth                       | --mass 0 and --scheme adams-bashforth need each other
    --paper --scheme verlet                        | --paper
    --picker best                                  | --picker = 'best', expected
    --picker-lambda 1                              | --picker-lambda = 1, expected
    --friction-range 1.0 0.5                       | --friction-range = 1 0.5, expected
    --law rate-state-ageing                        | --law = 'rate-state-ageing', expected velocity-weakening or coulomb
    --dynamic-friction 0.5                         | --dynamic-friction needs --law coulomb
    --law coulomb --dynamic-friction 1.5           | --dynamic-friction = 1.5, expected at least 0 and at most 1
    --correlation-length nan                       | --correlation-length = nan, expected 0, or a finite number of at least 1e-9
    --radiation -1                                 | --radiation = -1, expected a finite number >= 0
    --radiation 10 --mass 0.1                      | --dt = 0.05, expected at most 0.02
    --mass 0                                       | --mass = 0, expected a positive number, or --radiation
    --mass 0 --radiation 1 --scheme verlet         | --mass 0 and --scheme adams-bashforth need each other
    --mass 0 --radiation 1 --law coulomb           | need .*--law coulomb and a --coupling other than chain
    --mass 0 --radiation 1 --coupling antiplane    | need .*--law coulomb and a --coupling other than chain
    --mass 0 --radiation 1 --law coulomb --coupling antiplane --dt 0.5 | --dt = 0.5, expected at most 0.
    --coupling none.csv                            | --coupling = 'none.csv', expected chain, antiplane or inplane, or a readable file
    --coupling antiplane --kl 0.1 --width 5        | --(kl|width)
    --coupling inplane --width -5                  | --width = -5, expected a positive finite number
    --width 5                                      | --width needs --coupling antiplane or inplane
    --leap -1                                      | --leap = -1, expected a finite number >= 0
    --leap 1e-3 --radiation 0.1                    | --leap needs --coupling chain without
    --events slips                                 | --events = 'slips', expected pe or ruptures
    --events ruptures --without-plate-drops        | --without-plate-drops needs --events pe
    --catalogue no/such/folder/c.csv               | no/such/folder
    --checkpoint no/such/folder/c.chk              | no/such/folder
    --json no/such/folder/s.json                   | no/such/folder
    --resume                                       | --resume requires --checkpoint
    --config none.ini                              | none.ini
    --config /bin/sh                               | /bin/sh: not a text file
    --seed=18446744073709551616                    | seed: expected a whole number from 0 to 18446744073709551615
"""
BAD_FILES = [("--config", b"blocsk = 12\n", "blocsk"), ("--config", b"seed = 3\ndt = 0.05\nseed=4\n", "wrong:3: 'seed' given twice, expected once"),
             ("--config", b"steps = 100 200\n", "wrong:1: 'steps' is '100 200', expected one value"), ("--config", b"seed = -1\n", "not '-1'"),
             ("--config", b"\xef\xbb\xbfseed = 1\n", "wrong: begins with a byte order mark"), ("--config", b"s\0e\0e\0d\0", "wrong: not a text file"),
             ("--config", gzip.compress(b"seed = 1\n"), "wrong: compressed by gzip, expected a file that is not"),
             ("--coupling", b"0,1\n0.5\n", "wrong:2: '0.5', expected wavenumber,stiffness"),
             ("--coupling", b"0.1,1\n4,2\n", "wrong:1: '0.1,1', expected"), ("--coupling", b"0,1\n2,2\n1,2\n", "wrong:3: '1,2', expected"),
             ("--coupling", b"0,1\n4,-2\n", "wrong:2: '4,-2', expected"),
             ("--coupling", b"0,1\n3,2\n", "wrong: ends at wavenumber 3, expected lines up to pi"), ("--coupling", b"", "ends at wavenumber none"),
             ("--kl 0.1 --coupling", b"0,1\n4,2\n", "--kl and --coupling wrong exclude each other"),
             ("--width 10 --coupling", b"0,1\n4,2\n", "--width needs --coupling antiplane or inplane"),
             ("--json wrong --coupling", b"0,1\n4,2\n", "is read by this run")]


def test_bad_input(no):
    for line in BAD.strip().splitlines():
        arguments, said = map(str.strip, line.split(" | "))
        no(arguments, said)
    for option, text, said in BAD_FILES:
        Path("wrong").write_bytes(text)
        no(f"{option} wrong", said)


def test_bad_steps(ran):
    ran("--blocks 16 --steps 100 --seed", 2**64 - 1, "--catalogue largest.csv")
    assert header("largest.csv")["seed"] == "18446744073709551615"
    # Above dt 0.01 the printed scheme runs, with a warning.
    ran("--blocks 16 --steps 100 --scheme printed --dt 0.05 --catalogue c.csv").warned("warning: --dt = 0.05")
    assert ran("--blocks 16 --steps 100 --scheme printed --dt 0.01 --catalogue c.csv").err == ""
    # With --unstable it blows up sooner or later, which is an error, not an endless run of NaN.
    for events in "pe", "ruptures":
        burst = ran("--blocks 64 --steps 3000000 --scheme printed --dt 0.9 --velocity 1 --unstable --warmup 0 --friction-range 0 0.1",
                    "--catalogue burst.csv --events", events, status=None)
        assert burst.status > 0, "the printed scheme survived dt 0.9"
        burst.warned("not a finite number")


def test_headers(ran):
    """What headers state is in the table of all keys, and beside the summary."""
    for more in ("", "--events ruptures", "--law coulomb --dynamic-friction 0.5", "--correlation-length 4 --without-plate-drops --keep-nonpositive",
                 "--leap 0.001", "--radiation 0.1"):
        said = json.loads(ran("--blocks 64 --kl 0.1 --time 2000 --warmup 0", more, "--catalogue c.csv --pe-series c.pe --json -").out)
        found = header("c.csv")
        assert not unknown_keys(found, read_series("c.pe")[0]), more
        assert {key: value for key, value in found.items() if key != "model"} == said["parameters"], more
        assert set("kc kl mass velocity friction_low friction_high seed scheme dt steps min_size warmup".split()) <= set(found)
        assert said["events"] == len(rows("c.csv"))


def test_events_are_those_of_the_series(ran):
    said = json.loads(
        ran("--blocks 50 --velocity 0.05 --steps 400000 --warmup 0 --columns centroid,length --picker-lambda 0.95 --json -",
            "--catalogue c.csv --pe-series c.pe").out)
    _, step, time, pe = read_series("c.pe")
    wanted = pick("exponential", 0.95, 0, step, time, pe)
    assert len(step) == 400001 and len(wanted) > 50 and pe[-1] == pytest.approx(said["pe_direct"], rel=1e-9)
    assert np.allclose(numbers("c.csv"), wanted, rtol=1e-15, atol=0)
    events = read_catalogue("c.csv")[1]
    slip, long, place = (events[name] for name in ("slip_moment", "rupture_length", "x_centroid"))
    assert (slip >= 0).all() and ((slip > 0) == (long > 0)).all() and long.max() == 50 and place.min() >= 0 and place.max() <= 50
    assert events["size"].max() == said["largest_event"]
    # Blocks also slide while the plate raises PE faster than they lower it, but most slip is in events.
    assert 0.5 < slip.sum() / (50 * said["mean_slip"]) <= 1


def test_drops_that_are_no_slip(ran):
    """Of all drops of PE, --without-plate-drops leaves out those due to the plate, and --keep-nonpositive includes those without a size."""
    run_of_many = (SHORT, "--steps 600000 --picker-memory-time 1 --json - --catalogue")
    every, slips, kept = (json.loads(ran(*run_of_many, f"{name}.csv", *more).out)
                          for name, *more in (("every",), ("slips", "--without-plate-drops"), ("kept", "--keep-nonpositive")))
    assert every["events_by_plate"] > 0
    assert slips["events"] == len(rows("slips.csv")) == every["events"] - every["events_by_plate"]
    assert header("slips.csv")["plate_drops"] == "left out" and "plate_drops" not in header("every.csv")
    assert (header("kept.csv")["keep_nonpositive"], header("every.csv")["keep_nonpositive"]) == ("yes", "no")
    assert kept["events"] >= every["events"]


def test_paper(ran):
    ran("--paper --steps 20000 --blocks 16 --catalogue p.csv")
    printed = dict(scheme="printed", dt="0.01", picker="literal", kl="0.01", velocity="0.01", warmup="0", friction_low="0.5", friction_high="1")
    printed["lambda"] = "0.99"
    assert {key: header("p.csv").get(key) for key in printed} == printed


def test_overwrite(slider):
    """Without --overwrite no file with content is replaced, and a refused run leaves no file."""
    settings = SHORT + "--steps 300000 "

    def kept(arguments, pattern):
        refused(slider, settings + arguments, pattern)

    run(slider, settings, "--catalogue a.csv --pe-series a.pe --pe-stride 100 --checkpoint a.chk")
    same("a.csv", "a.csv", 5)
    kept("--catalogue a.csv --pe-series b.pe --checkpoint b.chk",
         "a.csv: exists, expected a new file for --catalogue; --overwrite replaces it, --resume")
    kept("--catalogue b.csv --pe-series a.pe", "a.pe: exists, expected a new file for --pe-series; --overwrite")
    kept("--catalogue b.csv --checkpoint a.chk", "a.chk: exists, expected a new file for --checkpoint; --overwrite")
    kept("--catalogue a.csv --events ruptures", "a.csv: exists")
    # With --overwrite it is; the new files are those of a first run.
    first = Path("a.csv").read_bytes()
    run(slider, settings, "--catalogue a.csv --overwrite --seed 4")
    assert Path("a.csv").read_bytes() != first, "--overwrite did not replace the catalogue"
    run(slider, settings, "--catalogue a.csv --overwrite")
    assert Path("a.csv").read_bytes() == first
    # Empty files and devices are no reason to refuse.
    Path("empty.csv").touch()
    run(slider, settings, "--catalogue empty.csv --pe-series /dev/null")
    same("empty.csv", "a.csv", 5)


def test_config(ran):
    """Comments, Windows line ends, two values where two are expected, text with blanks."""
    ini = "blocks = 100\ndt = 0.05\nvelocity = 0.05\nwarmup = 0\nseed = 3\nsteps = 300000\n"
    ran(SHORT, "--steps 300000 --catalogue b.csv")
    Path("s.ini").write_bytes(("# a chain\n; slow\n" + ini).replace("\n", "\r\n").encode() + b'friction-range = 0.5 1.0\r\ncatalogue = "a b.csv"\r\n')
    ran("--config s.ini")
    same("a b.csv", "b.csv", 5)


@pytest.mark.parametrize("ini", sorted((Path(__file__).parents[2] / "inputs/slider").glob("*.ini")), ids=lambda ini: ini.stem)
def test_config_of_inputs(ran, ini):
    """Those that are shipped run, with the settings that they name."""
    ran("--config", ini, "--time 60" if "\ntime = " in ini.read_text() else "--steps 600", "--catalogue a.csv")
    assert header("a.csv")["blocks"] == ini.stem.split("_")[1]


def test_faults(slider, ran, faults):
    """The run is killed at each system call on files, or the call fails: nothing is lost or silently
    wrong."""
    traced = faults(slider)
    settings = "--blocks 100 --dt 0.05 --velocity 0.05 --warmup 0 --seed 3 --steps 50000 --pe-stride 50 --checkpoint-interval 20000 "
    part = settings + "--catalogue part.csv --pe-series part.pe --checkpoint part.chk"
    ran(settings, "--catalogue whole.csv --pe-series whole.pe --checkpoint whole.chk")
    calls = traced.calls("--overwrite", part, seen="part.")
    names = [name for name, _ in calls]
    assert names.count("write") >= 8 and names.count("rename") >= 5 and "fsync" in names, calls

    def whole(what):
        for ending in "csv", "pe", "chk":
            assert Path(f"part.{ending}").read_bytes() == Path(f"whole.{ending}").read_bytes(), f"{what}: other bytes in part.{ending}"

    def complete(what):
        """Continues the run, or starts it anew if there is no checkpoint, and compares."""
        ran(part, "--resume" if Path("part.chk").exists() else "--overwrite")
        whole(what)
        left = {path.name for path in Path().glob("part.*")} - {"part.csv", "part.pe", "part.chk"}
        assert not left, f"{what}: {left} is left behind"

    errors = dict.fromkeys(["write", "openat", "fsync", "pwrite64"], "ENOSPC") | dict.fromkeys(["rename", "unlink", "truncate", "ftruncate"],
                                                                                               "EACCES")
    for name, n in calls:
        for fault in ["signal=KILL"] + [f"error={error}" for error in [errors.get(name)] if error]:
            what = f"{fault} at {name} {n}"
            for path in Path().glob("part.*"):
                path.unlink()
            result = traced.inject(fault, name, n, part)
            if fault == "signal=KILL":
                assert result.status != 0, f"not {what}"
            elif result.status == 0:
                whole(f"{what} without a word")
            else:
                assert result.err.startswith("slider_cli: ") and result.err.count("\n") == 1, f"{what}: {result}"
            complete(what)


def test_outputs(slider, work):
    """A file cannot serve two purposes, whatever its names; the run is refused at once."""
    here = work / "here"
    here.mkdir()
    os.chdir(here)
    Path("s.ini").write_text("blocks = 16\n")
    os.symlink("a.csv", "link.csv")
    os.link("s.ini", "hard.csv")
    for arguments in ("--catalogue a.csv --pe-series a.csv", "--catalogue a.csv --pe-series ./a.csv", "--catalogue a.csv --pe-series ../here/a.csv",
                      f"--catalogue a.csv --checkpoint {here}/a.csv", "--catalogue a.csv --json a.csv", "--catalogue link.csv --json a.csv",
                      "--pe-series a --checkpoint a", "--checkpoint x --json x"):
        for more in "", " --overwrite":
            refused(slider, "--blocks 16 --time 100 " + arguments + more, "are the same file")
    for arguments in "--config s.ini --catalogue hard.csv --overwrite", "--config s.ini --json s.ini":
        refused(slider, "--blocks 16 --time 100 " + arguments, "is read by this run")
    refused(slider, "--blocks 16 --time 100 --catalogue a.csv.new", "reserved for temporary files")


def test_two_at_a_time(slider):
    """The second of two runs with the same files is refused, and changes nothing."""
    part = ("--blocks 100 --time 1e9 --catalogue p.csv --pe-series p.pe --pe-stride 1000 --checkpoint p.chk "
            "--checkpoint-interval 1000 ")
    with start(slider, part) as child:
        assert child.until(lambda: os.path.exists("p.chk") and os.path.getsize("p.chk"))
        for more in "--resume", "--overwrite", "--catalogue other.csv --overwrite":
            refused(slider, part + more, "is being written by another run", but=r"^p\.")
    # A killed run holds no lock, and a run that ends leaves nothing but its files.
    part = "--blocks 100 --steps 200000 --dt 0.05 --velocity 0.05 --warmup 0 --catalogue p.csv --pe-series p.pe --checkpoint p.chk --overwrite"
    run(slider, part)
    assert sorted(path.name for path in Path().iterdir()) == ["p.chk", "p.csv", "p.pe"]


def test_ruptures(ran):
    # The motion is the same: PE and the state of the chain do not depend on the kind of events.
    ran(SHORT, "--steps 300000 --catalogue pe.csv --pe-series pe.pe --pe-stride 3")
    ran(SHORT, "--steps 300000 --events ruptures --catalogue r.csv --pe-series r.pe --pe-stride 3")
    for one, other in zip(read_series("pe.pe")[1:], read_series("r.pe")[1:]):
        assert len(one) > 1000 and np.array_equal(one, other), "the kind of events changes PE"
    assert header("r.csv")["events"] == "ruptures" and header("r.csv")["rupture_gap"] == "0"
    assert not any(key.startswith(("events", "rupture")) for key in header("pe.csv")), "the header of pe events has changed"
    # Small ruptures are left out.
    ran(SHORT, "--steps 300000 --events ruptures --min-size 0.5 --catalogue large.csv")
    large = [row.split(",", 1)[1] for row in rows("r.csv") if float(row.split(",")[5]) >= 0.5]
    assert large and large == [row.split(",", 1)[1] for row in rows("large.csv")]


def test_a_full_device_loses_no_summary_in_silence(slider):
    with open("/dev/full", "w") as full:
        ended = subprocess.run([*slider.command, *"--blocks 4 --steps 100 --catalogue b.csv --json -".split()], stdout=full, stderr=subprocess.PIPE,
                               text=True)
    assert (ended.returncode, ended.stderr) == (1, "slider_cli: --json -: cannot write to standard output\n")


def test_a_large_catalogue_is_announced(slider, ran):
    """Its size is announced once, while the run can still be stopped, within a factor of two; a small one is not."""
    chain = "--events ruptures --blocks 4000 --kl 0.1 --velocity 0.01 --warmup 0 --time 5000 --catalogue c.csv"
    said = ran(chain).warned("c.csv: ([0-9]+) events at step ([0-9]+) of 100000, at this rate (.*) in all, ([0-9]+) MB; --min-size")
    events, megabytes = len(rows("c.csv")), os.path.getsize("c.csv") / 1e6
    assert 100000 <= int(said[1]) < events and int(said[2]) < 80000
    assert 0.5 < float(said[3]) / events < 2 and 0.5 < float(said[4]) / megabytes < 2
    assert ran(chain, "--min-size 0.5").err == ""


def test_leap(ran):
    ran(SLOW, "--blocks 256 --catalogue active.csv --json leap.json")
    assert header("active.csv")["leap"] == "0.001" and header("active.csv")["leap_calm"] == "50"
    said = json.loads(Path("leap.json").read_text())
    assert said["leaps"] >= 20
    assert 10 * (said["steps"] - said["steps_jumped"] - said["steps_leapt"]) < said["steps"], "leaps save too little"
    # Without leaps no output mentions them.
    ran(SHORT, "--steps 300000 --catalogue none.csv --checkpoint none.chk --json none.json")
    ran(SHORT, "--steps 300000 --leap 0 --catalogue off.csv --checkpoint off.chk")
    same("none.csv", "off.csv")
    same_bytes("none.chk", "off.chk")
    assert "leap" not in Path("none.csv").read_text() + Path("none.json").read_text(), "a run without leaps speaks of them"


def test_leap_of_other_laws(ran):
    """Leaps with another scheme and law. Under Coulomb friction without a drop nothing creeps: leaps end where a block starts."""
    for way, least in (("--scheme printed --dt 0.01 --velocity 1e-2 --time 25000", 3), ("--law coulomb", 3), ("--law coulomb --dynamic-friction 1",
                                                                                                              0)):
        ran(SLOW, "--blocks 96", way, "--catalogue c.csv")
        assert len(rows("c.csv")) >= least, way
