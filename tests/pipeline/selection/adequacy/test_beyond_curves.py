"""The scatter of each sensor is found beside a misfit of a model, which is smooth."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from pipeline.campaign import Campaign
from pipeline.campaign.names import DISPLACEMENTS, WRENCHES
from pipeline.inference.fit import Fit, unfitted
from pipeline.inference.load_cases import load_cases
from pipeline.inference.model import Model
from pipeline.selection.adequacy.beyond_curves import _blind, scatters_beyond_curves
from pipeline.selection.adequacy.scatter import Scatter, scatters
from pipeline.selection.criteria import CRITERIA
from pipeline.selection.reading_noise import AS_DECLARED
from tests.pipeline.selection.bench import bench, cross_talk, growing_gain, with_fault
from vjm.effects import catalogue

IDS = ("axial_held_q+0", "axial_held_q+30", "swing_q+0", "swing_q+30", "lateral_q+0")
COLUMNS = (*DISPLACEMENTS, *WRENCHES)
SEEDS = (1, 2, 3)


def declared(it: Campaign, factors: dict[str, float]) -> Campaign:
    """With sigmas declared too large by these factors."""
    sigmas = np.concatenate([it.noise.displacement, it.noise.wrench])
    for column, factor in factors.items():
        sigmas[COLUMNS.index(column)] *= factor
    return replace(it, noise=replace(it.noise, displacement=sigmas[:6], wrench=sigmas[6:]))


def of(it: Campaign) -> Fit:
    return unfitted(Model().with_effects([catalogue()["bar_geometric_nonlinearity"]]), load_cases(it))


def told(it: Campaign) -> dict[str, Scatter]:
    return {COLUMNS[each.channel]: each for each in scatters_beyond_curves(of(it), CRITERIA)}


@pytest.mark.parametrize("count", [4, 6, 9])
def test_combinations_leave_nothing_of_a_parabola_and_keep_noise_white(count: int) -> None:
    w, u = _blind(count), np.arange(count)
    np.testing.assert_allclose(w @ np.column_stack([u**0, u, u**2]), 0.0, atol=1e-12 * count**2)
    np.testing.assert_allclose(w @ w.T, np.eye(count - 3), atol=1e-12)
    # The first bends least: it alone sees a cubic.
    np.testing.assert_allclose((w @ u**3)[1:], 0.0, atol=1e-10 * count**3)


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize(
    "hidden", [("", 0.0), ("modulus_error.scale", 0.97), ("joint_friction.torque_Nmm", 300.0)]
)
def test_a_right_sigma_is_left_alone(hidden: tuple[str, float], seed: int) -> None:
    """Beside a misfit of noise alone, one that is smooth and one with kinks."""
    assert not told(bench(*hidden, ids=IDS, seed=seed))


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize("fault", [growing_gain, cross_talk])
def test_a_wrong_one_is_found_beside_a_misfit(fault: object, seed: int) -> None:
    it = with_fault(bench("base_compliance.ry_rad_per_Nmm", 2e-9, ids=IDS, seed=seed), fault)  # type: ignore[arg-type]
    found = told(declared(it, {"mz_Nmm": 2.5, "mx_Nmm": 0.4}))
    # A sigma that is too small is not told from kinks.
    assert set(found) == {"mz_Nmm"}
    assert abs(np.log(found["mz_Nmm"].factor * 2.5)) < 3.5 * found["mz_Nmm"].error


def test_what_a_model_leaves_is_no_scatter() -> None:
    """About the model itself it is: a fifth of a sigma of a channel and more, in the place of noise."""
    it = of(with_fault(bench(ids=IDS), growing_gain))
    about = {COLUMNS[each.channel]: each for each in scatters(it) if each.channel < 12}
    assert any(each.differs(CRITERIA, unexplained=True) for each in about.values())
    assert not scatters_beyond_curves(it, CRITERIA)


def test_kinks_of_a_few_tests_are_no_scatter() -> None:
    """A reading that jumps between two values in one test."""
    it = bench(ids=IDS)
    first, *rest = it.tests
    moved = first.data.displacement.copy()
    moved[:, 1] += 20.0 * it.noise.displacement[1] * np.sign(np.sin(2.1 * np.arange(len(moved))))
    jumping = replace(it, tests=(replace(first, data=replace(first.data, displacement=moved)), *rest))
    assert not told(jumping)


def test_it_is_asked_where_what_is_left_has_an_order() -> None:
    it = declared(with_fault(bench(ids=IDS), growing_gain), {"mz_Nmm": 2.5})
    found, given = of(it), load_cases(it)
    new = AS_DECLARED.again(found, given, CRITERIA)
    assert [COLUMNS[each.channel] for each in new.scatter] == ["mz_Nmm"] and not new.bad and new.tails is None
    # Once it is known, it stays as it is.
    assert new.again(found, given, CRITERIA) is new
