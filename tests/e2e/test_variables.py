# SPDX-License-Identifier: GPL-2.0-or-later
"""Variables of inputs/fault.in: refusals, what a restart keeps, what headers state, and the end by PREFIX.stop."""
import re
import zlib
from pathlib import Path

import pytest
from data_files import header, info, same_bytes
from programs import INPUTS, refused, run, scene, start
from variables import declared

SMALL = {"length": 20, "width": 15, "settle": 100, "velocity": 0.01, "checkpoint": 400, "steps": 400, "prefix": "a"}


def small(*more, **variables):
    return [*scene(**{**SMALL, **variables}), *more]


def with_checksum(file, lines):
    """Writes FILE.info with other lines and a valid checksum."""
    last = Path(f"{file}.info").read_text().splitlines()[-1]
    text = "".join(line + "\n" for line in lines)
    Path(f"{file}.info").write_text(f"{text}lines = {zlib.crc32(text.encode())}\n{last}\n")


@pytest.mark.parametrize("name, value", [("prefix", "a;echo>PWNED;b"), ("law", "coulomb 0.6 0.6; shell touch PWNED"), ("stress", "$(1/0)")])
def test_what_is_beside_a_restart_file_is_checked_as_well(lmp, name, value):
    run(lmp, small())
    lines = [line for line in Path("a.restart.end.info").read_text().splitlines()[:-1] if not line.startswith("lines = ")]
    with_checksum("a.restart.end", [f"{name} = {value}" if line.startswith(f"{name} = ") else line for line in lines])
    refused(lmp, scene(restart="a.restart.end", steps=500), rf"Variable {name} is '{re.escape(value)}', but must be")


# Values, and what the line of error says of the first of them: one of each kind of rule
REFUSED = [
    ({"preset": "Single"}, "must be leaky, reflecting or absorbing"), ({"leap": "maybe"}, "must be no or yes"),
    ({"stress": "high"}, "must be a number of at least 0"), ({"minsize": "nan"}, "must be a number of at least 0"),
    ({"kt": 0}, "must be a number above 0"), ({"lambda": 1}, "must be a number of at least 0 and less than 1"),
    ({"checkpoint": 0}, "must be a whole number of at least 1"), ({"settle": -1}, "must be a whole number of at least 0"),
    ({"steps": "10.5"}, "must be a whole number of at least 0"), ({"law": "a;b"}, "must be words of letters"),
    *(({"prefix": name}, "must be a file name of letters, digits and any of") for name in ("a;echo>b", "a|b", "`a`", "a b", "$x", "a*b", "")),
    ({"preset": "statistics"}, "its name is absorbing "), ({"preset": "single"}, "its name is absorbing, with dt 0.03 "),
    ({"lambda": 0.9}, "has no effect, as picker is exponential and memory is 0.3; leave it out"), ({"lambda": 0.99}, "has no effect"),
    ({"memory": 2, "picker": "literal"}, "has no effect, as picker is literal"),
    ({"impedance": 0.3, "hold": "position"}, "has no effect, as hold is position"), ({"fast": 0.02}, "has no effect, as leap is no"),
    ({"history": "yes"}, "has no effect, as ruptures is no"), ({"stride": 2, "series": "no"}, "has no effect, as series is no"),
    ({"mu": 0.9, "law": "coulomb 0.3 0.3"}, "has no effect, as law is given, too"),
]  # yapf: disable


def test_values_that_are_refused(lmp):
    for given, said in REFUSED:
        name, value = next(iter(given.items()))
        assert "Created" not in refused(lmp, small(**given), f"Variable {name} is '{re.escape(str(value))}', but {re.escape(said)}").out
    # On the command line LAMMPS takes a word with '-' for an option, but a script may set the variable.
    Path("in.dash").write_text(f"variable prefix string -x\ninclude {INPUTS}/fault.in\n")
    refused(lmp, ["-in", "in.dash", *small(prefix=None)[2:]], "ERROR: Variable prefix is '-x', but must be .* that does not begin with -")
    # Of several values LAMMPS would take the first.
    for words, said in ((small("-var", "stress", "0.04", stress=0.03), "stress is given twice, as '0.03' and as '0.04'; leave one out"),
                        (small("-var", "seed", 1, 2, 3), "seed is given several values, '1' and '2'; give one, or put its words in quotes"),
                        (small("-var", "law", "coulomb", 0.6, 0.7), "law is given several values, 'coulomb' and '0.6'"),
                        (small(contacts="fault",
                               loose="keep"), "contacts is fault and loose is keep, but then nothing holds discs that are not linked")):
        refused(lmp, words, f"Variable {said}")
    # A scene of `extra` is read after the compression, but found at once; that of an input has to have a folder.
    assert "Step" not in refused(lmp, small(extra="nonsense"), "Variable extra: cannot read file .*nonsense.in").out
    with open(INPUTS / "fault_120.in") as scene_on_input:
        refused(lmp, "-log none", r"cannot read file fault.in; .*use 'lmp -in FILE' instead of 'lmp < FILE'", stdin=scene_on_input)


def test_variables_that_nothing_reads(lmp):
    said = run(lmp, small(extra="fault_dump", every=200, evry=200, steps=1))
    assert re.findall("WARNING: Variable (.*) is not used by this script", said.out) == ["evry"]


def test_three_faults_by_what_happens_to_waves(lmp):
    """All values of a preset are used, but for those that are given; headers and restart files state them."""
    common = dict(dt="0.03", steps="400", stress="0.03", viscosity="5e-4")
    faults = dict(leaky=dict(common, kt="0.12", retardation="0.005", impedance="0.4",
                             memory="0.3"), reflecting=dict(common, kt="0.2", retardation="0", impedance="0", memory="1"),
                  absorbing=dict(dt="0.12", steps="400", stress="0.025", viscosity="0.05", kt="0.5", retardation="0", impedance="0.6", memory="1"))
    for name, values in faults.items():
        said = run(lmp, small(preset=None if name == "leaky" else name, prefix=name))
        kept, stated = info(f"{name}.restart.end.info"), header(f"{name}.catalogue.csv")
        assert kept["preset"] == name and {key: kept[key] for key in values} == values
        assert {key: stated[key] for key in ("kt", "stress", "impedance")} == {key: values[key] for key in ("kt", "stress", "impedance")}
        raised = re.search(rf"time step {values['dt']} stable with any contacts: (\d+) particles raised", said.out)[1]
        assert (int(raised) > 0) == (name == "absorbing")
    run(lmp, small(preset="absorbing", prefix="other", stress=0.04))
    assert info("other.restart.end.info")["stress"] == "0.04" and info("other.restart.end.info")["kt"] == "0.5"


def test_a_run_says_how_long_it_will_take(lmp):
    """Compression and shear together, from its first steps; the terminal only is told."""
    with start(lmp, [*small(settle=2000000, steps=3000000), "-log", "a.log"]) as child:
        assert child.until(lambda: " to go: " in child.said())
        told = re.search(r"^About [\d.]+ (seconds|minutes|hours) to go: (\d+) steps of ([\d.e-]+) ms$", child.said(), re.M)
    assert 4.5e6 < int(told[2]) < 5e6 and float(told[3]) > 0
    assert "to go" not in Path("a.log").read_text()


def test_an_earlier_run_is_kept_from_the_beginning(lmp):
    """The run is refused before the packing is made, not after the compression."""
    Path("a.catalogue.csv").write_text("an earlier run\n")
    said = refused(lmp, small(), "File a.catalogue.csv exists; give another prefix, or replace it with overwrite yes")
    assert "Created" not in said.out
    run(lmp, small(overwrite="yes"))
    assert Path("a.catalogue.csv").stat().st_size > 100
    run(lmp, scene(restart="a.restart.end", steps=500))


TWICE = """include {inputs}/fault.in
clear
variable prefix delete
variable prefix index b
variable stress delete
variable stress index 0.04
{delete}
include {inputs}/fault.in
"""


@pytest.mark.parametrize("first, second", [("leaky", "absorbing"), ("absorbing", "leaky")])
def test_a_second_fault_after_the_first(lmp, first, second):
    """Defaults of the first one are not values that were given."""
    Path("twice.in").write_text(TWICE.format(inputs=INPUTS, delete=f"variable preset delete\nvariable preset index {second}"))
    run(lmp, ["-in", "twice.in", *small(preset=None if first == "leaky" else first)[2:]])
    run(lmp, small(preset=second, stress=0.04, prefix="c"))
    assert header("a.catalogue.csv")["kt"] == {"leaky": "0.12", "absorbing": "0.5"}[first]
    kept, alone = (info(f"{prefix}.restart.end.info") for prefix in "bc")
    names = [one.name for one in declared() if one.name in alone and one.name != "prefix"]
    assert len(names) > 20 and [kept[name] for name in names] == [alone[name] for name in names]
    same_bytes("b.pe.bin", "c.pe.bin")


# Variables that have an effect together, and what headers state
TOGETHER = [({"lambda": 0.9, "memory": 0}, "lambda", 0.9), ({"lambda": 0.9, "picker": "average"}, "lambda", 0.9),
            ({"impedance": 0.3}, "impedance", 0.3), ({"law": "coulomb 0.9 0.9", "mu": 0.9}, "law", "coulomb 0.9 0.9"),
            ({"contacts": "smooth", "loose": "keep"}, "contacts", "smooth"), ({"stress": 0.03, "-var": "stress 0.03"}, "stress", 0.03),
            ({"checkpoint": "2e2", "steps": "4e2", "settle": "1e2"}, "checkpoint", 200.0)]  # yapf: disable


def test_variables_that_make_each_other_count(lmp):
    for n, (variables, name, value) in enumerate(TOGETHER):
        again = variables.pop("-var", "").split()
        run(lmp, small(*(["-var", *again] if again else []), **{"steps": 1, **variables}, prefix=f"p{n}"))
        stated = header(f"p{n}.catalogue.csv").get(name) or info(f"p{n}.restart.end.info")[name]
        assert (float(stated) if isinstance(value, float) else stated) == value, variables


def test_a_run_goes_on_with_what_it_was_begun_with(lmp):
    """Runs of earlier versions may have such variables, which studies give again; another value has no effect."""
    run(lmp, small(hold="position"))
    again = scene(restart="a.restart.end", steps=500, hold="position", impedance=0.4, prefix="b", **{"lambda": 0.99})
    run(lmp, again)
    assert info("b.restart.end.info")["impedance"] == "0.4"
    refused(lmp, scene(restart="a.restart.end", steps=500, impedance=0.5, prefix="c"), "Variable impedance is '0.5', but has no effect")
    run(lmp, scene(restart="a.restart.end", steps=500, hold="stress", impedance=0.5, prefix="d"))
    assert float(header("d.catalogue.csv")["impedance"]) == 0.5


def test_a_default_follows_a_variable_that_a_restart_changes(lmp):
    run(lmp, small())
    assert (info("a.restart.end.info")["law"], info("a.restart.end.info")["history"]) == ("coulomb 0.6 0.6", "no")
    run(lmp, scene(restart="a.restart.end", steps=500, ruptures="yes", memory=0.5, prefix="b"))
    assert (info("b.restart.end.info")["history"], info("b.restart.end.info")["memory"]) == ("yes", "0.5")
    assert Path("b.slip.bin").exists() and not Path("a.slip.bin").exists()
    # A variable that had a value of its own keeps it.
    run(lmp, small(ruptures="yes", history="no", prefix="c"))
    run(lmp, scene(restart="c.restart.end", steps=500, viscosity=0.02, prefix="d"))
    assert info("d.restart.end.info")["history"] == "no" and header("d.catalogue.csv")["viscosity"] == "0.02"
    run(lmp, scene(restart="a.restart.end", steps=500, picker="average", prefix="e"))
    assert info("e.restart.end.info")["memory"] == "0" and float(header("e.catalogue.csv")["lambda"]) == 0.99


def test_files_of_an_earlier_run_do_not_seem_to_be_of_this_one(lmp, on_ranks):
    """The earlier catalogue may have been moved away. With overwrite the other files are removed, once this run has locked the names."""
    run(lmp, small(ruptures="yes", checkpoint=150))
    for name in "a.catalogue.csv", "a.pe.bin", "a.ruptures.csv", "a.slip.bin":
        Path(name).rename(f"moved.{name}")
    Path("a.restart.notes").write_text("of somebody\n")
    refused(on_ranks(2), small(seed=2), "lsm_run: .*a.restart.* is there, of an earlier run; give another prefix")
    for name in "a.catalogue.csv", "a.pe.bin", "a.ruptures.csv", "a.slip.bin":
        Path(f"moved.{name}").rename(name)
    run(on_ranks(2), small(seed=2, overwrite="yes", series="no"))
    assert {path.name
            for path in Path().glob("a.*")
            } == {"a.catalogue.csv", "a.restart.500", "a.restart.500.info", "a.restart.end", "a.restart.end.info", "a.restart.notes"}
    assert header("a.catalogue.csv")["seed"] == info("a.restart.500.info")["seed"] == "2"
    # A single other file that a run of this name would write is a reason to refuse it, too.
    Path("b.slip.bin").write_bytes(b"lsm-slip-hist-1\n")
    refused(lmp, small(prefix="b"), "lsm_run: b.slip.bin is there, of an earlier run")


def test_what_no_restart_file_could_be_written_for_is_refused_at_once(lmp):
    Path("wrong.in").write_text("lsm_run 10 every 5 prefix ${prefix} ${key} ${value}\n")
    for prefix, key, value, message in (("a*", "after", 0, "prefix is a.*without"), ("no/a", "after", 0, "folder of prefix no/a does not exist"),
                                        ("a", "note", "nobody", "there is no variable nobody")):
        refused(lmp, ["-in", "wrong.in", "-var", "prefix", prefix, "-var", "key", key, "-var", "value", value], f"lsm_run: .*{message}")


def test_a_run_that_is_stopped_keeps_its_variables(lmp):
    refused(lmp, small(velocity=1, kt=0.4, steps=4000), "strained by .* Wrote restart file a.emergency.restart", but="^a")
    assert (info("a.emergency.restart.info")["velocity"], info("a.emergency.restart.info")["kt"]) == ("1", "0.4")


def test_headers_state_what_runs(lmp):
    run(lmp, small(hold="position", ruptures="yes"))
    for file in ("a.catalogue.csv", "a.ruptures.csv"):
        stated = header(file)
        assert stated["hold"] == "position" and "stress" not in stated and "impedance" not in stated
    # If another fix replaces that of the scene, headers state its settings when the files begin.
    Path("harder.in").write_text("fix plates all lsm/plates lower upper stress 0.05 velocity 0.02 ramp 150\n")
    run(lmp, small(prefix="b", extra=Path("harder").resolve()))
    stated = header("b.catalogue.csv")
    assert (float(stated["stress"]), float(stated["velocity"]), stated["hold"]) == (0.05, 0.02, "stress")


def test_headers_have_the_variables_of_the_table(lmp):
    run(lmp, small(ruptures="yes"))
    stated = [one.name for one in declared() if one.header == "header"]
    assert len(stated) > 10
    for file in ("a.catalogue.csv", "a.ruptures.csv"):
        found = header(file)
        assert {name: found.get(name) for name in stated} == {name: info("a.restart.end.info")[name] for name in stated}


def test_stop(lmp):
    with start(lmp, small(checkpoint=50, steps=500000)) as child:
        assert child.until(lambda: Path("a.restart.150.info").exists())
        Path("a.stop").touch()
        assert child.wait(60) == 75
        step = re.search(r"Stopped at step (\d+), as there was a file a.stop, which is removed", child.said())[1]
    assert not Path("a.stop").exists()
    run(lmp, scene(restart=f"a.restart.{step}", steps=int(step) - 100 + 60))
    # A stop file that comes too late does not end a later run.
    Path("a.stop").touch()
    run(lmp, scene(restart="a.restart.end", steps=int(step) - 100 + 60)).printed("There was a file a.stop, which is removed")
    assert not Path("a.stop").exists()


def test_a_long_time_step_makes_another_model(lmp):
    run(lmp, small(preset="absorbing", dt=1, settle=0, steps=0,
                   massstep=1)).printed(r"WARNING: create_lsm_fault: time step 1 .* \d+ % heavier, above 20 %")
    quiet = run(lmp, small(settle=0, steps=0, prefix="b"))
    assert "heavier" not in quiet.out


@pytest.mark.parametrize("line, wrong", [("x | 1 | number | free | - | ", "expected 7 columns"),
                                         ("x | 1 | number | maybe | - | | ", "restart is 'maybe', but must be fixed, free, noted or -"),
                                         ("x | 1 | number | free | yes | | ", "header is 'yes', but must be header or -"),
                                         ("x|1|number|-|-||\nx|2|number|-|-||", ":2: a second variable x"),
                                         ("when y 1 : x 2\nx|1|number|-|-||", "there is no variable y"),
                                         ("x 1 ignores y\nx|1|number|-|-||", "there is no variable y"),
                                         ("never x 1 & y 2 : why\nx|1|number|-|-||", "there is no variable y"),
                                         ("x|1|< 2|-|-||", "bad.variables:1: values are '< 2', but a bound must be > or >= and a number"),
                                         ("x|1|>= y|-|-||", "bad.variables:1: values are '>= y'"),
                                         ("x ignores x\nx|1|number|-|-||", "expected a name and a value, but got 'x'"),
                                         ("when x : x 2\nx|1|number|-|-||", "expected a name and a value, but got 'x'"),
                                         ("x|${y}|number|-|-||\ny|1|number|-|-||", "variable y is needed before it is defined")])
def test_tables_with_mistakes(lmp, line, wrong):
    Path("bad.variables").write_text(line + "\n")
    Path("bad.in").write_text("lsm_variables bad.variables\n")
    refused(lmp, ["-in", "bad.in"], f"lsm_variables: .*{re.escape(wrong)}")
