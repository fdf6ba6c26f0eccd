#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""The page of postproc explore in a real browser: explore_browser_test.py POSTPROC SLIDER_CLI [LMP FAULT.IN [MPIRUN...]]

Makes a small run (of the fault if there is an lmp, with ruptures and slip history; of the block-slider else), opens its
page in a headless Chromium and does what a person does. Skips with the reason where there is no browser."""

import csv
import datetime
import json
import math
import os
import pathlib
import shlex
import random
import shutil
import struct
import subprocess
import sys
import tempfile
import time
import unittest

try:
    from selenium import webdriver
    from selenium.webdriver.chrome.service import Service
    from selenium.webdriver.common.action_chains import ActionChains
    from selenium.webdriver.common.by import By
    from selenium.webdriver.common.keys import Keys
except ImportError:
    print("skipped: no selenium (Debian package python3-selenium)")
    sys.exit(77)
browser, chromedriver = shutil.which("chromium"), shutil.which("chromedriver")
if not browser or not chromedriver:
    print("skipped: no chromium or chromedriver (Debian packages chromium and chromium-driver)")
    sys.exit(77)

postproc, slider, fault = sys.argv[1], sys.argv[2], sys.argv[3:]
HOSTILE = "</script><script>window.harm = 1</script><img src=x onerror='window.harm = 2'>&amp;\"'"


def run(*command):
    done = subprocess.run(command, capture_output=True, text=True, stdin=subprocess.DEVNULL)
    if done.returncode != 0:
        raise AssertionError(f"{' '.join(command)}: {done.stdout[-2000:]}{done.stderr[-2000:]}")
    return done.stdout


def catalogue(path):
    with open(path) as lines:
        rows = list(csv.DictReader(line for line in lines if not line.startswith("#")))
    return [{name: float(value) for name, value in row.items()} for row in rows]


def pe_series(path):
    with open(path, "rb") as file:
        raw = file.read()
    begin = 24 + int.from_bytes(raw[16:24], "little")
    samples = list(struct.iter_unpack("<qd", raw[begin:]))
    return [step for step, _ in samples], [pe for _, pe in samples]


def add_header(path, line):
    with open(path) as file:
        text = file.read()
    with open(path, "w") as out:
        out.write(text.replace("\nevent_id,", f"\n# {line}\nevent_id,", 1))


def earthquakes(path):
    """400 earthquakes of the Gutenberg-Richter law, a day from one to the next."""
    with open(path, "w") as out:
        out.write("time,latitude,longitude,mag\n")
        for k in range(400):
            day = datetime.date(1990, 1, 1) + datetime.timedelta(days=k)
            out.write(f"{day}T00:00:00Z,35,-117,{2 - math.log10((k * 149 % 400 + 0.5) / 400):.1f}\n")


class Page(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        os.chdir(cls.folder.name)
        if fault:
            lmp, scene, *launcher = fault
            # With stiff contacts and plates that absorb waves, almost all slip is in ruptures; soft contacts
            # also slip slowly between them.
            values = "preset absorbing stress 0.02 viscosity 0.015 kt 1 impedance 0.6 contacts fault".split()
            changed = [word for name, value in zip(values[::2], values[1::2]) for word in ("-var", name, value)]
            run(*launcher, lmp, "-in", scene, "-log", "none", "-var", "length", "30", "-var", "seed", "3", "-var", "steps", "50000", *changed, "-var",
                "ruptures", "yes", "-var", "prefix", "run")
        else:
            run(slider, "--blocks", "256", "--steps", "600000", "--catalogue", "run.catalogue.csv", "--pe-series", "run.pe.bin")
        run(slider, "--blocks", "128", "--steps", "600000", "--catalogue", "other.csv")
        add_header("run.catalogue.csv", f"note = {HOSTILE}")
        ruptures = []
        if fault:
            subprocess.run([sys.executable, "-m", "lsm.sources", "run.ruptures.csv", "--no-picture"], check=True, stdout=subprocess.DEVNULL,
                           env={**os.environ, "PYTHONPATH": str(pathlib.Path(fault[1]).parents[1] / "python")})
            ruptures = ["--ruptures", "run.sources.csv"]
        run(postproc, "explore", "run.catalogue.csv", *ruptures, "-o", "page.html", "--title", HOSTILE)
        earthquakes("quakes.csv")
        run(postproc, "explore", "quakes.csv", "-o", "quakes.html")
        run(postproc, "explore", "run.catalogue.csv", "other.csv", "--label", HOSTILE, "--label", "slider", "-o", "two.html")
        cls.events = catalogue("run.catalogue.csv")
        cls.largest = max(cls.events, key=lambda event: event["size"])

        options = webdriver.ChromeOptions()
        options.binary_location = browser
        for flag in ("--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking",
                     "--disable-component-update", "--disable-sync", "--disable-dev-shm-usage", "--window-size=1400,1000",
                     f"--user-data-dir={cls.folder.name}/browser"):
            options.add_argument(flag)
        options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
        cls.driver = webdriver.Chrome(service=Service(chromedriver), options=options)
        cls.driver.set_script_timeout(60)

    @classmethod
    def tearDownClass(cls):
        cls.driver.quit()
        os.chdir("/")
        cls.folder.cleanup()

    def setUp(self):
        self.open("page.html")

    def open(self, page):
        for log in ("browser", "performance"):
            self.driver.get_log(log)
        self.address = f"file://{self.folder.name}/{page}"
        self.driver.get(self.address)
        self.wait("return document.body.dataset.state === 'ready'")
        self.settle()

    def tearDown(self):
        errors = [line["message"] for line in self.driver.get_log("browser") if line["level"] in ("SEVERE", "WARNING")]
        # dygraphs 2.2 reports points outside of a picture, as after a zoom.
        errors = [message for message in errors if "points out of Y bounds" not in message]
        self.assertEqual(errors, [])
        requests = [json.loads(line["message"])["message"] for line in self.driver.get_log("performance")]
        # Only the requests of this page count, as the browser opens pages of its own.
        addresses = {
            message["params"]["request"]["url"]
            for message in requests if message["method"] == "Network.requestWillBeSent" and message["params"]["documentURL"] == self.address
        }
        # Pictures embedded in the page have addresses, too.
        self.assertEqual({address for address in addresses if not address.startswith("data:")}, {self.address})
        self.assertIsNone(self.js("return window.harm"))

    def js(self, script, *arguments):
        return self.driver.execute_script(script, *arguments)

    def wait(self, script, *arguments):
        for _ in range(300):
            if self.js(script, *arguments):
                return
            time.sleep(0.1)
        self.fail(f"never came true: {script}; the page says: {self.text('#summary')}")

    def settle(self):
        """Waits until what is due for the next frame has been drawn, and what that requests in turn."""
        self.driver.execute_async_script(
            "const done = arguments[0]; requestAnimationFrame(() => requestAnimationFrame(() => requestAnimationFrame(done)))")

    def one(self, selector):
        return self.driver.find_element(By.CSS_SELECTOR, selector)

    def text(self, selector):
        return self.one(selector).text

    def number(self, column):
        return float(self.one(f"#event-numbers [data-column={column}]").get_attribute("data-value"))

    def click(self, selector):
        element = self.one(selector)
        self.js("arguments[0].scrollIntoView({block: 'center'})", element)
        element.click()
        self.settle()

    def window(self):
        return self.js("return (app.view.peGraph || app.view.sizeGraph).xAxisRange()")

    def shown_ids(self):
        return [int(cell.text) for cell in self.driver.find_elements(By.CSS_SELECTOR, "#rows tbody tr td:first-child")]

    def fill(self, selector, text):
        element = self.one(selector)
        element.clear()
        element.send_keys(text)
        self.settle()

    # -- user actions

    def test_events_are_chosen_and_zoomed_to(self):
        for column in ("size", "t_start", "t_end", "pe_start", "pe_end", "step_start"):
            self.assertEqual(self.number(column), self.largest[column])
        self.assertIn(str(len(self.events)), self.text("#summary"))
        self.assertEqual(self.one("#event-slip").is_displayed(), bool(fault))
        begin, end = self.window()
        self.click("#zoom-event")
        left, right = self.window()
        self.assertLess(left, self.largest["t_start"])
        self.assertGreater(right, self.largest["t_end"])
        self.assertLess(right - left, max(5 * (self.largest["t_end"] - self.largest["t_start"]), 0.05 * (end - begin)))
        self.click("#whole-run")
        self.assertEqual(self.window(), [begin, end])
        third = sorted(self.events, key=lambda event: -event["size"])[2]
        self.click("#rows tbody tr:nth-child(3) td")
        self.assertEqual(self.number("size"), third["size"])
        left, right = self.window()
        self.assertTrue(left < third["t_start"] and third["t_end"] < right)
        row = self.one("#rows tbody tr:nth-child(3)")
        self.assertEqual(row.get_attribute("aria-selected"), "true")

    def test_a_click_in_the_picture_chooses_the_event(self):
        second = sorted(self.events, key=lambda event: -event["size"])[1]
        self.js("app.view.show(arguments[0] - 20, arguments[1] + 20)", second["t_start"], second["t_end"])
        self.settle()
        graph = self.one(".pe")
        self.js("arguments[0].scrollIntoView({block: 'center'})", graph)
        x = self.js("return app.view.peGraph.toDomXCoord(arguments[0])", (second["t_start"] + second["t_end"]) / 2)
        box = graph.rect
        ActionChains(self.driver).move_to_element_with_offset(graph, round(x - box["width"] / 2), 0).click().perform()
        self.settle()
        self.assertEqual(self.number("size"), second["size"])
        self.assertIn(str(int(second["event_id"])), self.text("#event-head"))

    def test_mouse_and_keys_zoom(self):
        graph = self.one(".pe")
        self.js("arguments[0].scrollIntoView({block: 'center'})", graph)
        before = self.window()
        ActionChains(self.driver).move_to_element(graph).click_and_hold().move_by_offset(200, 0).release().perform()
        self.settle()
        after = self.window()
        self.assertLess(after[1] - after[0], 0.5 * (before[1] - before[0]))
        # Zoomed to single steps, every sample of the file is shown.
        self.js("app.view.show(arguments[0], arguments[0])", self.largest["t_start"])
        self.settle()
        data = self.js("const [from, to] = app.view.window; return app.view.peData().filter(p => p[0] >= from && p[0] <= to)")
        self.assertIn(len(data), (2, 3))
        self.click("#whole-run")
        self.js("app.choose(app.run, app.eventsOf(app.run).bySize[0])")
        frame = self.one(".graphs")
        self.js("arguments[0].focus()", frame)
        begin, end = self.window()
        frame.send_keys("+")
        self.settle()
        left, right = self.window()
        self.assertAlmostEqual((right - left) / (end - begin), 0.5, places=6)
        frame.send_keys(Keys.ARROW_RIGHT)
        self.settle()
        self.assertGreater(self.window()[0], left)
        frame.send_keys("0")
        self.settle()
        self.assertEqual(self.window(), [begin, end])
        frame.send_keys("n")
        self.settle()
        order = sorted(self.events, key=lambda event: event["t_start"])
        following = order[min(order.index(self.largest) + 1, len(order) - 1)]
        self.assertEqual(self.number("t_start"), following["t_start"])

    def test_series_is_the_one_of_the_file_and_no_drop_is_lost(self):
        steps, pe = pe_series("run.pe.bin")
        self.assertEqual(self.js("return app.runs[0].series.length"), len(pe))
        values = self.js("return Array.from(app.runs[0].series.values)")
        self.assertEqual(self.js("return app.runs[0].series.step(7)"), steps[7])
        bends = [0, 0] + [abs(pe[i] - 2 * pe[i - 1] + pe[i - 2]) for i in range(2, len(pe))]
        rounding = 1e-14 * max(abs(x) for x in pe)
        for i, (value, true) in enumerate(zip(values, pe)):
            self.assertLessEqual(abs(value - true), 0.5 * max(bends[max(0, i - 12):i + 1]) + rounding, i)
        chance = random.Random(1)
        windows = [sorted(chance.sample(range(len(values)), 2)) for _ in range(300)] + [[0, len(values)]]
        found = self.js("return arguments[0].map(([from, to]) => app.runs[0].series.extremes(from, to))", windows)
        for (first, last), extremes in zip(windows, found):
            self.assertEqual(extremes, [min(values[first:last]), max(values[first:last])])
        # The same holds for the drawing, in a picture of few pixels.
        for first, last in windows[:40]:
            drawn = self.js("const s = app.runs[0].series; return s.points(s.time(arguments[0]), s.time(arguments[1]), 50).map(p => p[1])", first,
                            last - 1)
            inside = values[first:last]
            self.assertLessEqual(min(drawn), min(inside))
            self.assertGreaterEqual(max(drawn), max(inside))

    def test_table_sorts(self):
        by_size = [int(event["event_id"]) for event in sorted(self.events, key=lambda event: -event["size"])]
        self.assertEqual(self.shown_ids(), by_size[:100])
        self.click("[data-sort=t_start]")
        by_time = [int(event["event_id"]) for event in sorted(self.events, key=lambda event: event["t_start"])]
        self.assertEqual(self.shown_ids(), by_time[:100])
        self.click("[data-sort=t_start]")
        self.assertEqual(self.shown_ids(), by_time[::-1][:100])
        self.assertEqual(self.one("[data-sort=t_start]").find_element(By.XPATH, "..").get_attribute("aria-sort"), "descending")

    def test_table_filters(self):
        sizes = sorted(event["size"] for event in self.events)
        least, middle = sizes[len(sizes) // 2], (self.events[0]["t_start"] + self.events[-1]["t_start"]) / 2
        self.fill("#size-from", repr(least))
        self.fill("#time-to", repr(middle))
        left = [event for event in self.events if event["size"] >= least and event["t_start"] <= middle]
        self.assertTrue(0 < len(left) < len(self.events))
        self.assertIn(f"{len(left)} of {len(self.events)} events", self.text("#table-count"))
        self.assertEqual(set(self.shown_ids()), {int(event["event_id"]) for event in sorted(left, key=lambda event: -event["size"])[:100]})
        self.fill("#size-from", "many")
        self.assertEqual(self.one("#size-from").get_attribute("aria-invalid"), "true")
        self.click("#filters [type=reset]")
        self.wait("return document.getElementById('table-count').textContent.startsWith(arguments[0])", f"{len(self.events)} of")
        self.click("#zoom-event")
        self.click("#in-view")
        self.settle()
        left, right = self.window()
        self.assertIn(int(self.largest["event_id"]), self.shown_ids())
        for event in self.events:
            if int(event["event_id"]) in self.shown_ids():
                self.assertTrue(left <= event["t_start"] <= right)

    def threshold_agrees(self):
        """The numbers in the table are those of the page, and these are what the commands find."""
        size, page = self.js("return [app.threshold, app.statistics.at(app.statistics.entries[0])]")
        shown = {cell.get_attribute("data-name"): cell.text.split(" (")[0] for cell in self.driver.find_elements(By.CSS_SELECTOR, "#statistics td")}
        law, times = (json.loads(
            run(postproc, *command.split(), "run.catalogue.csv", "--threshold", repr(size), "--replicas", "0", "--no-picture", "-o",
                command.split()[0], "--json", "-")) for command in ("fit --no-comparison", "intervals"))
        self.assertEqual(int(shown["events"]), sum(event["size"] >= size for event in self.events))
        for name in "mean", "variation":
            self.assertEqual(page[name], times["times"][0][name])
            self.assertEqual(shown[name], page[f"{name}Text"])
        ours = {fit["method"]: fit["gamma"] for fit in times["fits"]}
        held = {fit["method"]: fit for fit in page["gammas"] if fit["deltaHeld"]}
        likely, least = held["maximum likelihood"], held["least squares"]
        for name, here, there in (("exponent", page["law"], law["fits"][0].get("exponent")), ("gamma", likely, ours["maximum likelihood, δ = 1 held"]),
                                  ("gamma-least-squares", least, ours["least squares, δ = 1 held"])):  # yapf: disable
            self.assertEqual(here.get("value"), there)
            self.assertEqual(shown[name], here.get("text", "–"))
        return size

    def test_threshold_that_is_dragged(self):
        usual = self.threshold_agrees()
        slider_ = self.one("#threshold")
        slider_.send_keys(Keys.END)
        self.settle()
        first = self.threshold_agrees()
        self.assertGreaterEqual(first, usual)
        graph = self.one("#exponents")
        self.js("arguments[0].scrollIntoView({block: 'center'})", graph)
        x = self.js("return Statistics.xOf(app.statistics.graphs.exponents, app.threshold)")
        actions = ActionChains(self.driver).move_to_element_with_offset(graph, round(x - graph.rect["width"] / 2), 0)
        actions.click_and_hold().move_by_offset(-60, 0).release().perform()
        self.settle()
        second = self.threshold_agrees()
        self.assertLess(second, first)
        slider_.send_keys(Keys.ARROW_LEFT)
        self.settle()
        self.assertLess(self.threshold_agrees(), second)
        self.click("#usual-threshold")
        self.assertEqual(self.js("return app.threshold"), usual)

    @unittest.skipUnless(fault, "no lmp: no ruptures and no slip history")
    def test_ruptures_and_their_slip(self):
        ruptures = catalogue("run.sources.csv")
        self.js("const kind = document.getElementById('kind'); kind.value = 'ruptures'; kind.dispatchEvent(new Event('change'))")
        self.settle()
        largest = max(ruptures, key=lambda event: event["size"])
        for column in ("size", "slip_moment", "rupture_length", "x_hypocentre", "mean_slip", "radiated_energy"):
            self.assertEqual(self.number(column), largest[column])
        self.assertTrue(self.one("#event-slip").is_displayed())
        # Slip along the fault, summed over its bins, is that of all ruptures of these times.
        slip = self.js("return app.runs[0].slip.slipBetween(arguments[0], arguments[1]).reduce((a, b) => a + b)", largest["t_start"],
                       largest["t_end"])
        inside = [r for r in ruptures if r["t_start"] >= largest["t_start"] and r["t_end"] <= largest["t_end"]]
        overlapping = [r for r in ruptures if r["t_end"] > largest["t_start"] and r["t_start"] < largest["t_end"]]
        total = lambda some: sum(r["mean_slip"] * r["rupture_length"] for r in some)
        self.assertGreater(slip, 0.97 * total(inside))
        self.assertLess(slip, 1.03 * total(overlapping) + 0.03 * total(inside))
        colours = self.js("const c = document.getElementById('slip-map'), d = c.getContext('2d').getImageData(0, 0, c.width, c.height).data;"
                          "const s = new Set(); for (let i = 0; i < d.length; i += 4) s.add(d[i] << 16 | d[i + 1] << 8 | d[i + 2]); return s.size")
        self.assertGreater(colours, 20)
        # What the mouse points at in both pictures of the slip.
        for picture, readout, text in ("#slip-map", "#slip-readout", "distance "), (".slip", ".view .readout", "time "):
            self.js("arguments[0].scrollIntoView({block: 'center'})", self.one(picture))
            ActionChains(self.driver).move_to_element(self.one(picture)).perform()
            self.assertRegex(self.text(readout), text + r".*: slip velocity \S+ of the driving velocity")

    def test_hostile_headers_stay_text(self):
        self.assertEqual(self.driver.title, HOSTILE)
        self.assertEqual(self.text("h1"), HOSTILE)
        self.assertIn(HOSTILE, [cell.get_attribute("textContent") for cell in self.driver.find_elements(By.CSS_SELECTOR, "#parameters td")])
        self.assertEqual(self.driver.find_elements(By.CSS_SELECTOR, "img[src=x]"), [])
        offered = self.js("return document.querySelector('#commands').textContent").splitlines()
        self.assertEqual([line.split()[1] for line in offered], ["fit", "intervals"])
        for line in offered:
            name, *words = shlex.split(line)
            self.assertEqual(name, "postproc")
            run(postproc, *words, "--no-picture", "--replicas", "0")

    def test_units_of_earthquakes(self):
        self.open("quakes.html")
        self.assertIn("400 earthquakes in 399 days", self.text("main, body"))
        labels = [label.text for label in self.driver.find_elements(By.CSS_SELECTOR, ".dygraph-xlabel")]
        self.assertEqual(labels.count("smallest size (10^(1.5 M))"), 3)
        self.assertIn("Time (days since 1970)", labels)
        for graph in "exponents", "gammas":  # without a line of the paper
            low, high = self.js(f"return app.statistics.graphs['{graph}'].yAxisRange()")
            self.assertLess(low, high)

    def test_two_runs(self):
        self.open("two.html")
        self.assertEqual(len(self.driver.find_elements(By.CSS_SELECTOR, ".view")), 2)
        self.assertEqual(self.text(".view h3"), HOSTILE)
        self.assertEqual(len(self.driver.find_elements(By.CSS_SELECTOR, "#statistics tbody tr")), 2)
        self.js("app.activate(app.views[1])")
        self.settle()
        other = max(catalogue("other.csv"), key=lambda event: event["size"])
        self.assertEqual(self.number("size"), other["size"])
        self.assertTrue(self.driver.find_elements(By.CSS_SELECTOR, "#parameters tr.differs"))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
