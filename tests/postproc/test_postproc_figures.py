# SPDX-License-Identifier: GPL-2.0-or-later
"""The commands of postproc that draw."""
import os
import re
from pathlib import Path

import numpy as np
import pytest
from data_files import edit, power_law, rows, table, write_catalogue, write_history, write_series
from programs import refused, run

pytestmark = pytest.mark.usefixtures("gnuplot")


@pytest.fixture
def do(postproc):
    return lambda *arguments, **more: run(postproc, *arguments, **more)


@pytest.fixture
def no(postproc):
    """no(pattern, arguments): expects that postproc refuses the arguments."""
    return lambda pattern, arguments: refused(postproc, arguments, pattern)


def pictures(*bases):
    """Asserts that all four files of each picture exist and are not empty."""
    for base in bases:
        for ending in "csv", "gp", "png", "svg":
            assert os.path.getsize(f"{base}.{ending}") > 0, f"{base}.{ending} is empty"


def fault(path, sizes, length=120, times=None, **head):
    n = len(sizes)
    write_catalogue(path, np.arange(n) * 10 if times is None else times, sizes, dict(model="lsm", **head, length=length))


def slider(path, sizes, **head):
    write_catalogue(path, np.arange(len(sizes)) * 10, sizes, dict(model="block-slider", **head, blocks=256))


def said(path, *patterns):
    """The text of a file, which must contain all these patterns."""
    text = Path(path).read_text()
    for pattern in patterns:
        assert re.search(pattern, text, re.M), f"no '{pattern}' in {path}"
    return text


def curve(path, number=1):
    """Rows of one curve, as dicts of numbers by column, counted from 1."""
    return [dict(enumerate(map(float_or_text, row.split(",")), 1)) for row in rows(path) if row.startswith(f"{number},")]


def float_or_text(cell):
    try:
        return float(cell)
    except ValueError:
        return cell


def count(path, number):
    return sum(row[7] for row in curve(path, number))


def ruptures(path="r.csv"):
    """Writes ruptures, one after the other, with a moment of 0.1 L^2 and drops of PE of 0.05 times the moment;
    two more overlap with the largest one."""
    i = np.arange(1, 40)
    lines = [(10 * n, 10 * n + 5, n, 0.005 * n * n) for n in i] + [(402, 404.5, 30, 0.4), (400, 405, 40, 8), (401, 405, 25, -0.2),
                                                                   (500, 505, 120, 72)]
    t, end, long, drop = np.array(lines, float).T
    moment, n = 0.1 * long**2, len(lines)
    write_catalogue(path, t, moment / 100, dict(model="lsm", length=120, events="ruptures"), t_end=end, pe_start=[100] * n, pe_end=100 - drop,
                    slip_moment=moment, x_centroid=[60] * n, rupture_length=long.astype(int), x_hypocentre=[60.5] * n, x_begin=[60] * n,
                    mean_slip=0.1 * long, stress_drop=[0.003] * n)


# ---- densities
def test_histograms(do, no):
    # 90 events are in the bin from 1e-3 to 10^-2.9, 10 in that from 1e-2 to 10^-1.9, and 7 are too small.
    fault("a.csv", [1.1e-3] * 90 + [1.1e-2] * 10 + [5e-5] * 7)
    slider("b.csv", power_law(1, 1e-3, 1, 1000))
    do("histograms a.csv b.csv --guide -1.07 --guide -1:1e-2:1e-1 -o h")
    pictures("h")
    found = curve("h.csv", 1)
    filled = [row for row in found if row[7] > 0]
    assert len(found) == 11 and len(filled) == 2
    for row, edge, events in zip(filled, (1e-3, 1e-2), (90, 10)):
        width = row[5] - row[4]
        assert row[7] == events and row[4] == pytest.approx(edge, rel=1e-9)
        assert row[8] == pytest.approx(row[7] / (100 * width), rel=1e-9) and row[9] == pytest.approx(row[7]**0.5 / (100 * width), rel=1e-9)
        assert row[5] / row[4] == pytest.approx(10**0.1, rel=1e-9)
    # Ten bins per decade over three decades, density 1 / (ln 1000 s), integral 1.
    found = curve("h.csv", 2)
    assert len(found) == 30 and sum(row[8] * (row[5] - row[4]) for row in found) == pytest.approx(1, abs=1e-9)
    for row in found:
        assert row[8] * row[6] * np.log(1000) == pytest.approx(1, abs=0.05)
    said("h.svg", r"fault, length 120 \(100 events\)", r"block-slider, N = 256 \(1000 events\)")
    do("histograms a.csv --threshold 0 -o c --no-picture")
    assert not Path("c.png").exists(), "--no-picture drew a picture"
    assert count("c.csv", 1) == 107
    no("expected SLOPE", "histograms a.csv --guide steep -o x")
    no("expected LO:HI", "histograms a.csv --range 3 -o x")
    no("nothing to draw", "histograms a.csv --threshold 1 -o x")


def test_intervals(do, no):
    # There are 100 times of 5, then 50 of 50.
    times = np.concatenate([[0], np.cumsum([5] * 100 + [50] * 50)])
    fault("a.csv", np.where(np.arange(151) % 2, 1, 2), times=times)
    first = do("intervals a.csv -o i")
    pictures("i", "i.rate", "i.conditional")

    # The cumulative number ends with all events; the first hundred times are a steady stretch on their own.
    def rates(path, kind):
        return [[float_or_text(cell) for cell in row.split(",")] for row in rows(path) if row.split(",")[1] == kind]

    assert rates("i.rate.csv", "count")[-1][2:5:2] == [3000, 151]
    do("intervals a.csv --steady-events 60 --no-picture -o steady")
    assert any(row[2] == 0 and 450 <= row[3] <= 550 and row[4] > 90 for row in rates("steady.rate.csv", "steady"))
    filled = [row for row in curve("i.csv") if row[7] > 0]
    assert len(filled) == 2
    for row, time, events in zip(filled, (5, 50), (100, 50)):
        assert row[7] == events and row[4] <= time < row[5]
        assert row[8] == pytest.approx(row[7] / (150 * (row[5] - row[4])), rel=1e-9)
    first.printed(" 150 20 model time 1.061 0.02944$")
    first.printed("LSM\n .*0.995 .*1.00 .*15.21 .*0.0573")
    said("i.table1.csv", "^printed,,,0.0,,1.00,,100.0,,0.25,,,,,,,Block-Slider,")
    # Every second event is large, with times of 10 and 100.
    do("intervals a.csv --threshold 0 --threshold 1.5 --rescale -o r --no-picture")
    assert any(row[7] == 50 and row[4] <= 10 / 40 < row[5] for row in curve("r.csv", 2))
    # p-values depend on the seed and the given number of replicas.
    few = do("intervals a.csv --delta 1 --method likelihood --replicas 20 --seed 3 -o p --no-picture")
    few.printed(r" 0.048 \+- 0.04[0-9] yes")
    few.printed("rejected: p below 0.05")
    none = do("intervals a.csv --delta 1 --method likelihood --replicas 0 --shuffles 0 -o p --no-picture")
    assert not [line for line in none.out.splitlines() if "γ" in line and "rejected" in line], "a p-value without replicas"
    no("replicas", "intervals a.csv --replicas -1 -o x")
    no("expected 'free' or a positive number", "intervals a.csv --delta x -o x")


def test_exponential_intervals(do):
    """gamma = delta = 1, B = 7, C = 1 / 7."""
    n = 4000
    times = np.cumsum(-7 * np.log(1 - ((np.arange(n) * 7919) % n + 0.5) / n))
    fault("e.csv", [1] * n, times=np.concatenate([[0], times[:-1]]))
    do("intervals e.csv -o x --delta 1").printed("maximum likelihood, .* 1 no$")
    ours = [[float_or_text(cell) for cell in re.sub('"[^"]*"', "", row).split(",")] for row in rows("x.table1.csv") if row.startswith("ours")]
    assert len(ours) == 2
    for row in ours:
        assert row[11] == "" or row[11] <= 3
        assert [row[3], row[7] / 7, row[9] * 7] == pytest.approx([1, 1, 1], abs=0.03)
    tested = [row for row in ours if row[12] != ""]
    assert len(tested) == 1 and tested[0][13:16] == [1, 0, "no"]


def exponents(path):
    return [[float_or_text(cell) for cell in row.split(",")] for row in rows(path) if row.startswith("lsm")]


def test_fit(do, no):
    fault("a.csv", power_law(1, 1e-3, 1, 2000))
    command = "fit a.csv --range 1e-3:1 --range 1e-3:0.1 --replicas 20 --json f.json -o f"
    first = do(command)
    pictures("f")
    found = exponents("f.fits.csv")
    assert len(found) == 6
    for row in found:
        assert 0.99 <= row[5] <= 1.01 and 0.005 < row[6] < 0.05
    said("f.json", '"exponent": (1.00|0.99)', '"rival": "log-normal"')
    said("f.fits.csv", "one line per rival")
    assert do(command).out == first.out, "the same seed gives another answer"
    # The range is that of the paper unless another is given; a searched one has its own line.
    do("fit a.csv --replicas 0 --no-comparison -o s --no-picture --json s.json")
    assert [row[:4] for row in exponents("s.fits.csv")] == [["lsm", 1e-4, 0.1, "no"]]
    said("s.json", '"name": "exponent_0.0001:0.1"')
    do("fit a.csv --replicas 0 --no-comparison --search -o s --no-picture").printed("searched")
    assert [row[3] for row in exponents("s.fits.csv")] == ["no", "yes"]
    assert "one line per rival" not in Path("s.fits.csv").read_text(), "rivals are explained, but there are none"
    # The bin that contains the smallest size is incomplete and does not count.
    assert max(float(row["size"]) for row in table("a.csv")) >= 0.8
    no("no bin of sizes from 0.8 on has an event", "fit a.csv --threshold 0.8 --replicas 0 --no-picture -o x")
    do("fit a.csv --range 1e-3:1 --replicas 0 --scaling -o o --no-picture").printed("degenerate: ")
    no("expected LO above 0", "fit a.csv --range :1 -o x")
    # Events left out below a size do not make the law flatter, as the fit begins there.
    do("fit a.csv --min-size 0.01 --range 1e-3:1 --range 1e-3:0.01 --replicas 0 --no-comparison -o m --no-picture")
    whole = [row for row in exponents("m.fits.csv") if row[1] == 0.01 and row[4] > 1300]
    assert whole and 0.98 < whole[0][5] < 1.02
    said("m.fits.csv", "^lsm,0.01,1,", "only has events from 0.01")
    large = [row for row in table("a.csv") if float(row["size"]) >= 0.01]
    write_catalogue("picked.csv", [row["t_start"] for row in large], [row["size"] for row in large], dict(model="lsm", min_size=0.01, length=120),
                    event_id=[row["event_id"] for row in large])
    do("fit picked.csv --range 1e-3:1 --replicas 0 --no-comparison -o m --no-picture")
    said("m.fits.csv", "^lsm,0.01,1,")


LENGTHS = 100, 200, 400, 800, 1600


@pytest.fixture
def growing():
    """Writes g*.csv with a roll-off at a size proportional to the length, and n*.csv, at the same size."""
    for length in LENGTHS:
        fault(f"g{length}.csv", power_law(1.2, 1e-3, length / 100, 3000), length)
        fault(f"n{length}.csv", power_law(1.2, 1e-3, 1, 3000), length)


SCALING = "--range 1e-3:0.1 --replicas 0 --scaling "


def files(kind, lengths=LENGTHS):
    return "fit " + " ".join(f"{kind}{length}.csv" for length in lengths) + " "


def number_in(path, name):
    return float(re.search(f'"{name}": ([-0-9.e+]+)', Path(path).read_text())[1])


def test_scaling(do, no, growing):
    grown = do(files("g"), SCALING, "--json g.json -o g")
    pictures("g.scaling")
    grown.printed(r"grows with the length \(")
    assert number_in("g.json", "D") == pytest.approx(1, rel=0.1)
    none = do(files("n"), SCALING, "--json n.json -o n")
    none.printed("shows no significant dependence")
    said("n.json", '"preferred": "no dependence on the length"')
    for kind in "g", "n":
        assert "growth up to L_c" not in Path(f"{kind}.scaling.gp").read_text(), "a curve of growth that ends without such growth"
    # Errors are by blocks of time, the length of which can be given, or event by event.
    none.printed("bootstrap errors, blocks of time")
    none.printed("error if events were independent blocks")
    two = files("g", (100, 200)) + SCALING
    do(two, "--block 1000 --json b.json -o b --no-picture")
    for row in curve("b.scaling.csv"):
        assert 990 < row[8] < 1010 and row[9] == 30, row
    said("b.json", '"blocks": 30', '"error_independent": ')
    do(two, "--block 0 -o b --no-picture").printed("single events as if independent")
    for row in curve("b.scaling.csv"):
        assert row[8] == row[9] == 0 and 0.8 * row[7] < row[5] < 1.2 * row[7], row
    no("block 'long', expected 'auto' or a time of 0 or more", "fit g100.csv --scaling --block long -o x")
    no("block of 20000, expected 0 or .* to half of the catalogue", "fit g100.csv --scaling --block 20000 -o x")


def test_scaling_of_other_growth(do, growing):
    # For growth that does not follow a power law, s* is 1, 1, 1, 1, 16.
    edit("g1600.csv", "n3200.csv", ("# length = 1600", "# length = 3200"))
    do(files("n", (100, 200, 400, 800, 3200)), SCALING, "-o p --no-picture").printed("grows with the length, but not as a power law")
    # For growth that ends, s* is 1, 2, 4, 4, 4, 4, 4.
    for length in 800, 1600, 3200, 6400:
        edit("g400.csv", f"s{length}.csv", ("# length = 400", f"# length = {length}"))
    do("fit g100.csv g200.csv g400.csv s800.csv s1600.csv s3200.csv s6400.csv", SCALING,
       "--json s.json -o s").printed(r"grows with the length up to L_c only \(")
    pictures("s.scaling")
    said("s.scaling.gp", "growth up to L_c = ")
    said("s.json", '"preferred": "growth that ends at a length"')
    assert number_in("s.json", "L_c") == pytest.approx(350, rel=0.25)
    longest = [row for row in curve("s.scaling.csv") if row[3] == 6400]
    assert number_in("s.json", "s_inf") == pytest.approx(longest[0][4], rel=0.03)


def test_completeness(do, no):
    sizes = power_law(1, 1e-3, 1, 1000)
    fault("plain.csv", sizes)
    fault("known.csv", sizes, completeness=0.01)
    fault("long.csv", sizes, 240)
    slider("s.csv", power_law(1, 1e-3, 1, 1000))
    above = int(np.sum(sizes >= 0.01))
    assert 600 < above < 700
    # Without a completeness the threshold is that of the paper.
    do("histograms plain.csv -o p --no-picture").printed("smallest size, fault: 0.0001, that of the paper")
    assert count("p.csv", 1) == 1000
    # A completeness holds for all faults, but not for block-sliders.
    both = ("smallest size, fault: 0.01, completeness in the header of known.csv", "smallest size, block-slider: 0.0001, that of the paper")
    printed = do("histograms long.csv known.csv s.csv -o h --no-picture")
    for pattern in both:
        printed.printed(pattern)
    said("h.csv", *both)
    assert [count("h.csv", n) for n in (1, 2, 3)] == [above, above, 1000]
    # A given value takes precedence.
    do("histograms known.csv -o h --no-picture --threshold 0.001").printed("0.001, as given")
    assert count("h.csv", 1) == 1000
    for limits, events in ("0.001:", 1000), (":1", above):
        do("histograms known.csv -o h --no-picture --range", limits)
        assert count("h.csv", 1) == events, limits
    do("intervals known.csv -o i --no-picture --replicas 0").printed(f"sizes >= 0.01, completeness in the header of known.csv {above - 1} ")
    said("i.csv", "^# sizes >= 0.01, completeness in the header")
    said("i.table1.csv", f"^ours,0.01,{above - 1},")
    do("intervals known.csv -o i --no-picture --replicas 0 --threshold 1e-4").printed("sizes >= 0.0001, as given 999 ")
    fitted = do("fit known.csv --replicas 0 --scaling -o f --no-picture --json f.json")
    fitted.printed("smallest size, fault: 0.01, completeness in the header")
    fitted.printed(f"fault, length 120 120 {above} ")
    assert all(row[1] >= 0.01 for row in exponents("f.fits.csv")), "the search begins too low"
    said("f.json", '"threshold_from": "0.01, completeness')
    assert "may depend on the time step" not in fitted.out, "a note without a reason"
    do("fit known.csv --replicas 0 --no-comparison --range 1e-3:1 -o f --no-picture").printed("below its completeness of 0.01")
    said("f.fits.csv", "^lsm,0.001,1,no,1000,")
    do("report known.csv s.csv --replicas 0 --interval-replicas 0 -o r.html")
    page = said("r.html", f"<td>{above} ≥ 0.01</td>", "<td>1000 ≥ 0.0001</td>", r"Sizes from 0.01\.",
                "Smallest size, fault: 0.01, completeness in the header of known.csv")
    assert not re.search("fault, length 120</th><td>0.0001 to", page)
    fault("bad.csv", sizes, completeness="small")
    for command in "histograms", "intervals", "fit", "report":
        no("bad.csv:3: completeness is 'small', expected a finite size of at least 0", command + " bad.csv -o x")


# ---- pages
QUICK = "--replicas 0 --interval-replicas 0 "
DROPS, RUPTURES = "Sizes are drops of the potential energy of the whole model", "Events are ruptures: connected"


def test_report(do, postproc):
    fault("a<b&c.csv", power_law(1, 1e-3, 1, 500))
    slider("s.csv", power_law(1.2, 1e-2, 100, 500))
    do(["report", "a<b&c.csv", "s.csv", "--label", 'x<y&"z"', "--label", "s", "--replicas", 5, "-o", "r.html"])
    page = said("r.html", "x&lt;y&amp;&quot;z&quot;", "Fig. 12", "Fig. 13", "Fig. 14", "Fig. 15", "Table 1", "15.21", "100.0", "0.0573", "1.07",
                DROPS)
    assert page.count("<svg") >= 4
    assert "x<y" not in page, "label let through"
    assert not re.search(r"(src|href)=.?(https?:|//)|@import|url\((https?:)?//", page), "the page asks for something outside it"
    for absent in "are ruptures", "Stick-slip or creep", "Fig. 7":
        assert absent not in page, absent
    # Identifiers are unique, and references lead to one of them.
    ids = re.findall(r""" id=['"]([^'"]*)""", page)
    assert ids and len(ids) == len(set(ids))
    assert set(re.findall(r"""href=['"]#([^'"]*)""", page)) <= set(ids)
    for tag in "table figure svg tr td th section div p ul li h2 h3".split():
        assert len(re.findall(f"<{tag}[ >]", page)) == page.count(f"</{tag}>"), f"<{tag}> not closed"
    # Without gnuplot an older page is kept.
    refused(postproc, "report s.csv -o r.html", "gnuplot not found", env={"PATH": "/nonexistent"})


def test_report_of_kinds_of_events(do):
    """Each kind of events has its own text, and its own section or scaling."""
    sizes = power_law(1, 1e-3, 1, 500)
    fault("a.csv", sizes)
    fault("r.csv", sizes, events="ruptures")
    do("report r.csv", QUICK, "-o p.html")
    page = said("p.html", '<h2 id="model-[12]">Fault: ruptures</h2>', "those at the same time at different places stay apart",
                "that friction took on its part of the fault")
    assert "Sizes are drops of the potential energy" not in page
    do("report r.csv a.csv", QUICK, "-o p.html")
    said("p.html", '<h2 id="model-1">Fault</h2>', '<a href="#model-2">Fault: ruptures</a>', '<h2 id="model-[12]">Fault: ruptures</h2>',
         "<td>drops of PE</td>", "<td>ruptures</td>")
    slider("s.csv", power_law(1.2, 1e-2, 100, 500))
    slider("ruptures.csv", power_law(1.2, 1e-2, 100, 500), events="ruptures")
    do("report ruptures.csv --replicas 0 -o u.html")
    assert "drops of the potential energy" not in said("u.html", RUPTURES + " in space and time")
    do("report s.csv ruptures.csv --replicas 0 --label a --label b -o u.html")
    page = Path("u.html").read_text().splitlines()
    assert [sum(words in line for line in page) for words in (RUPTURES, "drops of the potential energy")] == [1, 1]


def test_report_of_series(do, no):
    """Series of 90 steps up by 1 and 9 down by 10, of as many steps down as up, and one that only rises."""
    for name, length, up, down in ("tooth.pe", 120, 90, 9), ("creep.pe", 240, 60, 60), ("rise.pe", 480, 10, 0):
        i = np.arange(20 * (up + down) + 1)
        pe = np.cumsum(np.concatenate([[0], np.where(i % (up + down) < up, 1, -up / down if down else 0)]))
        fault(name.replace(".pe", ".csv"), power_law(1.2, 1e-2, 100, 500), length=length)
        write_series(name, pe, {"dt": 1, "length": length, "picker": "literal", "lambda": 0})

    def row(name):
        line = next(line for line in Path("p.html").read_text().splitlines() if line.startswith(f'<tr><th scope="row">{name}<'))
        return re.sub(r"\|\|*", "|", re.sub("<[^>]*>", "|", line))

    do("report tooth.csv creep.csv rise.csv --series tooth.pe --series creep.pe --series rise.pe", QUICK, "-o p.html")
    assert row("tooth.pe") == "|tooth.pe|fault|120|0 to 1981|1982|20|stick-slip|10|3|10|0.09086|9|"
    assert row("creep.pe") == "|creep.pe|fault|240|0 to 2401|2402|20|creep|1|2.41|1|0.4998|60|"
    assert re.search(r"480\|0 to 201\|202\|.*\|PE only rises", row("rise.pe"))
    # The time window applies to the series, too.
    do("report tooth.csv --series tooth.pe --from 495 --to 1485", QUICK, "-o p.html")
    assert re.search(r"\|495 to 1485\|991\|.*\|stick-slip\|10\|", row("tooth.pe"))
    no("samples in the window of time", "report tooth.csv --series tooth.pe --from 5000 -o x.html")
    no("is read by this command", "report tooth.csv --series tooth.pe -o tooth.pe")
    no("nowhere.pe: cannot open", "report tooth.csv --series nowhere.pe -o x.html")


def test_report_of_leaf_springs(do):
    """Catalogues of several stiffnesses have their own picture and are left out of the scaling."""
    for kl in 0.01, 0.1:
        slider(f"kl{kl}.csv", power_law(1.2, 1e-2, 100, 500), kl=kl)
    do("report kl0.01.csv kl0.1.csv kl0.01.csv --replicas 0 --label a --label b --label c -o k.html")
    page = said("k.html", "Fig. 7")
    assert page.count('<th scope="row">b</th><td>256</td>') == 0, "another stiffness in the scaling"
    assert page.count('<th scope="row">c</th><td>256</td>') == 1, "no scaling of the common stiffness"


def test_report_begins_at_the_threshold(do):
    fault("a.csv", power_law(1, 1e-3, 1, 500))
    do("report a.csv --threshold 2e-3 --replicas 0 -o t.html")
    assert "<td>0.0001 to" not in said("t.html", "<td>0.002 to 2</td>")
    do("report a.csv --threshold 0.1 --replicas 0 -o t.html")
    assert " to 0.01</td>" not in Path("t.html").read_text()


def test_seismology(do, no):
    fault("a.csv", power_law(1.7, 1e-3, 1e3, 2000))
    fault("b.csv", power_law(1.2, 1e-3, 1e3, 2000), 240)
    do("magnitudes a.csv b.csv --threshold 1e-3 --label 'a_{x}' --label b -o m")
    pictures("m")
    said("m.gp", "b = 1.")
    said("m.svg", re.escape("a_{x} (2000 events)"))
    do("aftershocks a.csv b.csv -o s --replicas 10")
    pictures("s")
    said("s.gp", "filledcurves")
    no("nothing to draw", "magnitudes a.csv --min-size 1e9 -o x")
    no("expected at least 2", "aftershocks a.csv --min-size 1e9 -o x")


def test_tables_of_many_catalogues_fit_a_terminal(do):
    for k in range(6):
        fault(f"{k}.csv", 10**np.random.default_rng(k).uniform(-4, 0, 300), length=120 * (k + 1))
    paths = " ".join(f"{k}.csv" for k in range(6))
    for command in "intervals --shuffles 20 --replicas 20", "fit --replicas 20", "magnitudes", "count", "compare --replicas 20":
        shown = do(*command.split(), paths,
                   *([f"--no-picture -o {command.split()[0]}"] if command.split()[0] not in ("count", "compare") else [])).out
        assert max(map(len, shown.splitlines())) <= 160, shown
        for k in range(6):
            assert shown.count(f"fault, length {120 * (k + 1)}") >= 1


def test_few(do, no):
    """With no event, one, or a few, numbers that cannot be determined are reported as degenerate."""
    fault("none.csv", [])
    fault("one.csv", [0.01], times=[5])
    fault("few.csv", 0.01 * np.arange(1, 7), 240, times=np.arange(6)**2)
    no("nothing to draw", "histograms none.csv -o x")
    no("nothing to draw", "intervals none.csv -o x")
    no("nothing to draw", "intervals one.csv -o x")
    do("histograms one.csv -o h1")
    pictures("h1")
    do("histograms few.csv none.csv -o h").warned("no curve")
    do("intervals few.csv one.csv -o i")
    pictures("i")
    ours = [row for row in rows("i.table1.csv") if row.startswith("ours")]
    assert len(ours) == 8
    for row in ours:
        cells = row.split(",")
        assert cells[3] == cells[5] == cells[7] == cells[9] == "" and cells[-1] != "", "numbers of degenerate fits"
    said("i.clustering.csv", '^"fault, length 120",0.0001,0,,,')
    do("fit few.csv --range 1e-3:1 -o f").printed("degenerate")
    # Without a characteristic size in any catalogue there is no picture of the scaling, but all others.
    scaled = do("fit one.csv few.csv --scaling -o z")
    pictures("z")
    scaled.warned("no picture of the scaling")
    assert sum("at least 10 needed" in line for line in scaled.out.splitlines()) == 4, "both have neither an exponent nor a size"
    assert not Path("z.scaling.csv").exists(), "a table without a picture"
    do("report none.csv one.csv few.csv -o r.html")
    assert not re.search(">-?nan|>inf", said("r.html", "degenerate: ")), "NaN or infinity in the page"
    do("report none.csv -o e.html")
    said("e.html", "no events")


# ---- whatever a name or a label holds, nothing is run and all is drawn
DRAW = {
    "histograms": "histograms a.csv b.csv", "intervals": "intervals a.csv b.csv --replicas 0",
    "fit": "fit a.csv b.csv --replicas 0 --scaling --bootstrap 2 --range 1e-2:1", "magnitudes": "magnitudes a.csv b.csv --threshold 1e-3",
    "aftershocks": "aftershocks a.csv b.csv --replicas 0", "rupture": "rupture r.csv r.csv", "series": "series pe.bin"
}
MAIN = {"rupture": "-length"}


@pytest.fixture
def drawable():
    fault("a.csv", power_law(1.2, 1e-3, 10, 300))
    fault("b.csv", power_law(1.2, 1e-3, 10, 300), 240)
    ruptures("r.csv")
    pe = np.cumsum(np.concatenate([[0], np.where(np.arange(2000) % 99 < 90, 1, -10)]))
    write_series("pe.bin", pe, {"dt": 1, "length": 40, "picker": "literal", "lambda": 0})


NAMES = ["-x", "--version", "-e '1'", "+", "-", "a'b", 'a"b', "`touch marker`", "$(touch marker)", "#a", "~", "a\\", "{", "ä b"]


@pytest.mark.parametrize("command", DRAW)
def test_names(do, drawable, command):
    for output in ["<touch marker;cat y", "|touch marker"] + NAMES * (command == "histograms"):
        before = set(os.listdir())
        do(DRAW[command], [f"--output={output}"])
        assert not Path("marker").exists(), f"{command} -o '{output}' ran a command"
        pictures(output + MAIN.get(command, ""))
        if command == "series":
            assert os.path.getsize(f"{output}-events.csv") > 0
        new = set(os.listdir()) - before
        assert new, f"{command} -o '{output}' wrote nothing here"
        for name in new:
            os.remove(name)


# Labels that break careless quoting in strings, markup and tables.
LABELS = ["run ''", "''", "'\"q\"", "' '#1' '}{'", "`touch marker`", "a\\", "@a &b ~c ^{d}_e'", "%d $1 \\n"]


def shows(page, label):
    assert not Path("marker").exists(), f"label {label} ran a command"
    text = Path(page).read_text()
    for name, sign in ("&lt;", "<"), ("&gt;", ">"), ("&quot;", '"'), ("&#39;", "'"), ("&amp;", "&"):
        text = text.replace(name, sign)
    assert label in text, f"label {label} is not in {page}"


@pytest.mark.parametrize("command", ["histograms", "intervals", "fit", "magnitudes", "aftershocks", "rupture"])
def test_labels(do, drawable, command):
    for label in ["'old' run"] + LABELS * (command == "histograms"):
        do(DRAW[command], ["--overwrite", "--output=l", "--label", label, "--label", "other"])
        shows(f"l{MAIN.get(command, '')}.svg", label)


def test_labels_of_reports(do, drawable):
    for label in ["'old' run"] + LABELS:
        do(["report", "a.csv", "--label", label], QUICK, "--bootstrap 2 -o l.html")
        shows("l.html", label)


def test_rupture(do, no):

    def slope(path, pattern, wanted):
        """Asserts that the line states this slope, and a scatter of 0, up to rounding."""
        line = next(line for line in Path(path).read_text().splitlines() if re.search(pattern, line))
        value, scatter = re.search(r"slope ([0-9.e-]+) .*, scatter ([0-9.e-]+) decades \(n", line).groups()
        assert float(value) == pytest.approx(wanted, abs=1e-12) and float(scatter) < 1e-12, line

    ruptures("a.csv")
    first = do("rupture a.csv --label a -o r")
    pictures("r-lengths", "r-moments", "r-length", "r-pe", "r-stress")
    # Lengths of 1 to 39 occur once each, and 40, 30, 25, 120: 43 in all, of which 8 from 25 to 30; T = 495.
    found = [[float_or_text(cell) for cell in row.split(",")] for row in rows("r-lengths.csv")]
    assert sum(row[5] for row in found) == 43 and [row[5] for row in found if row[2] == 24.5] == [8]
    for row in found:
        assert row[6] == pytest.approx(row[5] / (495 * 120 * (row[3] - row[2])), rel=1e-9)
    first.printed("^ a 43 ")
    # For lengths below that of the fault, the slope is 2 without scatter.
    slope("r-length.csv", "^# fit, without those of the whole fault: ", 2)
    flags = [row.split(",")[5] for row in rows("r-length.csv")]
    assert flags.count("1") == 1, "ruptures of the whole fault"
    # PE rose during one rupture. For the others, except those that overlap with another one, the drop is
    # 0.05 times the moment.
    said("r-pe.csv", "^# PE rose during 1 of 43 ruptures")
    slope("r-pe.csv", "^# fit of those isolated in time: .*n = 40.*ratio 0.05, scatter", 1)
    beside = [float(row.split(",")[3]) for row in rows("r-pe.csv") if row.split(",")[5] == "0"]
    assert len(beside) == 3 and set(beside) <= {160, 90, 62.5}
    said("r-stress.svg", "means of half decades")
    do("rupture a.csv a.csv --label one --label two --no-picture -o t")
    assert sum(row.split(",")[1] == "two" for row in rows("t-length.csv")) == 43
    short = [line if line.startswith("#") else ",".join(line.split(",")[:11]) for line in Path("a.csv").read_text().splitlines()]
    Path("short.csv").write_text("\n".join(short) + "\n")
    no("short.csv: no catalogue of ruptures of a fault", "rupture short.csv -o x")
    fault("plain.csv", [0.01], times=[5])
    no("plain.csv: no catalogue of ruptures of a fault", "rupture plain.csv -o x")
    # Of the places 15, 45, 75 and 105 only 75 is reached by more than the one rupture of the whole fault,
    # namely by 28.
    places = do("intervals a.csv --threshold 0 --places 4 --no-picture -o p")
    places.printed(" 27 [0-9.]* model time")
    places.printed("times at 4 places each")
    no("plain.csv: times at places: no columns x_begin and rupture_length", "intervals plain.csv --places 4 -o x")
    no("--places", "intervals a.csv --places -1 -o x")
    no("a.csv: not a slip history", "rupture a.csv --history a.csv -o x")
    Path("two.csv").write_text("".join(Path("a.csv").read_text().splitlines(True)[:7]))
    no("expected at least 3", "rupture two.csv -o x")


def test_rupture_on_a_plane(do, no):
    # A rupture spreads from the middle of 21 x 11 cells of a half at a speed of 1; each cell slips by 0.3 along strike and -0.4 down dip,
    # evenly in the two time units from then on.
    x, z = np.meshgrid((np.arange(21) + 0.5) / 2, (np.arange(11) + 0.5) / 2, indexing="ij")
    begin, steps = np.hypot(x - 5.25, z - 2.75), np.arange(81)
    done = np.clip((0.1 * steps[:, None, None] - begin) / 2, 0, 1)
    write_history("p.slip.bin", steps, np.diff(done, axis=0, prepend=0)[..., None] * [0.3, -0.4], bin=0.5, bin_dip=0.5, dt=0.1)
    head = dict(model="lsm", length=10.5, events="ruptures", slip_bin=0.5, slip_bin_dip=0.5, dt=0.1, modulus=0.4)
    columns = dict(t_end=[8], step_start=[0], step_end=[80], slip_moment=[0.4 * 0.25 * 0.5 * 231], x_centroid=[5.25], rupture_length=[10.5],
                   x_hypocentre=[5.25], x_begin=[0], mean_slip=[0.5], stress_drop=[1], peak_slip=[0.5], moment_strike=[3], moment_dip=[-4],
                   z_centroid=[2.75], rupture_width=[5.5], rupture_area=[57.75], z_hypocentre=[2.75], z_begin=[0], peak_slip_rate=[0.25])
    write_catalogue("p.csv", [0], [1], head, **columns)
    do("rupture p.csv --history p.slip.bin -o m").printed("no figures of all ruptures: 0 ruptures for a fit, expected at least 3")
    pictures("m-slip", "m-time", "m-rate", "m-momentrate")

    def read(path):
        return np.array([[float(cell) for cell in row.split(",")] for row in rows(path)]).T

    for path, wanted, close in ("m-slip.csv", np.full((11, 21), 0.5), 1e-6), ("m-rate.csv", np.full((11, 21),
                                                                                                    0.25), 1e-6), ("m-time.csv", begin.T, 0.15):
        at_x, at_z, found = read(path)
        assert np.array_equal(at_x, x.T.ravel()) and np.array_equal(at_z, z.T.ravel())
        assert found == pytest.approx(wanted.ravel(), abs=close), path
    level, *ends = read("m-time-contours.csv")
    assert sorted(set(level)) == pytest.approx(list(np.arange(0.5, 5.1, 0.5)))
    for at_x, at_z in (ends[:2], ends[2:]):
        assert np.hypot(at_x - 5.25, at_z - 2.75) == pytest.approx(level, abs=0.15)
    time, rate, along, down = read("m-momentrate.csv")
    assert rate == pytest.approx(np.hypot(along, down)) and along == pytest.approx(-0.75 * down)
    assert time[0] == pytest.approx(0.05) and rate.sum() * 0.1 == pytest.approx(0.4 * 0.25 * 0.5 * 231, rel=1e-6)
    for said_of in "m-time.svg", "m-slip.svg":
        said(said_of, "Along strike", "Along dip, upwards")
    # All cells slip at 0.25.
    do("rupture p.csv --history p.slip.bin --arrival 0.24 --no-picture -o fast")
    assert (read("fast-time.csv")[2] > read("m-time.csv")[2]).all()
    no("p.slip.bin: rupture 1 slips at 0.25 at most, expected an arrival below it, not 0.26",
       "rupture p.csv --history p.slip.bin --arrival 0.26 -o x")
    no("--arrival", "rupture p.csv --history p.slip.bin --arrival 0 -o x")
    # What does not belong together is refused.
    write_history("line.slip.bin", steps, np.diff(done[:, :, 5], axis=0, prepend=0), dt=0.1, bin=0.5)
    no("p.csv: ruptures on a plane, expected its slip history, found that of a line", "rupture p.csv --history line.slip.bin -o x")
    ruptures("a.csv")
    no("a.csv: ruptures along a line, expected its slip history, found that of a plane", "rupture a.csv --history p.slip.bin -o x")
    no("p.slip.bin: slip history of a plane, expected that of a line", "explore p.csv --history p.slip.bin -o x.html")
    write_history("short.slip.bin", steps[:40], np.diff(done[:40], axis=0, prepend=0)[..., None] * [0.3, -0.4], bin=0.5, bin_dip=0.5, dt=0.1)
    no("short.slip.bin: does not have all of rupture 1, expected its slip until step 80", "rupture p.csv --history short.slip.bin -o x")
