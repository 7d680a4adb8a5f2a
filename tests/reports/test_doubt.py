"""What the page of a campaign shows of tables, of what was written, and of readings."""

from __future__ import annotations

from reports.blocks import Bullets, Table, Text
from reports.campaign import doubt
from reports.formats import DASH

NOMINAL = {
    "name": "EIz",
    "nominal": 1.0,
    "tolerance": 0.02,
    "value": 1.031,
    "std": 0.004,
    "pull": 1.55,
    "unit": "1",
    "meaning": "bending",
    "seen": True,
}
PAGE = {
    "doctor": [{"hypothesis": "all forces are in kgf", "mend": "multiply fx_N by 9.80665"}],
    "nominals": [
        NOMINAL,
        {**NOMINAL, "name": "GJ", "seen": False, "pull": 9.0},
        {**NOMINAL, "name": "EA", "pull": -3.4},
    ],
    "set_aside": [{"test": "axial", "step": 5, "column": "x_mm", "sigma": 31.2}],
    "noise": [
        {"column": "fy_N", "declared": 0.5, "found": 1.02, "tails": None, "correlation": None},
        {"column": "x_mm", "declared": 0.001, "found": 0.001, "tails": 3.1, "correlation": None},
        {"column": "z_mm", "declared": 0.001, "found": 0.001, "tails": None, "correlation": 0.62},
    ],
}


def texts(it: Table) -> list[list[str]]:
    return [[cell.text for cell in row] for row in it.rows]


def test_all_of_it_in_order() -> None:
    said, mends, *tables = list(doubt.blocks(PAGE))
    assert isinstance(said, Text) and isinstance(mends, Bullets)
    nominals, aside, noise = (it for it in tables if isinstance(it, Table))
    rows = texts(nominals)
    assert [row[0].code for row in nominals.rows] == ["EIz", "GJ", "EA"]
    assert rows[0][:6] == [NOMINAL["meaning"], "1.000", "0.0200", "1.031", "0.0040", "+1.6"]
    # What the tests do not see has no value of theirs.
    assert rows[1][3:6] == [DASH, DASH, DASH] and nominals.rows[1][0].mark == "not seen"
    assert rows[2][5] == "−3.4" and nominals.rows[2][0].mark == "far"
    assert texts(aside) == [["axial", "5", "x_mm", "31.2"]]
    assert texts(noise)[0] == ["Fy", "0.500", "1.02", "normal"]
    assert texts(noise)[1][3] == "Student's t, 3.1 degrees"
    assert texts(noise)[2][3] == "normal, neighbouring rows correlated by 0.62"


def test_nothing_is_no_section() -> None:
    assert not doubt.known({}) and not doubt.known({"nominals": [], "noise": []})
    assert doubt.known({"set_aside": PAGE["set_aside"]})
