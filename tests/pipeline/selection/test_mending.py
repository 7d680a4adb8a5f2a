"""A line of campaign.toml is offered only where the file, read with it, is as the doctor has mended it."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from pipeline.campaign import read, write
from pipeline.campaign.edited import same
from pipeline.selection.criteria import CRITERIA
from pipeline.selection.doctor import Suspicion
from pipeline.selection.mending import RIGHT, Mend, mends
from pipeline.selection.mistakes import possible
from pipeline.selection.mistakes.base import Mistake
from tests.pipeline.bench import bench
from tests.pipeline.campaign.mapped_tables import FZ, Z, campaign, table
from tests.pipeline.selection.mistakes import made


def mistakes(folder: Path) -> dict[str, Mistake]:
    return {it.words: it for it in possible(read(folder), CRITERIA)}


def offered(folder: Path, words: str) -> tuple[Mend, ...]:
    """What mends that mistake; the last offer, that there is none, is looked at by a test of its own."""
    *found, last = mends(folder, [Suspicion(mistakes(folder)[words], 1.0, 0.0, frozenset())], None)
    assert last.words == RIGHT
    return tuple(found)


WRONG = {
    "all forces have the wrong sign": (
        made.over(-1.0, *made.FORCES),
        '[columns] fy_N = {is = "fy", sign = -1}',
    ),
    "fx_N and fy_N are exchanged": (
        made.exchanged("fx_N", "fy_N"),
        '[columns] fx_N = {is = "fy", unit = "N"}',
    ),
    "x_mm was not zeroed: absolute positions or loads": (
        made.shifted(30.0, "x_mm"),
        '[columns] x_mm = {is = "x", zero = "first_row"}',
    ),
    "q_deg is in radians": (made.angles_in_radians, "[[tests]] swing_q+30: q_deg = 30.0"),
}


@pytest.mark.parametrize("words", WRONG)
def test_what_the_columns_of_the_contract_have_wrong_is_a_line(words: str, tmp_path: Path) -> None:
    wrong, line = WRONG[words]
    right = bench("modulus_error.scale", 0.95)
    write(tmp_path / "rig", wrong(right))
    before = (tmp_path / "rig" / "campaign.toml").read_bytes()
    (it,) = offered(tmp_path / "rig", words)
    assert it.words == words and line in it.lines
    assert (tmp_path / "rig" / "campaign.toml").read_bytes() == before
    (tmp_path / "rig" / "campaign.toml").write_text(it.text, encoding="utf-8")
    now = read(tmp_path / "rig")
    assert same(now, right) or "zeroed" in words
    assert not same(now, wrong(right))


def test_that_the_table_is_right_is_a_line_too(tmp_path: Path) -> None:
    write(tmp_path, made.over(-1.0, *made.FORCES)(bench("modulus_error.scale", 0.95)))
    given = read(tmp_path)
    it = mends(tmp_path, [Suspicion(next(iter(possible(given, CRITERIA))), 1.0, 0.0, frozenset())], None)[-1]
    assert it.lines == ("table_checked = true",)
    (tmp_path / "campaign.toml").write_text(it.text, encoding="utf-8")
    now = read(tmp_path)
    assert now.table_checked and not given.table_checked and same(replace(now, table_checked=False), given)
    assert mends(tmp_path, [], None) == ()


def test_a_unit_is_a_line_where_the_header_names_none(tmp_path: Path) -> None:
    columns = '[columns]\nWeg = { is = "z", unit = "mm" }\nKraft = { is = "fz", unit = "N" }\n'
    (tmp_path / "a").mkdir()
    right = campaign(tmp_path / "a", columns, table(["test", "step", "Weg", "Kraft"], *_rows(FZ)))
    (tmp_path / "b").mkdir()
    campaign(tmp_path / "b", columns, table(["test", "step", "Weg", "Kraft"], *_rows(FZ / 9.80665)))
    (it,) = offered(tmp_path / "b", "fz_N is in kgf")
    assert it.lines == ('[columns] Kraft = {is = "fz", unit = "kgf"}',)
    (tmp_path / "b" / "campaign.toml").write_text(it.text, encoding="utf-8")
    assert same(read(tmp_path / "b"), right)


def test_none_where_the_header_says_otherwise_or_the_cell_is_turned(tmp_path: Path) -> None:
    """What the file says of its unit is not overruled; the sign of a column of a turned cell is another."""
    (tmp_path / "a").mkdir()
    campaign(tmp_path / "a", "", table(["test", "step", "z_mm", "fz_N"], *_rows(FZ)))
    assert offered(tmp_path / "a", "fz_N is in kgf") == ()
    assert offered(tmp_path / "a", "fz_N has the wrong sign")
    (tmp_path / "b").mkdir()
    cell = "[cell]\nturned_deg = [0.0, 30.0, 0.0]\n"
    forces = [*_rows(FZ), FZ * 0.1]
    campaign(tmp_path / "b", cell, table(["test", "step", "z_mm", "fz_N", "fx_N"], *forces))
    assert offered(tmp_path / "b", "fz_N has the wrong sign") == ()


def _rows(fz: object) -> list[object]:
    return [["load"] * len(Z), [str(k) for k in range(len(Z))], Z, fz]
