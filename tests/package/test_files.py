# SPDX-License-Identifier: GPL-2.0-or-later
"""Python module lsm: it reads what the programs wrote, and the examples of its page and the notebook run."""
import gzip
import json
import lzma
import os
import re
import subprocess
import sys

import numpy as np
import pytest

from data_files import loading_with_drops, numbers, pick
from programs import BUILD, SOURCE, run

sys.path.insert(0, str(SOURCE / "python"))
import lsm  # noqa: E402

CATALOGUE = """# lsm-catalogue 1
# model = lsm
# seed = 3
event_id,t_start,t_end,step_start,step_end,size,pe_start,pe_end,new_one
1,0.5,1,5,10,0.25,2,1.75,7
3,2,3,20,30,1e-05,2,1.99999,8
"""


def test_catalogue_of_the_slider_to_the_last_digit(slider):
    run(
        slider, "--blocks 100 --dt 0.05 --velocity 0.05 --warmup 0 --steps 100000 --pe-stride 1 --columns centroid,length "
        "--catalogue a.csv --pe-series a.bin")
    lines = [line.split(",") for line in open("a.csv").read().splitlines() if not line.startswith("#")]
    events = lsm.read_catalogue("a.csv")
    assert list(events.dtype.names) == lines[0] and len(events) == len(lines) - 1 >= 10
    for name, column in zip(lines[0], zip(*lines[1:])):
        assert [float(text) for text in column] == events[name].tolist(), name
    assert events.header["model"] == "block-slider" and events["event_id"].dtype == np.int64
    series = lsm.read_series("a.bin")
    assert len(series) == 100001 and np.allclose(series["time"], 0.05 * series["step"], rtol=1e-12)
    at = {step: pe for step, pe in zip(series["step"], series["pe"])}
    inside = [event for event in events if event["step_start"] in at and event["step_end"] in at]
    assert all(at[event["step_start"]] == event["pe_start"] and at[event["step_end"]] == event["pe_end"] for event in inside) and inside


def test_numbers_are_plain(work):
    """json and round() take them."""
    (work / "a.csv").write_text(CATALOGUE)
    events = lsm.read_catalogue("a.csv")
    size, number = events["size"], events["event_id"]
    found = [size.max(), size.sum(), size.mean(), np.mean(size), np.std(size), np.median(size), number.max(), number.sum(), (size > 0.1).sum()]
    assert json.loads(json.dumps(found)) == pytest.approx([0.25, 0.25001, *[0.125005] * 2, 0.124995, 0.125005, 3, 4, 1], rel=1e-15)
    assert round(size.max(), 1) == 0.2 and isinstance(round(number.max()), int)
    doubled = 2 * size[:1]
    assert doubled.tolist() == [0.5] and doubled.header["seed"] == "3" and np.sqrt(events[:0]["size"]).shape == (0,)


@pytest.mark.parametrize("content", [
    gzip.compress(CATALOGUE.encode()),
    lzma.compress(CATALOGUE.encode()), b"\xef\xbb\xbf" + CATALOGUE.replace("\n", "\r\n").encode(),
    CATALOGUE.replace("# seed = 3", "#seed=3").encode(), f"{CATALOGUE}4,3,4,30,4".encode()
], ids=["gzip", "xz", "Windows", "without blanks", "a line that is still being written"])
def test_forms_of_a_catalogue(work, content):
    (work / "a.csv").write_bytes(content)
    events = lsm.read_catalogue("a.csv")
    assert events["new_one"].tolist() == [7.0, 8.0] and events["event_id"].tolist() == [1, 3] and events["size"].tolist() == [0.25, 1e-5]
    assert events.header == {"model": "lsm", "seed": "3"} and events[events["size"] > 1].header == events.header


def test_further_columns_of_text_are_left_out(work):
    (work / "a.csv").write_text(CATALOGUE.replace(",new_one", ",quality").replace(",7\n", ",good\n").replace(",8\n", ",bad\n"))
    events = lsm.read_catalogue("a.csv")
    assert "quality" not in events.dtype.names and events["size"].tolist() == [0.25, 1e-5]


def binary(magic, header, records):
    return magic + len(header).to_bytes(8, "little") + header + records


def test_series_with_times_of_its_own_and_an_incomplete_record(work):
    records = np.array([(0, 0.5, 2.0), (9, 7.5, 1.0)], [("step", "<i8"), ("time", "<f8"), ("pe", "<f8")]).tobytes()
    (work / "a.bin").write_bytes(binary(b"lsm-pe-series-1\n", b"# times = own\n", records + b"12345"))
    series = lsm.read_series("a.bin")
    assert series["time"].tolist() == [0.5, 7.5] and series["pe"].tolist() == [2.0, 1.0]


SERIES = b"lsm-pe-series-1\n"
NAN = CATALOGUE.replace("0.25", "nan")
NONE = [(lsm.read_catalogue, text.encode(), said) for text, said in (
    ("a,b\n1,2\n", "no catalogue, expected '# lsm-catalogue 1'"), ("", "no catalogue"),
    (CATALOGUE.replace("catalogue 1", "catalogue 2"), "format 'lsm-catalogue 2', expected 'lsm-catalogue 1'"),
    ("# lsm-catalogue 1\n# model = lsm\n", "no line of columns"), (CATALOGUE.replace("0.25", "x"), r":5: '1,0.5.*', expected 9 numbers"),
    (CATALOGUE.replace("\n3,", "\n1,"), ":6: event_id 1 after 1, expected increasing event_id"),
    (CATALOGUE.replace(",8\n", "\n"), r":6: .*expected 9 numbers"), (NAN, ":5: '.*', expected 9 numbers"),
    (CATALOGUE.replace("3,2,3,20", "3,2,3,99999999999999999999"), ":6: '.*', expected 9 numbers"),
    (CATALOGUE.replace("new_one", "size"), ":4: column 'size' is there 2 times, expected each once$"))]  # yapf: disable
NONE += [(lsm.read_series, raw, said) for raw, said in (
    (b"", ": no PE series, expected 'lsm-pe-series-1'"), (binary(b"lsm-slip-hist-1\n", b"# bins = 1\n", b""), ": no PE series"),
    (SERIES + (1000).to_bytes(8, "little") + b"# dt = 1\n", "the header is not complete"),
    (binary(SERIES, b"# dt = x\n# step0 = 0\n# time0 = 0\n", b""), "parameter 'dt' is 'x', expected a number"),
    (binary(SERIES, b"# dt = 1\n", b""), "parameter 'step0' is missing"),
    (binary(SERIES, b"# times = own\n", bytes.fromhex("01") + bytes(47)), "record 2: step 0 after step 1, expected increasing steps"),
    (b"\x28\xb5\x2f\xfd...", "compressed by zstd, expected gzip, xz or a file that is not compressed"),
    (b"\xfd7zXZ\0broken", "cannot be decompressed"))]  # yapf: disable


@pytest.mark.parametrize("read, raw, said", NONE)
def test_files_that_are_none(work, read, raw, said):
    (work / "a.bin").write_bytes(raw)
    with pytest.raises(ValueError, match=r"^a\.bin.*" + said):
        read("a.bin")


def test_lenient_reading_leaves_bad_lines_out(work):
    (work / "a.csv").write_text(NAN)
    assert len(lsm.read_catalogue("a.csv", lenient=True)) == 1


def test_a_damaged_file_is_named(work):
    packed = gzip.compress(10 * CATALOGUE.encode())
    for at in range(10, len(packed), 7):
        (work / "damaged.csv.gz").write_bytes(packed[:at] + bytes([packed[at] ^ 0x10]) + packed[at + 1:])
        with pytest.raises(ValueError, match="damaged.csv.gz: "):
            lsm.read_catalogue("damaged.csv.gz")


def test_slip_of_a_run_begins_with_an_empty_record(work):
    """As each run that goes on after another does; zeros after a power failure are no record."""
    kind = [("step_begin", "<i8"), ("step_end", "<i8"), ("pe", "<f8"), ("slip", "<f4"), ("work", "<f4"), ("stress", "<f4")]
    records = np.array([(40, 40, 1, 0, 0, 0), (40, 60, 1, 1, 1, 1), (60, 80, 1, 1, 1, 1)], kind)
    (work / "a.bin").write_bytes(binary(b"lsm-slip-hist-1\n", b"# bins = 1\n", records.tobytes()))
    assert lsm.read_slip("a.bin")["step_end"].tolist() == [40, 60, 80]
    (work / "a.bin").write_bytes(binary(b"lsm-slip-hist-1\n", b"# bins = 1\n", records.tobytes() + bytes(36)))
    with pytest.raises(ValueError, match="record 4: step 0 after step 60"):
        lsm.read_slip("a.bin")


def test_postproc_picks_a_series_of_ones_own(postproc):
    """Every 0.25 time units from 100 on, with times rounded as in a log."""
    stress, time = loading_with_drops(), 100 + 0.25 * np.arange(5000)
    lsm.write_series("a.bin", np.round(25 * time) / 25, stress, length=40, sample="glass 7")
    found = lsm.read_series("a.bin")
    assert found["pe"].tolist() == stress.tolist() and np.allclose(found["time"], time, rtol=1e-4) and found["step"][-1] == 4999
    assert found.header["length"] == "40" and found.header["sample"] == "glass 7"
    lsm.write_series("a.bin", time, stress, overwrite=True)
    assert "length" not in lsm.read_series("a.bin").header
    run(postproc, "pick a.bin -o a.csv --memory-time 2.5")
    wanted = pick("exponential", np.exp(-0.1), 0, np.arange(5000), time, stress)
    assert len(wanted) > 40 and np.allclose(numbers("a.csv"), wanted, rtol=1e-12)


UP = np.arange(3.0)


@pytest.mark.parametrize("time, values, more, said", [
    (UP, UP[:2], {}, "3 times and 2 values, expected as many"), (UP[:1], UP[:1], {}, "1 time, expected at least 2"),
    (UP, np.ones((3, 1)), {}, r"values of shape \(3, 1\), expected one row"), (UP, [1, np.nan, 2], {}, "value 2 is nan, expected a finite number"),
    ([0, np.inf, 2], UP, {}, "time 2 is inf, expected a finite number"), (UP[::-1], UP, {}, "time 2 is 1 after 2, expected increasing times"),
    ([0, 1, 2.6], UP, {}, "time 2 is 1, expected 1.3: samples at equal intervals"), (UP, ["a", "b", "c"], {}, "expected numbers"),
    (UP, UP, {"dt": 3}, "parameter 'dt', expected another name"), (UP, UP, {"a=b": 3}, "parameter 'a=b', expected"),
    (UP, UP, {"length": "1\n2"}, r"parameter 'length' is '1\\n2', expected one line")])  # yapf: disable
def test_series_that_cannot_be_written(work, time, values, more, said):
    with pytest.raises(ValueError, match=f"^a.bin: .*{said}"):
        lsm.write_series("a.bin", time, values, **more)
    assert not list(work.iterdir())


def test_no_file_is_replaced_by_a_series(work):
    (work / "a.bin").write_text("precious")
    with pytest.raises(FileExistsError, match="a.bin"):
        lsm.write_series("a.bin", UP, UP)
    with pytest.raises(ValueError, match="a.bin: "):
        lsm.write_series("a.bin", UP, UP[:2], overwrite=True)
    assert (work / "a.bin").read_text() == "precious"


def series_of(pe, spacing=0.5):
    made = np.empty(len(pe), [("step", "<i8"), ("time", "<f8"), ("pe", "<f8")])
    made["step"], made["time"], made["pe"] = np.arange(len(pe)), spacing * np.arange(len(pe)), pe
    return lsm.Table(made, {"model": "lsm"})


def test_spectrum_of_a_sine():
    """Amplitude 2 and a period of 25.6 samples of 0.5: variance 2, frequency 1/12.8."""
    series = series_of(5 + 2 * np.sin(2 * np.pi * np.arange(4096) / 25.6))
    found = lsm.spectrum(series, 1024)
    assert found["frequency"][np.argmax(found["density"])] == pytest.approx(1 / 12.8, abs=1e-12) and found.header == series.header
    assert len(lsm.spectrum(series)) == 257, "an eighth of 4096"
    with pytest.raises(ValueError, match="segment of 8192 samples, expected from 8 to the 4096"):
        lsm.spectrum(series, 8192)
    with pytest.raises(ValueError, match="step 93 after step 91, expected a sample every 1 steps"):
        lsm.spectrum(np.delete(series, 92))


@pytest.mark.parametrize("n", [16, 15])
def test_spectrum_is_its_definition(n):
    """The transform as a sum; half-overlapping segments; trend off; both ends of even n unpaired."""
    pe, hop = np.random.default_rng(1).normal(size=40), n - n // 2
    time, window = np.arange(n), np.sin(np.pi * np.arange(n) / n)**2
    density = np.zeros(n // 2 + 1)
    starts = range(0, len(pe) - n + 1, hop)
    for start in starts:
        part = pe[start:start + n]
        part = (part - np.polyval(np.polyfit(time, part, 1), time)) * window
        for k in range(n // 2 + 1):
            both = 1 if k == 0 or 2 * k == n else 2
            density[k] += both * 0.5 * abs(np.sum(part * np.exp(-2j * np.pi * k * time / n)))**2 / np.sum(window**2) / len(starts)
    assert np.allclose(lsm.spectrum(series_of(pe), n)["density"], density, rtol=1e-10, atol=1e-14)


def test_spectrum_of_noise_has_the_scatter_of_its_errors():
    """Flat, 2 sigma^2 dt."""
    found = [lsm.spectrum(series_of(3 * np.random.default_rng(seed).normal(size=128 * 100)), 128)[5:-1] for seed in range(20)]
    densities, errors = (np.array([one[name] for one in found]) for name in ("density", "error"))
    assert densities.mean() == pytest.approx(9.0, rel=0.02)
    assert densities.std() == pytest.approx(errors.mean(), rel=0.05)


def test_rates():
    made = np.array([(0.3, 0.5), (0.55, 0.25), (1.1, 2.0)], [("t_start", "<f8"), ("size", "<f8")])
    found = lsm.rates(lsm.Table(made, {}), 0.1)
    assert found["time"][0] == pytest.approx(0.35), "0.3 begins a bin of 0.1, though 0.3 / 0.1 is below 3"
    assert found["events"].tolist() == [1, 0, 1, 0, 0, 0, 0, 0, 1] and found["released"].sum() == 2.75
    assert found["rate"][0] == pytest.approx(10) and found["release_rate"][-1] == pytest.approx(20)
    assert len(lsm.rates(lsm.Table(made[:0], {}), 0.1)) == 0


@pytest.fixture(scope="module")
def page_results(lmp, tmp_path_factory):
    """Runs the blocks of the page, which make a fault and read its files. Returns the folder of these."""
    folder = tmp_path_factory.mktemp("page")
    os.symlink(SOURCE / "inputs", folder / "inputs")
    if not (BUILD / "lib/liblammps.so").exists():
        pytest.skip("liblammps.so is not built")
    stress = loading_with_drops(20000)
    np.savetxt(folder / "shear.txt", np.column_stack([10 * np.arange(20000), stress]), header="Time-averaged data for fix shear\nTimeStep v_shear")
    code = "".join(re.findall(r"^```python\n(.*?)^```$", (SOURCE / "inputs/python.md").read_text(), re.S | re.M))
    code += """
import numpy as np
drop = dict(zip(series["step"], series["pe"]))
assert len(events) > 0 and len(series) > 3000 and len(ruptures) > 0 and (events["size"] > 0).all()
assert np.allclose([drop[a] - drop[b] for a, b in zip(events["step_start"], events["step_end"])], events["size"], rtol=1e-9, atol=1e-15)
assert history["step_end"].max() <= 3100 and slip.shape == (int(history.header["bins"]),) and slip.mean() > 0
assert (history["step_begin"][1:] == history["step_end"][:-1]).all() and velocity.shape == (len(history) - 1, slip.size)
assert rates["events"].sum() == len(events) and np.isclose(rates["released"].sum(), events["size"].sum())
assert quakes["time"][0] >= np.datetime64("2000-01-01") and np.allclose(10**(1.5 * quakes["magnitude"] + 9.1), moment)
assert len(lsm.read_series("shear.bin")) == 20000 and len(spectrum) == 257 and (spectrum["density"] > 0).all()
"""
    (folder / "page.py").write_text(code)
    ran = subprocess.run([sys.executable, "page.py"], cwd=folder, env={**lmp.env, "PYTHONPATH": str(BUILD / "python")}, capture_output=True,
                         text=True)
    assert ran.returncode == 0, ran.stderr + ran.stdout
    return folder


def test_the_code_of_the_page(page_results):
    assert (page_results / "fault.slip.bin").exists()


def test_the_notebook(page_results, work):
    for name in ("catalogue.csv", "pe.bin", "slip.bin"):
        os.symlink(page_results / f"fault.{name}", work / f"first.{name}")
    notebook = json.loads((SOURCE / "python/first-catalogue.ipynb").read_text())
    assert notebook["nbformat"] == 4 and not any(cell.get("outputs") for cell in notebook["cells"])
    cells = ["".join(cell["source"]) for cell in notebook["cells"] if cell["cell_type"] == "code"]
    (work / "cells.py").write_text("\n".join(cells))
    ran = subprocess.run([sys.executable, "cells.py"], capture_output=True, text=True,
                         env={**os.environ, "PYTHONPATH": str(BUILD / "python"), "LSM_RESULTS": str(work), "MPLBACKEND": "agg"})
    assert ran.returncode == 0, ran.stderr
    size, drop = re.search(r"size (\S+), drop of PE (\S+)", ran.stdout).groups()
    assert size == drop and re.search(r"events >= 0.0001: exponent \d", ran.stdout), ran.stdout
