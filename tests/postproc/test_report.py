# SPDX-License-Identifier: GPL-2.0-or-later
"""The page of inputs/studies/report.py: complete, valid, made of what postproc prints and draws."""
import re
import sys
from pathlib import Path

import pytest
from data_files import power_law
from figure_data import fault, said, slider
from programs import INPUTS, Program, refused, run

pytestmark = pytest.mark.usefixtures("gnuplot")
QUICK = "--replicas 0 "
DROPS, RUPTURES = "Sizes are drops of the potential energy of the whole model", "Events are ruptures †: connected"


@pytest.fixture
def report(postproc):
    return Program("report.py", sys.executable, INPUTS / "studies/report.py", "--postproc", postproc.path)


@pytest.fixture
def do(report):
    return lambda *arguments, **more: run(report, *arguments, **more)


def test_report(do, report, postproc):
    fault("a<b&c.csv", power_law(1, 1e-3, 1, 500))
    slider("s.csv", power_law(1.2, 1e-2, 100, 500))
    do(["a<b&c.csv", "s.csv", "--label", 'x<y&"z"', "--label", "s", "--replicas", 5, "-o", "r.html"])
    page = said("r.html", "x&lt;y&amp;&quot;z&quot;", "Fig. 12", "Fig. 13", "Fig. 14", "Fig. 15", "Table 1", "15.21", "100.0", "0.0573", "1.07",
                DROPS, "smallest size, fault: 0.0001, that of the paper", "seed 1")
    assert page.count("<svg") == 8  # sizes, their scaling, times as they are and over their mean, of both models
    assert "x<y" not in page, "label let through"
    assert not re.search(r"(src|href)=.?(https?:|//)|@import|url\((https?:)?//", page), "the page asks for something outside it"
    assert "are ruptures" not in page and "{{" not in page
    # Identifiers are unique, and references lead to one of them.
    ids = re.findall(r""" id=['"]([^'"]*)""", page)
    assert ids and len(ids) == len(set(ids))
    assert set(re.findall(r"""href=['"]#([^'"]*)""", page)) <= set(ids)
    for tag in "table figure svg pre tr td th section div p ul li h2 h3".split():
        assert len(re.findall(f"<{tag}[ >]", page)) == page.count(f"</{tag}>"), f"<{tag}> not closed"
    # The numbers are those that the command prints.
    fitted = run(postproc, "fit s.csv --label s --seed 1 --replicas 5 --no-picture -o f").out
    found = [line for line in fitted.splitlines() if "+-" in line]
    assert found and all(line in page for line in found)
    # Without gnuplot an older page is kept.
    refused(report, "s.csv -o r.html", "gnuplot not found", env={"PATH": "/nonexistent"})


def test_kinds_of_events(do):
    """Each kind of events has its own text and section."""
    sizes = power_law(1, 1e-3, 1, 500)
    fault("a.csv", sizes)
    fault("r.csv", sizes, events="ruptures")
    do("r.csv", QUICK, "-o p.html")
    assert DROPS not in said("p.html", '<h2 id="model-1">Fault: ruptures</h2>', RUPTURES)
    do("r.csv a.csv", QUICK, "-o p.html")
    said("p.html", '<h2 id="model-1">Fault</h2>', '<a href="#model-2">Fault: ruptures</a>', '<h2 id="model-2">Fault: ruptures</h2>', DROPS, RUPTURES)


def test_scaling(do):
    """Four lengths have a picture of their characteristic sizes."""
    for length in 120, 240, 480, 960:
        fault(f"{length}.csv", power_law(1, 1e-3, length / 100, 500), length)
    do("120.csv 240.csv 480.csv 960.csv", QUICK, "-o p.html")
    said("p.html", "<title>Characteristic size against length</title>", "A L\\^D with D = |D = ")


def test_leaf_springs(do):
    """Sliders of several stiffnesses are models of their own."""
    for kl in 0.01, 0.1:
        slider(f"kl{kl}.csv", power_law(1.2, 1e-2, 100, 500), kl=kl)
    do("kl0.01.csv kl0.1.csv kl0.01.csv --replicas 0 --label a --label b --label c -o k.html")
    page = said("k.html", "Block-slider, k_l = 0.01</h2>", "Block-slider, k_l = 0.1</h2>", "<p>a; c</p>", "<p>b</p>")
    assert page.count("<h2 id=\"model-") == 2


def test_options_reach_the_commands(do, report):
    fault("a.csv", power_law(1, 1e-3, 1, 500))
    do("a.csv --threshold 0.1 --from 10 --replicas 0 -o t.html")
    said("t.html", "smallest size, fault: 0.1, as given")
    refused(report, "a.csv --threshold 0.1 --label x --label y", "--label given 2 times, expected once for each of 1 catalogues")
    refused(report, "a.csv --from x -o new.html", "--from 'x': expected a model time")
    refused(report, "a.csv a.csv a.csv --from 1 --from 2 -o new.html", "--from given 2 times, expected once, or once for each of 3 catalogues")


def test_catalogues_begin_at_times_of_their_own(do, report):
    """Each is read from its own time on, whatever its model and kind."""
    fault("a.csv", power_law(1, 1e-3, 1, 500))
    slider("s.csv", power_law(1.2, 1e-2, 100, 500))
    starts = [float(line.split(",")[1]) for line in Path("a.csv").read_text().splitlines() if line[0].isdigit()]
    begin = starts[200]
    do(f"a.csv s.csv --label a --label s --from {begin} --from 0 -o b.html", QUICK)
    counts = re.search("<pre>(.*?)</pre>", said("b.html"), re.S)[1]
    assert [re.search(rf"^ *{name} +.*?\b(\d+)\b", counts, re.M)[1] for name in "as"] == ["300", "500"], counts
    refused(report, f"a.csv s.csv --from {begin} --from x -o c.html", "--from 'x'")


def test_many_curves(do):
    """From the seventh on they have letters for points, as colours occur again."""
    count = 20
    for n in range(count):
        fault(f"{n}.csv", power_law(1, 1e-3, 1 + n, 300, seed=n))
    do([f"{n}.csv" for n in range(count)], QUICK, "-o m.html")
    page = said("m.html")
    for name in "sizes", "times":
        picture = re.search(
            f"<svg role[^>]*>(?:(?!</svg>).)*{dict(sizes='Densities of event sizes', times='Densities of inter-event times')[name]}.*?</svg>", page,
            re.S)[0]
        letters = {letter for letter in "ABCDEFGHIJKLMNOP" if re.search(rf">{letter}</tspan>|>{letter}</text>", picture)}
        assert letters == set("ABCDEFGHIJKLMN"), (name, letters)


def test_few_events(do):
    """Where there is nothing to draw or to fit, the page says why."""
    fault("none.csv", [])
    fault("few.csv", [0.01, 0.02, 0.01])
    do("none.csv few.csv", QUICK, "-o e.html")
    assert not re.search(">-?nan|>inf", said("e.html", "degenerate")), "NaN or infinity in the page"
    do("none.csv", QUICK, "-o e.html")
    said("e.html", 'class="bad">.*nothing to draw')


def test_files(do, report, work):
    fault("good.csv", [0.01, 0.02, 0.01])
    refused(report, "good.csv -o good.csv", "good.csv: is read by this program, expected another name")
    Path("new").mkdir()
    refused(report, "good.csv -o new", "new: is a directory, expected a file name")
    Path("mine.html").write_text("<p>mine</p>")
    refused(report, "good.csv -o mine.html", "mine.html exists and is no page of this program")
    refused(report, "nowhere.csv -o x.html", "nowhere.csv: cannot open")
    Path("bad.csv").write_text(Path("good.csv").read_text() + "broken\n")
    refused(report, "bad.csv -o x.html", "bad.csv:8")
    do("bad.csv --lenient -o x.html", QUICK)
    do("good.csv -o x.html", QUICK)


def test_labels(do):
    labels = ["'old' run", "'\"q\"", "`touch marker`", "a\\", "@a &b ~c ^{d}_e'"]
    fault("a.csv", power_law(1.2, 1e-3, 10, 300))
    do(["a.csv"] * len(labels) + [f"--label={label}" for label in labels], QUICK, "-o l.html")
    assert not Path("marker").exists(), "a label ran a command"
    text = Path("l.html").read_text()
    for name, sign in ("&lt;", "<"), ("&gt;", ">"), ("&quot;", '"'), ("&#x27;", "'"), ("&#39;", "'"), ("&amp;", "&"):
        text = text.replace(name, sign)
    for label in labels:
        assert text.count(label) > 4, label
