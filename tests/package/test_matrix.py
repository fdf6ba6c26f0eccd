# SPDX-License-Identifier: GPL-2.0-or-later
"""tests/matrix/run_matrix.py: how faults are compared, and where rows go. Its columns take hours and are not run here."""
import sys

import pytest

from programs import SOURCE, Program, run

sys.path.insert(0, str(SOURCE / "tests/matrix"))
import run_matrix as matrix  # noqa: E402


@pytest.fixture
def faults(work):
    matrix.FOLDER = work
    for name, version in (("reference", "4 Feb 2025"), ("jul2026", "4 Jul 2026")):
        (work / name / "fault").mkdir(parents=True)
        for ranks in 1, 2:
            rows = "".join(f"{n},{n}\n" for n in range(5 + ranks))
            (work / name / f"fault/on_{ranks}.catalogue.csv").write_text(f"# program = LAMMPS {version}\nevent_id,t_start\n{rows}")
            (work / name / f"fault/on_{ranks}.pe.bin").write_bytes(f"LAMMPS {version}".encode())
    return work


def test_only_the_version_may_differ(faults):
    assert matrix.compare_fault("jul2026") == ("1 rank: 6 events, same bytes; 2 ranks: 7 events, same bytes", True)
    (faults / "jul2026/fault/on_2.pe.bin").write_bytes(b"LAMMPS 4 Jul 2026.")
    assert matrix.compare_fault("jul2026") == ("1 rank: 6 events, same bytes; 2 ranks: 7 events, pe.bin differ", False)


def test_few_events_say_nothing(faults):
    (faults / "jul2026/fault/on_1.catalogue.csv").write_text("# x\nevent_id\n1\n2\n")
    assert matrix.compare_fault("jul2026") == ("FAILED: 2 events on 1 ranks say nothing", False)


def test_rows_replace_those_of_their_column():
    page = "a\n| plugin | not this |\n## Last run\n\n| plugin | old |\n| x | y |\n"
    assert matrix.with_row(page, "plugin", "| plugin | new |\n") == page.replace("| plugin | old |", "| plugin | new |")
    assert matrix.with_row(page, "z", "| z |\n") == page + "| z |\n"


def test_what_a_command_said_is_told(work):
    matrix.FOLDER = work
    with pytest.raises(matrix.Failure, match="nothing here\n.* ended with 3, expected 0"):
        matrix.command("bash", "-c", "echo nothing here; exit 3")


def test_differences_of_numbers(work):
    for name, text in (("a", "x 1.0 2e-3\n"), ("b", "x 1.0 2.2e-3\n"), ("c", "y 1.0 2e-3\n")):
        (work / name).write_text(text)
    assert matrix.largest_difference(work / "a", work / "b") == "9.1e-02" and matrix.largest_difference(work / "a", work / "c") == "text"


def test_columns_are_those_of_the_page(work):
    page = (SOURCE / "tests/matrix/README.md").read_text().partition("## Notes")[0]
    for name in matrix.ORDER:
        assert name in page and name in matrix.COLUMNS, name
    assert len(matrix.ORDER) == len(matrix.COLUMNS)
    result = run(Program("matrix", sys.executable, SOURCE / "tests/matrix/run_matrix.py"), "never", status=2)
    assert "invalid choice: 'never'" in result.err
