# SPDX-License-Identifier: GPL-2.0-or-later
"""publish.py, with catalogues of two short faults."""
import json
import re
import shutil
import sys
from pathlib import Path

import pytest
from data_files import header, rows
from programs import INPUTS, Program, refused, run, snapshot

sys.path.insert(0, str(INPUTS / "studies"))
import publish  # noqa: E402


def cells(path):
    return [line.split(",")[:6] for line in rows(path)]


@pytest.fixture(scope="module")
def runs(lmp, tmp_path_factory):
    work = tmp_path_factory.mktemp("faults")
    for seed in 1, 2:
        folder = work / f"fault_24_{seed}"
        folder.mkdir()
        run(lmp, "-in", INPUTS / "fault.in", "-var preset absorbing -var prefix fault -var length 24 -var seed", seed,
            "-var settle 400 -var velocity 0.005", "-var steps 6000 -var ruptures yes -var history no", cwd=folder)
    yield sorted(work.iterdir())
    shutil.rmtree(work)


def test_small_events_are_left_out_and_the_header_says_so(runs):
    source = runs[0] / "fault.catalogue.csv"
    sizes = sorted(float(row[5]) for row in cells(source))
    assert len(sizes) > 4
    publish.main(Path("out"), runs)
    for name, least in ("catalogue", publish.EVENTS), ("ruptures", publish.RUPTURES):
        out = f"out/fault_24_1.{name}.csv.xz"
        wanted = [line for line in rows(runs[0] / f"fault.{name}.csv") if float(line.split(",")[5]) >= least]
        assert wanted and rows(out) == wanted
        assert header(out)["thinned"] == f"sizes below {least:g} left out"
    run(Program("publish", sys.executable, INPUTS / "studies/publish.py"), "--ruptures 0.01 out", runs[0])
    assert header("out/fault_24_1.ruptures.csv.xz")["min_size"] == "0.01"
    publish.publish(source, Path("half.xz"), sizes[len(sizes) // 2])
    assert len(rows("half.xz")) == len(sizes) - len(sizes) // 2


def test_runs_that_are_not_done_are_refused(runs, tmp_path):
    script = Program("publish.py", sys.executable, INPUTS / "studies/publish.py")
    folder = tmp_path / "fault_24_1"
    shutil.copytree(runs[0], folder)
    run(script, "out", folder)
    (folder / "settings.txt").write_text("program=fault\n")
    refused(script, ["out", runs[1], folder], "fault_24_1: not done yet, expected a run")
    (folder / "done.json").write_text('{"failed": "a link is strained"}')
    refused(script, ["out", folder], "fault_24_1: a link is strained, expected a run")
    (folder / "done.json").write_text("{}")
    (folder / "fault.catalogue.csv").unlink()
    refused(script, ["out", folder], "fault_24_1: no catalogue, expected the folder of a run")


def test_nothing_is_published_where_something_is_refused(runs, tmp_path):
    script = Program("publish.py", sys.executable, INPUTS / "studies/publish.py")
    for place in "a", "b":
        shutil.copytree(runs[0], tmp_path / place / "fault_24_1")
    first, bad = tmp_path / "a/fault_24_1", tmp_path / "b/fault_24_1"
    refused(script, ["out", first, bad], f"{bad}: there is a run fault_24_1 already, {first}, expected another name")
    refused(script, ["out", first, f"{first}/"], "there is a run fault_24_1 already")
    bad = bad.rename(tmp_path / "b/bad")
    catalogue = bad / "fault.catalogue.csv"
    whole = catalogue.read_text()
    events = len(rows(catalogue))
    for text, said in ((whole.replace("# length = 24\n", "# length = long\n"), r"catalogue.csv:\d+: '# length = long', expected a number"),
                       (whole.replace("# min_size = ", "# min_size = nan # "), r"catalogue.csv:\d+: '# min_size = nan # .*', expected a number"),
                       (whole[:-5], rf"catalogue.csv:{len(whole.splitlines())}: '.*', expected a whole line"),
                       (whole + "1,2,3\n", "'1,2,3', expected an event"), (whole + "\n", "'', expected an event"),
                       ("", "catalogue.csv: no catalogue, expected one"), (whole.replace("lsm-catalogue 1",
                                                                                         "another 1"), "catalogue.csv: no catalogue, expected one")):
        catalogue.write_text(text)
        refused(script, ["out", first, bad], said)
    catalogue.write_text(whole)
    (bad / "done.json").write_text(json.dumps({"events": events + 1}))
    refused(script, ["out", first, bad],
            f"bad: {events} events in fault.catalogue.csv, but {events + 1} in done.json, expected the catalogue of that run")
    (bad / "done.json").write_text(json.dumps({"events": events}))
    # Only files that it wrote itself are replaced, and a link that somebody has made is not followed.
    Path("out").mkdir()
    for name in "bad.catalogue.csv.xz", "bad.ruptures.csv.xz":
        Path("out", name).write_bytes(b"of somebody\n")
        refused(script, ["out", first, bad], f"out/{name}: exists already and holds something else, expected a new name")
        Path("out", name).unlink()
    Path("precious").write_text("of somebody\n")
    Path("out/bad.catalogue.csv.xz.new").symlink_to(Path("precious").resolve())
    run(script, ["out", first, bad], status=1).warned("bad.catalogue.csv.xz.new")
    assert Path("precious").read_text() == "of somebody\n"
    Path("out/bad.catalogue.csv.xz.new").unlink()
    for _ in range(2):
        run(script, ["out", first, bad])
    assert {path.name
            for path in Path("out").iterdir()} == {f"{name}.{kind}.csv.xz"
                                                   for name in ("bad", "fault_24_1") for kind in ("catalogue", "ruptures")}


def test_a_catalogue_without_small_events_stays_so(runs):
    source = (runs[0] / "fault.catalogue.csv").read_text()
    Path("large.csv").write_text(source.replace("# min_size = ", "# min_size = 0.01\n# was = "))
    publish.publish(Path("large.csv"), Path("large.xz"), 1e-4)
    assert header("large.xz")["min_size"] == "0.01" and "thinned" not in header("large.xz")


def test_files_are_replaced_whole(runs, small_disk):
    """If the disk is full, the former ones are kept."""
    script, full = Program("publish.py", sys.executable, INPUTS / "studies/publish.py"), small_disk(1)
    publish.main(full, runs, 0.01)
    before = snapshot(full)
    with open(full / "ballast", "wb", buffering=0) as file:
        with pytest.raises(OSError):
            while True:
                file.write(bytes(1024))
    with pytest.raises(OSError):
        publish.main(full, runs)
    assert {path: content for path, content in snapshot(full).items() if "ballast" not in path} == before
    refused(script, [full, *runs], "publish.py: .*No space left on device")


def test_an_end_at_any_moment_leaves_whole_files(runs, work, faults):
    """Each file is the former or the new one."""
    script, out = Program("publish.py", sys.executable, INPUTS / "studies/publish.py"), work / "out"
    one = runs[0]
    run(script, "--events 0.01 --ruptures 0.01", out, one)
    old = snapshot(out)
    shutil.copytree(out, work / "former")
    run(script, out, one)
    new = snapshot(out)
    assert len(old) == 2 and not set(old.items()) & set(new.items())
    traced = faults(script, [path + end for path in old for end in ("", ".new")], "openat,write,rename")
    calls = traced.calls(out, one, seen=".new")
    assert [name for name, _ in calls].count("rename") == 2 and {"openat", "write"} < {name for name, _ in calls}
    for name, n in calls:
        shutil.copytree(work / "former", out, dirs_exist_ok=True)
        assert traced.inject("signal=KILL", name, n, out, one).status != 0
        left = {path: content for path, content in snapshot(out).items() if not path.endswith(".new")}
        assert all(content in (old[path], new[path]) for path, content in left.items()) and left.keys() == old.keys()
        assert name == "rename" or left == old
    run(script, out, one)
    assert snapshot(out) == new


def test_sliders_are_published_whole(slider, tmp_path):
    (tmp_path / "chain").mkdir()
    run(slider, "--blocks 50 --steps 1e6 --warmup 0 --catalogue", tmp_path / "chain/catalogue.csv")
    source = tmp_path / "chain/catalogue.csv"
    publish.main("out", [tmp_path / "chain"])
    assert rows("out/chain.catalogue.csv.xz") == rows(source) and "thinned" not in header("out/chain.catalogue.csv.xz")
    source.write_text(re.sub(r"(?m)^((?:[^#,\n]*,){5})[0-9.e-]+", r"\1-1e-15", source.read_text(), count=1))
    publish.main("out", [tmp_path / "chain"])
    assert rows("out/chain.catalogue.csv.xz") == rows(source)
    publish.main("out", [tmp_path / "chain"], 100)
    wanted = [line for line in rows(source) if float(line.split(",")[5]) >= 100]
    assert 0 < len(wanted) < len(rows(source)) and rows("out/chain.catalogue.csv.xz") == wanted


def test_a_catalogue_of_another_run_is_not_replaced(slider):
    """A longer run of the same settings replaces its catalogue; one of another seed, whose folder has the same name, does not."""
    for place, words in ("a", "--seed 1 --steps 1e6"), ("b", "--seed 2 --steps 1e6"), ("c", "--seed 1 --steps 2e6"):
        Path(place, "chain").mkdir(parents=True)
        run(slider, "--blocks 50 --warmup 0", words, f"--catalogue {place}/chain/catalogue.csv")
    script, out = Program("publish.py", sys.executable, INPUTS / "studies/publish.py"), "out/chain.catalogue.csv.xz"
    run(script, "out a/chain")
    refused(script, "out b/chain", "out/chain.catalogue.csv.xz: exists already, of another run with seed = 1, not 2, expected a new name")
    assert rows(out) == rows("a/chain/catalogue.csv")
    run(script, "out c/chain")
    assert rows(out) == rows("c/chain/catalogue.csv")


@pytest.mark.parametrize("given, wanted", [("1e-4", "1e-3"), ("1e-3", "1e-3"), ("0.01", "0.01")])
def test_catalogues_of_faults_are_complete_from_the_size_that_was_measured(runs, given, wanted):
    text = (runs[0] / "fault.catalogue.csv").read_text()
    assert "# completeness = 1e-3\n" in text
    Path("run.csv").write_text(text.replace("# completeness = 1e-3\n", f"# completeness = {given}\n"))
    publish.publish(Path("run.csv"), Path("run.xz"))
    assert header("run.xz")["completeness"] == wanted
