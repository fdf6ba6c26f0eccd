# SPDX-License-Identifier: GPL-2.0-or-later
"""values.py: numbers of sentences."""
import math
import sys

import pytest
from programs import SOURCE

sys.path.insert(0, str(SOURCE / "results"))
import values  # noqa: E402
from values import Value  # noqa: E402

TABLE = {one.key: one for one in (Value("a.b", 1.1834, 0.0174), Value("rate", 0.0625, 0.001), Value("share", 0.4567), Value("none", math.nan))}


@pytest.mark.parametrize(("value", "error", "form", "text"), [
    (1.1834, 0.0174, "", "1.183"),
    (1.1834, 0.0174, "()", "1.183(17)"),
    (20.48, 0.81, "()", "20.5(8)"),
    (20.48, 2.2, "()", "20.5(2.2)"),
    (1234.0, 56.0, "()", "1230(60)"),
    (447.3, math.nan, "()", "447"),
    (0.4567, 0.01, "%", "45.7"),
    (0.4567, 0.01, "%()", "45.7(1.0)"),
    (0.0625, 0.001, "1/()", "16.00(26)"),
    (-0.51, math.nan, ".1f", "-0.5"),
    (0.0, math.nan, "", "0"),
])
def test_a_number_has_the_digits_that_its_error_allows(value, error, form, text):
    assert values.text_of(value, error, form) == text


def test_an_interval_is_that_of_student():
    assert values.text_of(1.1834, 0.0174, "95()", 3) == "1.18(7)"  # 4.303 x 0.0174
    with pytest.raises(ValueError, match="1 packing"):
        values.text_of(1.1834, 0.0174, "95()")


def test_what_stands_before_a_comment_is_replaced_and_nothing_else():
    page = "At 120 (?<!--n a.b ()-->), as 7 of 9, 3.4e-5(2)<!--n share %--> % and\n9<!--n rate 1/-->: 15."
    once = values.filled(page, TABLE)
    assert once == "At 120 (1.183(17)<!--n a.b ()-->), as 7 of 9, 45.7<!--n share %--> % and\n16.00<!--n rate 1/-->: 15."
    assert values.filled(once, TABLE) == once


@pytest.mark.parametrize(("page", "said"), [("?<!--n a.c-->", r"a\.c.*expected one of a\.b"), ("1<!--n none-->", "none.*no number"),
                                            ("1<!--n share q9-->", "share q9")])
def test_a_wrong_key_or_form_is_named(page, said):
    with pytest.raises(ValueError, match=said):
        values.filled(page, TABLE)


def test_a_table_is_read_as_it_was_written(tmp_path):
    values.write(TABLE.values(), tmp_path / "values.csv")
    again = values.read(tmp_path / "values.csv")
    assert list(again) == sorted(TABLE) and again["a.b"] == TABLE["a.b"] and math.isnan(again["none"].value)


def test_a_number_without_a_key_is_found_unless_it_is_a_constant():
    page = "# 77\n| 78 |\nOf 120 and 1.07, `79`, 0.93<!--n a.b-->, [page](80.md) are 81 and 8.2e-5.\n\n```\n83\n```\n<!-- table t -->\n| 84 |\n<!-- end -->\n"
    assert values.bare(page) == ["81", "8.2e-5"]
