# SPDX-License-Identifier: GPL-2.0-or-later
"""The pages of the package's styles say what lmp does: keywords, defaults, examples."""
import re
from pathlib import Path

import pytest
from programs import SOURCE, run

DOC = SOURCE / "lammps-pkg/doc"
PAGES = sorted(path.stem for path in DOC.glob("*.rst") if path.stem != "index")

# A short fault; the lines in braces are completed by the tests.
SCENE = """units lj
dimension 2
boundary p f p
newton off
atom_style hybrid bond sphere
atom_modify map array
{geometry}
special_bonds lj/coul 0 1 1
bond_style lsm/linked
bond_coeff * 1.0
pair_style lsm/friction
pair_coeff * * 1.0 1.0 0.6
comm_modify mode single cutoff 3.6
neighbor 0.4 bin
neigh_modify delay 0 every 10 check yes
group lower type 5
group upper type 6
group plates union lower upper
group blocks subtract all plates
group below type 1 3 5
group above type 2 4 6
group lowerface type 3
group upperface type 4
timestep 0.03
fix move blocks lsm/nve{fix_lsm_nve}
fix plates all lsm/plates lower upper stress 0.02{driving}{fix_lsm_plates}
{leap}
compute events all lsm/events {events}{compute_lsm_events}
{runs}
"""
LEAP = "fix leap all lsm/leap plates{fix_lsm_leap}"
# Pages of styles with keywords
STYLES = ("create_lsm_fault", "fix_lsm_nve", "fix_lsm_plates", "fix_lsm_leap", "lsm_run", "compute_lsm_events")


def page(name):
    return (DOC / f"{name}.rst").read_text()


def keywords(name):
    """The keywords in the syntax of a page, after 'keyword ='."""
    syntax = page(name).split("Examples\n")[0]
    listed = re.search(r"keyword = (.*?)\n\n", syntax, re.S)[1]
    return set(re.findall(r"\*([a-z/]+)\*", listed))


def ran(lmp, name, words="", status=0):
    """Runs the short fault with further words in the command to which a page belongs."""
    parts = dict.fromkeys(STYLES, "")
    parts[name] = words and " " + words
    slip = " ruptures a.ruptures history a.slip sides below above faces lowerface upperface"
    files = "catalogue a.csv series a.pe" + slip * (name == "compute_lsm_events")
    leap = LEAP.format(fix_lsm_leap=parts["fix_lsm_leap"]) if name == "fix_lsm_leap" else ""
    driving = "" if name == "fix_lsm_plates" else " velocity 1e-4" if leap else " velocity 0.02"
    Path("in.scene").write_text(
        SCENE.format(**parts, leap=leap, driving=driving, events=files,
                     geometry="create_lsm_fault length 20 width 15 seed 1" + parts["create_lsm_fault"],
                     runs="run 500\nlsm_run 1500 prefix state every 500" + parts["lsm_run"]))
    return run(lmp, "-in in.scene", status=status)


@pytest.mark.parametrize("name", STYLES)
def test_keywords(lmp, name):
    """A page has the keywords that lmp accepts, and no other."""
    said = ran(lmp, name, "nonsense 1", status=1).out
    accepted = set(re.search(r"Unknown .* keyword 'nonsense'; accepted are ([a-z/, ]+)", said)[1].strip().split(", "))
    assert len(accepted) > 2
    assert keywords(name) <= accepted, "unknown to lmp"
    required = {"length", "width", "seed"} if name == "create_lsm_fault" else set()
    assert accepted - required <= keywords(name), "not on the page"


def defaults(name):
    """The defaults at the end of a page: keyword -> words."""
    text = re.sub(r"\s+", " ", page(name).split('Default\n"""""""')[-1].split("----------")[0])
    return {key: value.strip().rstrip(".") for key, value in re.findall(r"([a-z]+) = ([^,=]*?)(?=,| and [a-z]+ =|\. |\.$| *$)", text)}


@pytest.mark.parametrize("name", STYLES)
def test_defaults(lmp, name):
    """A run with the defaults of the page written out has the same bytes as one without them."""
    given = defaults(name)
    assert given, "no defaults on the page"
    written = [f"{key} {value}" for key, value in given.items()]
    ran(lmp, name)
    files = {path: path.read_bytes() for path in Path().iterdir() if path.name != "in.scene"}
    assert len([path for path in files if path.name.startswith("state")]) > 3 and Path("a.csv") in files
    for path in files:
        path.unlink()
    ran(lmp, name, " ".join(written))
    for path, content in files.items():
        assert path.read_bytes() == content, f"{path} differs with {written}"


@pytest.mark.parametrize("name", PAGES)
def test_examples(lmp, name):
    """The complete input of each page, or of the page that it names for one, runs as it stands."""
    blocks = [
        "".join(line[3:] + "\n" for line in block.splitlines()) for block in re.findall(r"\.\. code-block:: LAMMPS\n\n((?:   .*\n|\n)+)", page(name))
    ]
    complete = [block for block in blocks if block.startswith("# Complete input: ")]
    named = re.search(r"For a complete input see :doc:`[^<]*<(\w+)>`", page(name))
    assert complete or named and "# Complete input: " in page(named[1]), "no complete input"
    for script in complete:
        Path("in.example").write_text(script)
        assert "Total wall time" in run(lmp, "-in in.example").out


def test_input_of_the_readme(lmp):
    Path("in.example").write_text(re.search(r"```\n(units .*?)```", (SOURCE / "lammps-pkg/README.md").read_text(), re.S)[1])
    run(lmp, "-in in.example")
    assert len([line for line in Path("small.csv").read_text().splitlines() if line[:1].isdigit()]) > 10


def test_index():
    assert len(PAGES) > 10
    for name in PAGES:
        assert f"   {name}\n" in page("index"), f"{name} is not in the index"
