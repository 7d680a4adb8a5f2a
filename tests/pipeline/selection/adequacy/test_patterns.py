"""Patterns of a sensor follow what it read, not the noise of a coordinate that was held where it is."""

from __future__ import annotations

from dataclasses import replace

import pytest

from pipeline.campaign import Data
from pipeline.inference.fit import unfitted
from pipeline.inference.load_cases import load_cases
from pipeline.inference.model import Model
from pipeline.selection.adequacy.patterns import shapes
from pipeline.selection.criteria import CRITERIA
from tests.pipeline.selection.bench import bench, with_fault
from vjm.effects import catalogue

SLENDER = Model().with_effects([catalogue()["bar_geometric_nonlinearity"]])


def never_read(data: Data) -> Data:
    """Turns that were held and not read, typed in as zeros."""
    displacement = data.displacement.copy()
    displacement[:, 3:] = 0.0
    return replace(data, displacement=displacement)


@pytest.mark.parametrize("read", [True, False])
def test_a_coordinate_that_was_held_has_no_gain_and_may_have_an_offset(read: bool) -> None:
    """The inputs that fit best follow the residual, read or not: a gain of them would be found in any misfit."""
    given = bench(
        "joint_friction.torque_Nmm", 600.0, ids=("axial_held_q+0", "axial_held_q+30", "lateral_q+0")
    )
    found = unfitted(SLENDER, load_cases(given if read else with_fault(given, never_read)))
    said = {it.words for it in shapes(found, CRITERIA)}
    assert "ry has an offset" in said and "ry reads too much or too little in proportion" not in said
    assert "ry has a gain that grows one way" not in said and "ry follows slowly" not in said
    # What was moved in one of the tests still has one.
    assert "y reads too much or too little in proportion" in said
