"""A constant of one channel is found, and once it is taken out of the readings nothing of it is left."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from pipeline.campaign import Data
from pipeline.campaign.names import channel_columns
from pipeline.inference.fit import unfitted
from pipeline.inference.load_cases import load_cases
from pipeline.inference.model import Model, Term
from pipeline.selection.criteria import CRITERIA
from pipeline.selection.sensor_faults import fitted_beside
from pipeline.selection.unknown_zeros import left_beside, taken_out, zeros
from tests.pipeline.selection.bench import bench, with_fault
from vjm.effects import catalogue

SLENDER = Model((Term(catalogue()["bar_geometric_nonlinearity"], {}),))


@pytest.mark.parametrize(
    ("column", "constant"),
    [("y_mm", 0.4), ("fx_N", -200.0), ("z_mm", 0.25)],
    ids=["read", "prescribed force", "prescribed displacement"],
)
def test_a_constant_is_taken_out_with_its_sign(column: str, constant: float) -> None:
    given = bench(ids=("axial_held_q+30", "lateral_q+0"))
    channel = channel_columns(given.gauges).index(column)
    error = np.zeros(12 + len(given.gauges))
    error[channel] = constant

    def off(data: Data) -> Data:
        new = data.readings + error
        return replace(data, displacement=new[:, :6], wrench=new[:, 6:12], gauges=new[:, 12:])

    found = unfitted(SLENDER, load_cases(with_fault(given, off)))
    zero = next(it for it in zeros(found, CRITERIA) if it.everywhere and f"{it.column}_{it.unit}" == column)
    assert zero.value == pytest.approx(constant, abs=max(5.0 * zero.std, 0.02 * abs(constant)))
    mended = taken_out(found.residual.load_cases.campaign, zero)
    for test, original in zip(mended.tests, given.tests, strict=True):
        left = test.data.readings - original.data.readings
        assert np.nanmax(np.abs(np.delete(left, channel, axis=1))) == 0.0
        assert np.allclose(left[:, channel], constant - zero.value, equal_nan=True)
    beside = fitted_beside(found, zero, CRITERIA.plausible)
    assert beside.chi_square == pytest.approx(left_beside(found, zero), rel=0.05)
    assert beside.chi_square < 2.0 * beside.degrees < 1e-2 * found.chi_square
