"""A soft clamp under one dial and a gauge: of the six compliances of the base the readings see two. What they do not
see is counted by no command, and stays open in the saved model: a prediction that it matters to has a wide interval.
"""

from __future__ import annotations

from pathlib import Path

import pytest

import parastiff
from tests.cases.test_knocked_rows import LENGTH, TURN, E, loads, measured

SEEN = {"base_compliance.y_mm_per_N", "base_compliance.rz_rad_per_Nmm"}


@pytest.fixture
def bench(tmp_path: Path) -> parastiff.Bench:
    measured(tmp_path, loads(7), TURN, {})
    return parastiff.open(tmp_path)


def test_every_command_says_the_same_error(bench: parastiff.Bench) -> None:
    found, added = bench.diagnose(), bench.add("base_compliance")
    assert found.answer.added == added.answer.added == ("base_compliance",)
    assert added.answer.error[-1].degrees == found.answer.error[-1].degrees == 14 - len(SEEN)
    assert added.answer.error[-1].fit == pytest.approx(found.answer.error[-1].fit, abs=0.005)
    # A tilt and a bow are alike to the base to first order, and leave 16 sigma where they are fitted in its place.
    assert found.answer.evidence is not None and not found.answer.evidence.look_alikes
    again = added.diagnose()
    assert again.verdict == "within_noise"
    assert again.answer.error[-1].fit == pytest.approx(found.answer.error[-1].fit, abs=0.005)
    saved = next(it for it in added.compare().record.models if it.model == "saved")
    assert saved.degrees == 14 - len(SEEN)


def test_a_saved_model_does_not_say_that_it_knows_them(bench: parastiff.Bench, tmp_path: Path) -> None:
    found = bench.improve()
    told = {name for name, it in found.answer.parameters.items() if it.interval != "fixed"}
    assert told == SEEN
    found.save_model()
    saved = parastiff.open(tmp_path)
    assert not saved.model.fixed
    table = tmp_path / "at.csv"
    table.write_text("test,fy_N,fz_N\ntest-1,0,10\n")
    (row,) = saved.predict(table).record.rows
    z = next(it for it in row.readings if it.column == "z_mm")
    # A clamp that gives alike about both axes.
    true = 10.0 * LENGTH**3 / (3.0 * E * 12.0 * 20.0**3 / 12.0) + TURN * 10.0 * LENGTH**2
    assert z.low95 < true < z.high95
