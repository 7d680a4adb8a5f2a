"""Single values of campaign.toml written otherwise: nothing else of the file moves."""

from __future__ import annotations

import pytest

from pipeline.campaign.edited import Change, changed
from pipeline.errors import InputError

TEXT = """schema = 1   # kept
name = "bar"
[columns]
"Kraft Z" = { is = "fz", unit = "kN", sign = -1 }  # our cell
[columns."Weg"]
is = "z"
[[tests]]
id = "a"
q_deg = 0.5
[[tests]]
id = "b"
zero = "nominal"
"""


def test_what_is_declared_is_changed_where_it_stands_and_the_rest_stays() -> None:
    text, lines = changed(TEXT, [Change("columns", "fz_N", "sign"), Change("columns", "z_mm", "unit", "in")])
    expected = TEXT.replace("sign = -1", "sign = 1").replace('is = "z"\n', 'is = "z"\nunit = "in"\n')
    assert text == expected
    assert lines == (
        '[columns] "Kraft Z" = {is = "fz", unit = "kN", sign = 1}',
        '[columns] Weg = {is = "z", unit = "in"}',
    )


def test_what_is_not_declared_becomes_a_line_of_its_own() -> None:
    text, lines = changed(TEXT, [Change("columns", "x_mm", "zero", "first_row")])
    assert lines == ('[columns] x_mm = {is = "x", zero = "first_row"}',) and "# our cell" in text
    rest = text.replace('x_mm = {is = "x", zero = "first_row"}\n', "")
    assert [line for line in rest.splitlines() if line] == TEXT.splitlines()


def test_exchanged_columns_are_both_looked_up_before_one_is_written() -> None:
    pair = [Change("columns", "fz_N", "is", "z_mm"), Change("columns", "z_mm", "is", "fz_N")]
    text, _ = changed(TEXT, pair)
    assert text == TEXT.replace('is = "fz"', 'is = "?"').replace('is = "z"', 'is = "fz"').replace("?", "z")


def test_a_test_is_changed_by_its_id_and_line_ends_stay() -> None:
    text, lines = changed(
        TEXT.replace("\n", "\r\n"),
        [Change("tests", "b", "zero", "fitted"), Change("tests", "a", "q_deg", 28.6)],
    )
    assert lines == ('[[tests]] b: zero = "fitted"', "[[tests]] a: q_deg = 28.6")
    expected = TEXT.replace('"nominal"', '"fitted"').replace("0.5", "28.6")
    assert text == expected.replace("\n", "\r\n")


def test_what_is_no_toml_is_refused() -> None:
    with pytest.raises(InputError, match="is no TOML"):
        changed("= =", [])
