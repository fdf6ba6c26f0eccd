# SPDX-License-Identifier: GPL-2.0-or-later
"""Files that the analysis and the block-slider replace, combine, and read: nothing is lost or mixed up."""
import fcntl
import gzip
import json
import os
import shutil
import signal
import time
from pathlib import Path

import numpy as np
import pytest
from data_files import table, write_catalogue
from programs import Program, refused, run, snapshot, start

CHAIN = "--blocks 200 --dt 0.05 --velocity 0.05 --warmup 300 --steps 200000"


@pytest.fixture(scope="module")
def made(tmp_path_factory, slider):
    """A run of the block-slider with all of its output files."""
    folder = tmp_path_factory.mktemp("made")
    run(slider, CHAIN, "--catalogue slider.csv --pe-series slider.pe --checkpoint slider.ck", cwd=folder)
    return folder


@pytest.fixture
def files(made, work):
    for file in made.iterdir():
        shutil.copy(file, work)
    return work


# Each command of postproc that writes, with an output that would replace the file FILE.csv.
WRITERS = [
    "series slider.pe --no-picture -o {base}",
    "histograms slider.csv --no-picture -o {base}",
    "fit slider.csv --replicas 0 --no-picture -o {base}",
    "intervals slider.csv --replicas 0 --no-picture -o {base}",
    "compare slider.csv slider.csv --label a --label b --replicas 10 -o {base}",
    "explore slider.csv -o {base}.csv",
    "count slider.csv --json {base}.csv",
    "fit slider.csv --replicas 0 --no-picture -o pic --json {base}.csv",
    "pick slider.pe -o {base}.csv",
    "select slider.csv -o {base}.csv",
]

KEPT = [("slider.csv", "a catalogue"), ("slider.pe", "a PE series"), ("slider.ck", "a checkpoint"), ("restart", "a restart file"),
        ("packed", "what gzip has compressed"), ("notes", "something else")]


@pytest.mark.parametrize("line, kept, content", [(line, *KEPT[0]) for line in WRITERS] + [(WRITERS[1], *one) for one in KEPT[1:]])
def test_nothing_else_is_replaced(postproc, files, line, kept, content):
    Path("restart").write_bytes(b"LammpS RestartT\0" + bytes(100))
    Path("packed").write_bytes(gzip.compress(Path("slider.csv").read_bytes()))
    Path("notes").write_text("label,value\nof a measurement,1\n")
    shutil.copy(kept, "base.csv")
    words = line.format(base="base")
    refused(postproc, words, f"base.csv: exists already and holds {content}, expected a new name, or --overwrite")
    run(postproc, words, "--overwrite")
    assert Path("base.csv").read_bytes() != Path(kept).read_bytes()


@pytest.mark.parametrize("line", [line for line in WRITERS if not line.startswith(("pick", "select"))])
def test_what_a_command_wrote_is_replaced(postproc, files, line):
    words = line.format(base="base")
    run(postproc, words)
    before = snapshot()
    run(postproc, words)
    assert snapshot() == before


@pytest.mark.parametrize("line", [
    "series slider.pe --no-picture -o out/pic --json out/n.json",
    "pick slider.pe -o out/picked.csv --json out/n.json",
    "fit slider.csv --replicas 0 --no-picture -o out/fit --json out/n.json",
    "intervals slider.csv --replicas 0 --no-picture -o out/times --json out/n.json",
])
def test_nothing_is_written_where_one_of_the_outputs_is_refused(postproc, files, line):
    """It may be a file of somebody else, or one that another program is writing."""
    run(postproc, line)
    outputs = sorted(Path("out").iterdir())
    assert len(outputs) > 1
    for output in outputs:
        shutil.rmtree("out")
        Path("out").mkdir()
        output.write_text('{"a": "note"}\n')
        refused(postproc, line, f"{output}: exists already and holds something else")
        output.unlink()
        # The lock of a file that does not exist yet is that of the temporary file as which it begins.
        with open(f"{output}.new", "w") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            refused(postproc, line, f"{output}: is being written by another run")
            refused(postproc, line + " --overwrite", f"{output}: is being written by another run")
        Path(f"{output}.new").unlink()


def test_pictures_belong_to_their_script(postproc, files, gnuplot):
    Path("fit.png").write_bytes(b"\x89PNG of a holiday")
    refused(postproc, "histograms slider.csv -o fit", "fit.png: exists already and holds something else, expected a new name, or --overwrite")
    Path("fit.png").unlink()
    run(postproc, "histograms slider.csv -o fit")
    run(postproc, "histograms slider.csv -o fit")
    Path("fit.gp").write_text("plot x\n")
    refused(postproc, "histograms slider.csv -o fit", "fit.gp: exists already and holds something else")


def test_slider_summary_replaces_only_a_summary(slider, files):
    again = CHAIN + " --catalogue new.csv --overwrite"
    for kept in "slider.csv", "slider.pe", "slider.ck":
        refused(slider, CHAIN + f" --catalogue new.csv --json {kept}", f"{kept}: exists already and holds .*, expected a new name, or --overwrite")
    run(slider, again, "--json s.json")
    run(slider, CHAIN + " --catalogue newer.csv --json s.json")
    assert json.loads(Path("s.json").read_text())["catalogue"] == "newer.csv"
    Path("s.json").write_text('{"name": "a package"}\n')
    refused(slider, CHAIN + " --catalogue other.csv --json s.json", "s.json: exists already and holds something else")


@pytest.mark.parametrize("line", ["series slider.pe --to 1000 -o {}/b --json {}/j", "histograms slider.csv -o {}/b --json {}/j"])
def test_a_full_disk_leaves_whole_files(postproc, files, small_disk, gnuplot, line):
    """Whenever the disk becomes full, files are complete; with free space again the result is the usual one."""
    disk, order = small_disk(8), ["text", "b-events.csv", "b.csv", "b.gp", "b.png", "b.svg", "j"]
    Path("there").mkdir()
    run(postproc, line.replace("{}", "there"))
    size = {name: Path("there", name).stat().st_size for name in order if Path("there", name).exists()}
    wanted = {name: Path("there", name).read_bytes() for name in size}
    assert len(size) > 4 and {path.name for path in Path("there").iterdir()} == set(size)

    def pages(count):
        return -(-count // 4096) * 4096

    for n, name in enumerate(size):
        room = sum(pages(size[before]) for before in list(size)[:n]) + size[name] // 2 // 4096 * 4096
        for path in disk.iterdir():
            path.unlink()
        with open(disk / "ballast", "wb") as file:
            file.write(bytes(shutil.disk_usage(disk).free - room))
        ended = run(postproc, line.replace("{}", "small"), status=1)
        assert len(ended.err.splitlines()) == 1 and "no space left" in ended.err.lower(), f"{name}: {ended}"
        left = {path.name: path.read_bytes() for path in disk.iterdir() if path.name != "ballast"}
        assert left.items() <= wanted.items(), f"{name}: {sorted(left)}"
        (disk / "ballast").unlink()
        run(postproc, line.replace("{}", "small"))
        assert {path.name: path.read_bytes() for path in disk.iterdir()} == wanted


# ---------------------------------------------------------------- files of different runs


def pareto(n, seed=1, least=1e-4):
    return least / (1 - np.random.default_rng(seed).random(n))


def test_explore_with_conditions_on_drops_and_of_earthquakes(postproc, slider, files):
    """Conditions on columns that ruptures lack, sizes left out of a published catalogue, and a catalogue without a model."""
    run(slider, CHAIN, "--events ruptures --catalogue ruptures.csv")
    lines = Path("slider.csv").read_text().splitlines()
    head = next(n for n, line in enumerate(lines) if not line.startswith("#"))
    lines[head:] = [lines[head] + ",peak_slip", *(line + ",1" for line in lines[head + 1:])]
    Path("mine.csv").write_text("\n".join([lines[0], "# thinned = sizes below 0 left out", *lines[1:], ""]))
    run(postproc, "explore mine.csv --ruptures ruptures.csv -o page.html", ["--where", "peak_slip > 0"]).printed(r"ruptures.csv: [1-9]\d* events")
    Path("quakes.csv").write_text("time,latitude,longitude,mag\n" + "".join(f"1984-01-{day:02}T00:00:00Z,34,-118,{2 + day % 3}.1\n"
                                                                            for day in range(1, 29)))
    run(postproc, "explore quakes.csv --from 1984-01-03 --magnitude-bin 0.1 -o quakes.html").printed("quakes.csv: 26 events")


def test_explore_refuses_files_of_other_runs(postproc, slider, files):
    run(slider, CHAIN, "--seed 2 --catalogue other.csv --pe-series other.pe")
    run(postproc, "explore slider.csv --series slider.pe")
    refused(postproc, "explore slider.csv --ruptures slider.csv -o mixed.html", "slider.csv: no catalogue of ruptures, expected one")
    refused(postproc, "explore slider.csv --series other.pe -o mixed.html",
            "other.pe: seed = 2, but 1 in slider.csv: expected a file of the same run")
    refused(postproc, "explore other.csv slider.csv --series slider.pe --series none -o mixed.html", "seed = 1, but 2")
    # This happens if the prefix of a catalogue was used again.
    shutil.copy("other.pe", "slider.pe.bin")
    refused(postproc, "explore slider.csv -o mixed.html", "slider.pe.bin: seed = 2")
    # The settings are the same, but the start differs: events have other times than the samples of their steps.
    late = []
    for line in Path("slider.csv").read_text().splitlines():
        cells = line.split(",")
        if line[0].isdigit():
            cells[1:3] = [str(float(cell) + 1000) for cell in cells[1:3]]
        late.append(",".join(cells))
    Path("late.csv").write_text("\n".join(late) + "\n")
    refused(postproc, "explore late.csv --series slider.pe -o mixed.html", "slider.pe: step .* expected a file of the same run")


# ---------------------------------------------------------------- selections

QUAKES = "time,latitude,longitude,depth,mag,type\n" + "".join(
    f"20{k % 20:02d}-03-{1 + k % 28:02d}T01:00:00Z,{-60 + k % 120},{-179 + (7 * k) % 358},5,{2 + k % 30 / 10},earthquake\n" for k in range(300))

SELECTIONS = """
    count slider.csv --from 1984-01-01             | --from or --to is a date, but no catalogue is of earthquakes
    fit slider.csv -o x --from 1984-01-01          | --from or --to is a date, but no catalogue is of earthquakes
    select slider.csv -o x --from 1984-01-01       | --from or --to is a date, but no catalogue is of earthquakes
    count slider.csv --region -122/-114/32/37      | --region, but no catalogue is of earthquakes
    fit slider.csv -o x --region -122/-114/32/37   | --region, but no catalogue is of earthquakes
    count slider.csv --from 5 --from 9             | from '9': a second model time, expected one for all catalogues
    count quakes.csv --from 10                     | --from or --to is a number, but all catalogues are of earthquakes, expected a date
    fit quakes.csv -o x --from 10                  | --from or --to is a number, but all catalogues are of earthquakes, expected a date
    count quakes.csv --from monday                 | from 'monday': expected a model time, or for earthquakes a date
    count quakes.csv --to 1985-01-01 --to 1990-01-01 | to '1990-01-01': a second date, expected one
    count quakes.csv --region 1/2/3                | expected W/E/S/N in degrees
    count quakes.csv --region 180/-180/-90/90      | --region '180/-180/-90/90', expected W/E/S/N
"""


def test_selections_that_choose_nothing_are_refused(postproc, files):
    Path("quakes.csv").write_text(QUAKES)
    for line in SELECTIONS.strip().splitlines():
        refused(postproc, *map(str.strip, line.split(" | ")))


def test_every_region_counts(postproc, work):
    Path("quakes.csv").write_text(QUAKES)
    found = run(
        postproc, "count quakes.csv --json n.json --region -180/0/-90/90 --region 0/180/-90/90 --region -180/180/-90/90 "
        "--region 0/360/-90/90 --region 170/-170/-90/90")
    west, east, all_of, again, line = [row["events"] for row in json.loads(Path("n.json").read_text())["catalogues"]]
    assert all_of == again == 300 and west + east >= 300 and 0 < line < west, found


# ---------------------------------------------------------------- headers


def rows_of(path):
    return [line.split(",")[:8] for line in Path(path).read_text().splitlines() if line[0].isdigit()]


def test_picking_after_leaps(postproc, slider, work):
    """The same events within the memory of the picker, 1, or 20 steps; the one that has not ended is not counted."""
    run(slider, "--blocks 100 --velocity 1e-2 --steps 3000000 --warmup 0 --leap 1e-3 --catalogue l.csv --pe-series l.pe")
    done = run(postproc, "pick l.pe -o p.csv --json p.json")
    run_rows, picked = rows_of("l.csv"), rows_of("p.csv")
    assert len(run_rows) == len(picked) > 50
    for a, b in zip(run_rows, picked):
        assert abs(int(a[3]) - int(b[3])) < 20 and abs(int(a[4]) - int(b[4])) < 20, (a, b)
    counts = json.loads(Path("p.json").read_text())["counts"][0]
    assert counts["unfinished"] == 1, done
    run(postproc, "series l.pe --no-picture -o s --json s.json")
    assert json.loads(Path("s.json").read_text())["series"][0]["events"] == counts["events"]


# ---------------------------------------------------------------- crashes and hangs

HOSTILE = 20


def test_numbers_beyond_all_reason(postproc, work):
    write_catalogue("model.csv", np.arange(300.0), pareto(300))
    refused(postproc, "magnitudes model.csv --no-picture --threshold 0", "--threshold 0 has no magnitude", timeout=HOSTILE)
    Path("quakes.csv").write_text(QUAKES)
    refused(postproc, "magnitudes quakes.csv --no-picture --magnitude-bin 1e-9", "expected fewer than 1e5 bins", timeout=HOSTILE)
    names = []
    for k, length in enumerate((120, 240, 480, 945)):
        names.append(f"big{k}.csv")
        sizes = 1e308 * pareto(100, k, 0.01).clip(max=1)
        write_catalogue(names[-1], np.arange(100.0), sizes, dict(model="lsm", length=length))
    for command in "fit --replicas 0 --no-picture", "histograms --no-picture":
        refused(postproc, f"{command} {' '.join(names)}", "big0.csv: event 1 has a time or size of .*, expected at most 1e.100", timeout=HOSTILE)


def test_lines_have_a_limit(postproc, work):
    """A small compressed file may unpack to an arbitrarily long line."""
    with gzip.open("long.csv.gz", "wb", compresslevel=9) as file:
        file.write(b"time,latitude,longitude,mag\n")
        for _ in range(200):
            file.write(b"1" * (1 << 20))
    limit = ["bash", "-c", 'ulimit -v 1000000; exec "$@"', "bash"]
    small = Program("postproc", *limit, *postproc.command)
    refused(small, "count long.csv.gz", "long.csv.gz: a line of more than 1048576 bytes", timeout=HOSTILE)


def test_pipe_without_reader_can_be_left(slider, work):
    os.mkfifo("pipe")
    with start(slider, CHAIN, "--catalogue pipe") as child:
        time.sleep(1.0)
        assert child.poll() is None
        child.send_signal(signal.SIGTERM)
        assert child.wait(HOSTILE) == 1
        assert "pipe: cannot open for writing" in child.said()


def test_closed_standard_streams(slider, postproc, work):
    """Files that are opened do not become the standard streams to which messages are written."""
    chain = "--blocks 200 --dt 0.05 --velocity 0.05 --warmup 300 --steps 3000000 --progress"
    run(slider, chain, "--catalogue open.csv --pe-series open.pe --pe-stride 10")
    for streams in "<&- >&- 2>&-", "2>&-":
        bare = Program("slider_cli", "bash", "-c", f'exec "$@" {streams}', "bash", *slider.command)
        run(bare, chain, "--catalogue closed.csv --pe-series closed.pe --pe-stride 10 --overwrite")
        assert Path("closed.csv").read_bytes() == Path("open.csv").read_bytes()
        assert Path("closed.pe").read_bytes() == Path("open.pe").read_bytes()
    run(postproc, "pick open.pe -o open.picked")
    bare = Program("postproc", "bash", "-c", 'exec "$@" <&- >&- 2>&-', "bash", *postproc.command)
    assert run(bare, "pick open.pe -o closed.picked", status=None).status == 1
    assert Path("closed.picked").read_bytes() == Path("open.picked").read_bytes()
    assert run(bare, "pick no.pe -o closed.picked", status=None).status == 1


# ---------------------------------------------------------------- what others write


def test_catalogues_from_pipes(postproc, work):
    """Which are read once."""
    Path("quakes.csv").write_text(QUAKES)
    Path("packed").write_bytes(gzip.compress(QUAKES.encode()))
    piped = Program("postproc", "bash", "-c", '"$0" count <(cat packed) "$@"', postproc.path)
    run(piped, "quakes.csv --json n.json --size M2 --size M4.05")
    piped, plain = json.loads(Path("n.json").read_text())["catalogues"]
    assert piped["events"] == plain["events"] == 300 and piped["first_start"] == plain["first_start"]


def test_files_that_are_no_table_are_named(postproc, work):
    """Of no known format, empty, packed, or of two bytes a letter."""
    names = "time,latitude,longitude,mag\n"
    Path("events.csv").write_text("when,where\n1,2\n")
    refused(postproc, "count events.csv", "events.csv:1: not a catalogue, expected '# lsm-catalogue 1' of a model, or earthquakes: columns")
    Path("events.csv").write_text("")
    refused(postproc, "count events.csv", "events.csv:1: empty file, expected '# lsm-catalogue 1' of a model, or earthquakes")
    Path("events.csv").write_bytes(b"PK\3\4 and more")
    refused(postproc, "count events.csv", "events.csv: compressed by zip")
    for code in ("utf-16", "utf-16-le", "utf-16-be"):
        Path("events.csv").write_bytes((names + "2020-01-01,1,2,3\n").encode(code))
        refused(postproc, "count events.csv", "events.csv: text in UTF-16")
    refused(postproc, "count -", "-: no such file, expected /dev/stdin for standard input")


def test_sizes_may_be_magnitudes(postproc, work):
    Path("events.csv").write_text(QUAKES)
    texts = []
    for command in "fit events.csv --range {} --replicas 0", "intervals events.csv --threshold {} --replicas 0":
        for size in ("1e3:1e9", "M2:M6") if command.startswith("fit") else ("M3", repr(10**4.5)):
            run(postproc, command.format(size), "--no-picture -o o --json o.json --overwrite")
            texts.append(Path("o.json").read_text())
    assert texts[0] == texts[1] != texts[2] == texts[3]


def test_labels_are_anything(postproc, work, files):
    label = os.fsdecode(b"caf\xe9 =1+1")
    run(postproc, ["fit", "slider.csv", "--label", label, "--replicas", "0", "--no-picture", "-o", "fit", "--json", "fit.json"])
    assert json.loads(Path("fit.json").read_text())["fits"][0]["label"] == "caf� =1+1"
    for name in "fit.csv", "fit.fits.csv", "fit.gp":
        Path(name).read_text(encoding="utf-8")
    run(postproc, ["explore", "slider.csv", "--label", label])
    Path("explore.html").read_text(encoding="utf-8")
    odd = os.fsdecode(b"caf\xe9.csv")
    shutil.copy("slider.csv", odd)
    Path(odd).write_text(Path("slider.csv").read_text().replace("# blocks = 200\n", ""))
    run(postproc, ["fit", odd, "--replicas", "0", "--no-picture", "-o", "s"])
    assert "caf�" in Path("s.csv").read_text(encoding="utf-8")


def test_labels_are_no_formulas(postproc, files):
    """But a number remains a number."""
    labels = ["=HYPERLINK(1)", "+1+1", "-2+3", "@SUM(A1)", '=1,"2"', "-5"]
    run(postproc, ["histograms", *["slider.csv"] * len(labels), *(f"--label={label}" for label in labels), "--no-picture", "-o", "s"])
    assert list(dict.fromkeys(row["label"] for row in table("s.csv"))) == [*("'" + label for label in labels[:-1]), "-5"]


# ---------------------------------------------------------------- small traps


def test_two_catalogues_have_two_names(postproc, files):
    shutil.copy("slider.csv", "mus_0.8.catalogue.csv")
    done = run(postproc, "compare slider.csv mus_0.8.catalogue.csv --replicas 10 -o c")
    assert "block-slider, N = 200 (slider)" in done.out and "block-slider, N = 200 (mus_0.8)" in done.out
