#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""publish.py and superpose.py on PE and catalogue of two short faults.

publish_test.py SOURCE_DIR LMP POSTPROC
"""
import array
import lzma
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

SOURCE, LMP, POSTPROC = sys.argv[1:4]
sys.path.insert(0, f"{SOURCE}/inputs/studies")
import publish  # noqa: E402
import superpose  # noqa: E402


def lines_of(path):
    with (lzma.open if str(path).endswith(".xz") else open)(path, "rt") as lines:
        return list(lines)


def rows(path):
    return [line for line in lines_of(path) if line[0] not in "#e"]


def header(path):
    return dict(line[2:].rstrip("\n").split(" = ", 1) for line in lines_of(path) if " = " in line and line[0] == "#")


def picked(series, out, *words):
    subprocess.run([POSTPROC, "pick", series, "-o", out, "--force", *words], check=True, stdout=subprocess.DEVNULL)
    return [line.split(",")[:6] for line in rows(out)]


class Published(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.work = Path(tempfile.mkdtemp())
        cls.faults = []
        for seed in ("1", "2"):
            folder = cls.work / f"fault_24_{seed}"
            folder.mkdir()
            subprocess.run([LMP, "-in", f"{SOURCE}/inputs/fault.in", "-log", "none", "-var", "prefix", "fault", "-var", "length", "24", "-var",
                            "seed", seed, "-var", "settle", "400", "-var", "velocity", "0.005", "-var", "steps", "3000", "-var", "ruptures", "yes",
                            "-var", "history", "no"], cwd=folder, check=True, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL)
            cls.faults.append(folder)

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.work)

    def test_small_events_are_left_out_and_the_header_says_so(self):
        source = self.faults[0] / "fault.catalogue.csv"
        sizes = sorted(float(line.split(",")[5]) for line in rows(source))
        self.assertGreater(len(sizes), 4)
        publish.main(self.work / "out", self.faults)
        for name, least in (("catalogue", publish.EVENTS), ("ruptures", publish.RUPTURES)):
            out = self.work / f"out/fault_24_1.{name}.csv.xz"
            wanted = [line for line in rows(self.faults[0] / f"fault.{name}.csv") if float(line.split(",")[5]) >= least]
            self.assertTrue(wanted)
            self.assertEqual(rows(out), wanted)
            self.assertEqual(header(out)["thinned"], f"sizes below {least:g} left out")
        subprocess.run([f"{SOURCE}/inputs/studies/publish.py", "--ruptures", "0.01", self.work / "out", self.faults[0]], check=True)
        self.assertEqual(header(self.work / "out/fault_24_1.ruptures.csv.xz")["min_size"], "0.01")
        publish.publish(source, self.work / "half.xz", sizes[len(sizes) // 2])
        self.assertEqual(len(rows(self.work / "half.xz")), len(sizes) - len(sizes) // 2)

    def test_catalogues_of_long_faults_are_complete_from_larger_sizes_only(self):
        for length, given, wanted in (("120", "1e-4", "1e-4"), ("240", "1e-4", "1e-4"), ("480", "1e-4", "3e-4"), ("960", "1e-4", "1e-3"),
                                      ("1890", "1e-4", "1e-3"), ("480", "1e-3", "1e-3")):
            text = (self.faults[0] / "fault.catalogue.csv").read_text()
            path = self.work / "long.csv"
            path.write_text(text.replace("# length = 24\n", f"# length = {length}\n").replace("# completeness = 1e-4\n", f"# completeness = {given}\n"))
            publish.publish(path, self.work / "long.xz")
            self.assertEqual(header(self.work / "long.xz")["completeness"], wanted)

    def test_series_add_up_sample_by_sample(self):
        series = [next(folder.glob("*.pe.bin")) for folder in self.faults]
        begin, end = 100.0, 300.0
        superpose.main([str(self.work / "sum.pe.bin"), *(word for path in series for word in (str(path), str(begin), str(end)))])
        info, first, total = superpose.read(self.work / "sum.pe.bin")
        self.assertEqual((info["length"], info["superposed"], first), ("48", "2", 0))
        parts = [superpose.stretch(path, begin, end)[1] for path in series]
        self.assertEqual(len(total), round((end - begin) / 0.12))
        self.assertEqual(total, array.array("d", [a + b for a, b in zip(*parts)]))
        self.assertTrue(picked(self.work / "sum.pe.bin", self.work / "sum.csv"))

    def test_one_stretch_picks_to_the_events_of_the_run(self):
        series = next(self.faults[0].glob("*.pe.bin"))
        info, first, pe = superpose.read(series)
        begin = float(info["time0"]) + (first - int(info["step0"])) * float(info["dt"])
        superpose.main([str(self.work / "one.pe.bin"), str(series), str(begin), str(begin + len(pe) * float(info["dt"]))])
        mine = picked(self.work / "one.pe.bin", self.work / "one.csv")
        run = [line.split(",") for line in rows(self.faults[0] / "fault.catalogue.csv")]
        self.assertEqual([row[5] for row in mine], [row[5] for row in run])
        self.assertEqual([int(row[3]) for row in mine], [int(row[3]) - first for row in run])

    def test_load_is_a_slope(self):
        series = next(self.faults[0].glob("*.pe.bin"))
        superpose.superpose(self.work / "load.pe.bin", [(series, 100.0, 300.0)], load=0.5, number=3)
        info, _, pe = superpose.read(self.work / "load.pe.bin")
        self.assertEqual(info["length"], "72")
        for n, (plain, loaded) in enumerate(zip(superpose.stretch(series, 100.0, 300.0)[1], pe)):
            self.assertAlmostEqual(loaded - plain, 0.5 * 0.12 * n, places=12)

    def test_every_second_step_keeps_times_and_memory(self):
        series = next(self.faults[0].glob("*.pe.bin"))
        superpose.main(["every", "2", str(self.work / "second.pe.bin"), str(series)])
        (info, first, pe), (other, _, halved) = superpose.read(series), superpose.read(self.work / "second.pe.bin")
        self.assertEqual(halved, pe[::2])
        self.assertAlmostEqual(float(other["dt"]), 2 * float(info["dt"]))
        self.assertAlmostEqual(float(other["lambda"]), float(info["lambda"]) ** 2)
        self.assertAlmostEqual(float(other["time0"]), float(info["time0"]) + (first - int(info["step0"])) * float(info["dt"]))
        shutil.copytree(self.faults[0], self.work / "fault_24_step_5")
        superpose.main(["second", POSTPROC, str(self.work), str(self.faults[0]), str(self.work / "fault_24_step_5")])
        self.assertEqual(rows(self.work / "fault_24_every_5.catalogue.csv.xz"), rows(self.work / "fault_24_every_1.catalogue.csv.xz"))
        wanted = [row for row in picked(self.work / "second.pe.bin", self.work / "second.csv") if float(row[5]) >= publish.EVENTS]
        self.assertTrue(wanted)
        self.assertEqual([line.split(",")[:6] for line in rows(self.work / "fault_24_every_1.catalogue.csv.xz")], wanted)

    def test_another_memory(self):
        superpose.main(["memory", "4", POSTPROC, str(self.work / "longer"), *map(str, self.faults)])
        for folder in self.faults:
            picked(next(folder.glob("*.pe.bin")), self.work / "plain.csv")
            wanted = picked(next(folder.glob("*.pe.bin")), self.work / "four.csv", "--memory-time", "4")
            seed = folder.name[-1]
            found = rows(self.work / f"longer/memory_24_4_{seed}.catalogue.csv.xz")
            self.assertEqual([line.split(",")[:6] for line in found], [row for row in wanted if float(row[5]) >= publish.EVENTS])
            self.assertNotEqual(found[0].split(",")[1], rows(self.work / "plain.csv")[0].split(",")[1])

    def test_the_study_takes_the_first_stretches_of_all_runs_first(self):
        with mock.patch.multiple(superpose, LOADING=60, DURATION=150, NUMBERS=(2,), GROUPS=2):
            found = superpose.stretches(self.faults)
            self.assertEqual([(path.parent.name[-1], begin) for path, begin, _ in found], [("1", 60), ("2", 60), ("1", 210), ("2", 210)])
            superpose.main(["study", POSTPROC, str(self.work / "study"), *map(str, self.faults)])
            self.assertEqual(sorted(path.name.split(".")[0] for path in (self.work / "study").iterdir()),
                             ["load_48_1", "load_48_2", "sum_48_1", "sum_48_2"])
            superpose.superpose(self.work / "sum2.pe.bin", found[2:])
            wanted = [row for row in picked(self.work / "sum2.pe.bin", self.work / "sum2.csv") if float(row[5]) >= publish.EVENTS]
            self.assertEqual([line.split(",")[:6] for line in rows(self.work / "study/sum_48_2.catalogue.csv.xz")], wanted)
            load = superpose.loading(*found[0])
            self.assertEqual(float(header(self.work / "study/load_48_1.catalogue.csv.xz")["load"]), float(f"{load:.6g}"))

    def test_what_is_no_series_is_refused(self):
        series = str(next(self.faults[0].glob("*.pe.bin")))
        for words, said in (([str(self.faults[0] / "fault.catalogue.csv"), "100", "300"], "expected a binary PE series"),
                            ([series, "100", "9000"], "no time from 100 to 9000"),
                            ([series, "100", "300", series, "100", "200"], "expected 1667 of 0.12")):
            with self.assertRaisesRegex(superpose.SeriesError, said):
                superpose.main([str(self.work / "bad.pe.bin"), *words])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
