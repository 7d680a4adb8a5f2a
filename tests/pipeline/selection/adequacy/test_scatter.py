"""The scatter of each sensor is found from residuals in which the errors of several mix."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from pipeline.campaign import Campaign
from pipeline.campaign.names import DISPLACEMENTS, WRENCHES
from pipeline.inference.fit import Fit, unfitted
from pipeline.inference.load_cases import load_cases
from pipeline.inference.model import Model
from pipeline.selection.adequacy.scatter import scatters
from pipeline.selection.criteria import CRITERIA
from tests.pipeline.selection.bench import bench
from vjm.effects import catalogue

IDS = ("axial_held_q+0", "axial_held_q+30", "swing_q+0", "swing_q+30", "lateral_q+0")
COLUMNS = (*DISPLACEMENTS, *WRENCHES)


def declared(factors: dict[str, float], seed: int = 1) -> Campaign:
    """The bench with sigmas declared too large by these factors."""
    it = bench(ids=IDS, seed=seed)
    sigmas = np.concatenate([it.noise.displacement, it.noise.wrench])
    for column, factor in factors.items():
        sigmas[COLUMNS.index(column)] *= factor
    return replace(it, noise=replace(it.noise, displacement=sigmas[:6], wrench=sigmas[6:]))


def of(it: Campaign) -> Fit:
    return unfitted(Model().with_effects([catalogue()["bar_geometric_nonlinearity"]]), load_cases(it))


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_a_right_sigma_is_left_alone(seed: int) -> None:
    found = scatters(of(declared({}, seed)))
    assert found and not any(it.differs(CRITERIA, unexplained=False) for it in found)


def test_sigmas_that_are_wrong_are_found_sensor_by_sensor() -> None:
    wrong = {"mz_Nmm": 2.0, "mx_Nmm": 0.5}
    found = {COLUMNS[it.channel]: it for it in scatters(of(declared(wrong))) if it.channel < 12}
    for column, factor in wrong.items():
        it = found[column]
        assert abs(np.log(it.factor * factor)) < 3.0 * it.error
        assert it.differs(CRITERIA, unexplained=True)
    others = [it for column, it in found.items() if column not in wrong]
    assert not any(it.differs(CRITERIA, unexplained=False) for it in others)


def test_what_is_declared_does_not_change_what_is_found() -> None:
    """The scatter in units is the same, whatever was declared."""
    one, other = (
        {it.channel: it for it in scatters(of(declared({"mz_Nmm": factor})))} for factor in (1.0, 3.0)
    )
    channel = COLUMNS.index("mz_Nmm")
    assert other[channel].factor * 3.0 == pytest.approx(one[channel].factor, rel=0.02)


def test_rows_far_out_do_not_pass_for_scatter() -> None:
    it = declared({})
    test = it.tests[2]
    wrench = test.data.wrench.copy()
    wrench[4, 4] += 40.0 * it.noise.wrench[4]
    knocked = replace(test, data=replace(test.data, wrench=wrench))
    it = replace(it, tests=(*it.tests[:2], knocked, *it.tests[3:]))
    assert not any(each.differs(CRITERIA, unexplained=False) for each in scatters(of(it)))
