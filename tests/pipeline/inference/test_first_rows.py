"""Sensors that were zeroed at a first row: the noise of that reading is in all others, and no effect is seen in it."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from pipeline.campaign import Campaign, Data, read
from pipeline.campaign.model import Zero
from pipeline.campaign.names import channel_columns
from pipeline.inference.fit import Fit, unfitted
from pipeline.inference.load_cases import load_cases
from pipeline.inference.model import Model
from pipeline.selection.adequacy.judgement import judge
from tests.pipeline.selection.bench import bench
from vjm.effects import catalogue

SLENDER = Model().with_effects([catalogue()["bar_geometric_nonlinearity"]])
IDS = ("axial_held_q+0", "axial_held_q+30", "lateral_q+0", "swing_q+0")


def left(campaign: Campaign) -> Fit:
    return unfitted(SLENDER, load_cases(campaign))


def with_data(campaign: Campaign, zero: Zero = "nominal", first: bool = False, off: float = 0.0) -> Campaign:
    """With zeros as they are said, every reading less its first one where `first`, and x off by mm."""
    columns = channel_columns(campaign.gauges)
    own = frozenset(columns) if first else frozenset[str]()

    def changed(data: Data) -> Data:
        new = data.readings.copy()
        new[:, 0] += off
        if first:
            new -= new[:1]
        parts = {"displacement": new[:, :6], "wrench": new[:, 6:12], "gauges": new[:, 12:]}
        return replace(data, from_first=own, **parts)

    return replace(campaign, tests=tuple(replace(t, zero=zero, data=changed(t.data)) for t in campaign.tests))


@pytest.mark.parametrize("seed", [1, 2, 3, 4])
def test_the_noise_of_the_first_reading_is_no_misfit(seed: int) -> None:
    """Readings less their first ones, sensors tared there, and zeros that are not known: each is noise alone."""
    given = bench(ids=IDS, seed=seed)
    for it in (
        given,
        with_data(given, "first_row"),
        with_data(given, first=True),
        with_data(given, "fitted", off=2.37),
    ):
        found = left(it)
        assert judge(found).noise, (it.tests[0].zero, found.rms)
        assert 0.8 < found.rms < 1.2


def test_a_constant_that_was_taken_away_changes_nothing() -> None:
    """To the last digits that the constant leaves: it is what an unknown zero is."""
    given = bench(ids=IDS)
    one, other = (left(with_data(given, first=True, off=off)) for off in (0.0, 2.37))
    assert one.chi_square == pytest.approx(other.chi_square, rel=1e-9)
    assert one.degrees == other.degrees < left(given).degrees


def test_columns_that_begin_at_their_first_reading_are_known_by_the_file(tmp_path: Path) -> None:
    text = """schema = 1
name = "first"

[rig]
kind = "bar"
length_mm = 300.0
bar = { EA_N = 4.2e7, EIy_Nmm2 = 2.2e9, EIz_Nmm2 = 2.2e8, GJ_Nmm2 = 3e8 }
base = "clamped"
tip = "free"

[noise]
y_mm = 0.002
z_mm = 0.002
fy_N = 0.1

[columns]
"dial" = { is = "y", unit = "mm", zero = "first_row" }

[[tests]]
id = "a"
role = "fit"
control = { x = "force", y = "force", z = "force", rx = "force", ry = "force", rz = "force" }
"""
    (tmp_path / "campaign.toml").write_text(text, encoding="utf-8")
    (tmp_path / "measurements.csv").write_text(
        "test,step,dial,z_mm,fy_N\na,0,2.37,0,0\na,1,2.78,0,10\n", encoding="utf-8"
    )
    it = read(tmp_path)
    assert it.tests[0].data.from_first == {"y_mm"}
    cases = load_cases(it)
    assert np.flatnonzero(cases.loose[0]).tolist() == [1] and cases.unknown_zeros == 1
