"""Numbers as they are printed."""

import pytest

from reports.blocks import Cell
from reports.formats import entry_of, entry_unit, fixed, name_and_unit, number, percent, symbol, trimmed


@pytest.mark.parametrize(
    ("value", "shown"),
    [
        (22004.5, "22\u202f004"),
        (18.1, "18.100"),
        (-3031.15, "\u22123031.2"),
        (2660000.0, "2\u202f660\u202f000"),
        (9999.96, "10\u202f000"),
        (0.0123456, "0.012346"),
        (1.234567e-7, "1.2346×10⁻⁷"),
        (-5.0e12, "\u22125.0000×10¹²"),
        (0.0, "0"),
        (None, "\u2014"),
    ],
)
def test_five_significant_digits(value: float | None, shown: str) -> None:
    assert number(value) == shown


def test_percent_is_signed_unless_zero() -> None:
    assert [percent(v) for v in (0.0255, -0.0262, 0.00001, -0.00001)] == [
        "+2.55",
        "\u22122.62",
        "0.00",
        "0.00",
    ]
    assert fixed(-0.0004, 2) == "0.00"


def test_names_units_and_entries() -> None:
    assert name_and_unit("flange_width_mm") == ("flange width", "mm")
    assert name_and_unit("Iw") == ("Iw", "mm⁶")
    assert symbol("K26") == "K₂₆"
    assert [entry_unit(e) for e in ("K11", "K26", "K55")] == ["N/mm", "N", "N·mm"]
    matrix = [[10 * i + j for j in range(1, 7)] for i in range(1, 7)]
    assert entry_of(matrix, "K35") == 35


def test_a_cell_is_cut_at_the_point() -> None:
    cell = Cell("\u22121234.50")
    assert (cell.whole, cell.fraction) == ("\u22121234", ".50")
    assert (Cell("17").whole, Cell("17").fraction) == ("17", "")
    assert [trimmed(t) for t in ("12.000", "2.200", "70", "1.0×10⁻⁷")] == ["12", "2.2", "70", "1.0×10⁻⁷"]
