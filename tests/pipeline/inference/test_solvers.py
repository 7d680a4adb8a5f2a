"""The own solver beside scipy's: the same least chi-square, and the same ridges said."""

from __future__ import annotations

import pytest

from pipeline.inference.fit import Fit, fit
from pipeline.inference.load_cases import load_cases
from pipeline.inference.model import Model
from pipeline.inference.prior import implausibility
from pipeline.inference.solvers import far, trust_region
from pipeline.selection.criteria import CRITERIA
from pipeline.selection.determined import undetermined
from tests.pipeline.selection.bench import AXIAL, MIXED, bench
from vjm.effects import catalogue

BENT = "bar_geometric_nonlinearity"


def pulled(found: Fit) -> float:
    """What both make least: chi-square, and how far the parameters are from plausible ones."""
    return found.chi_square + implausibility(found.model.free, found.model.values, CRITERIA.plausible)


@pytest.mark.parametrize(
    ("hidden", "value", "ids", "names"),
    [
        ("axis_flexibility.radial_mm_per_N", 1e-6, MIXED, (BENT, "axis_flexibility", "modulus_error")),
        pytest.param(
            "base_compliance.x_mm_per_N", 3e-6, AXIAL, (BENT, "base_compliance"), marks=pytest.mark.long
        ),
        pytest.param(
            "joint_clearance.play_mm", 0.02, AXIAL, (BENT, "joint_clearance"), marks=pytest.mark.long
        ),
        pytest.param(
            "joint_friction.torque_Nmm", 200.0, MIXED[:3], (BENT, "joint_friction"), marks=pytest.mark.long
        ),
        pytest.param(
            "bar_initial_bow.bow_y_mm", 0.1, AXIAL, (BENT, "bar_initial_bow"), marks=pytest.mark.long
        ),
        # Far above noise, along a curved ridge: a modulus three times as large.
        pytest.param(
            "bar_initial_bow.bow_y_mm",
            0.1,
            AXIAL,
            ("modulus_error", "axis_flexibility"),
            marks=pytest.mark.long,
        ),
        # Ridges: axial loads say little of a weight, and nothing of the width.
        pytest.param(
            "base_compliance.x_mm_per_N",
            3e-6,
            AXIAL,
            (BENT, "dimension_error", "self_weight"),
            marks=pytest.mark.long,
        ),
    ],
)
def test_both_end_at_the_same_least(
    hidden: str, value: float, ids: tuple[str, ...], names: tuple[str, ...]
) -> None:
    cases = load_cases(bench(hidden, value, ids))
    model = Model().with_effects([catalogue()[name] for name in names])
    own = fit(model, cases, plausible=CRITERIA.plausible)
    other = fit(model, cases, plausible=CRITERIA.plausible, solver=trust_region)
    # Far above noise a fit ends where a step promises little beside all that is left: no verdict hangs on it.
    near = 1e-3 if far(own.chi_square, own.whitened.size) else 1e-5
    assert pulled(own) == pytest.approx(pulled(other), rel=near, abs=1e-3)
    assert undetermined(own, cases) == undetermined(other, cases)
    if "dimension_error" in names:
        assert "dimension_error.width_mm" in undetermined(own, cases)
