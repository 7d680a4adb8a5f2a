"""Numbers about which the tests say nothing: no variance of theirs, and no covariance with others either."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from pipeline.inference.fit import fit
from pipeline.inference.load_cases import load_cases
from pipeline.inference.model import Model
from pipeline.selection.adequacy.judgement import HELD_OUT, judge
from tests.pipeline.bench import bench
from vjm.effects import catalogue

FEW, MORE = "lateral_q+0", "axial_held_q+0"
"""Moved sideways alone, compliances of the base and of the drives are not told apart."""


@pytest.mark.parametrize("effects", [("base_compliance",), ("base_compliance", "axis_flexibility")])
def test_what_is_known_of_the_numbers_is_a_covariance(effects: tuple[str, ...]) -> None:
    whole = bench("modulus_error.scale", 0.93)
    roles = {FEW: "fit", MORE: "holdout"}
    tests = tuple(replace(it, role=roles[it.id]) for it in whole.tests if it.id in roles)
    model = Model().with_effects([catalogue()[name] for name in effects])
    found = fit(model, load_cases(replace(whole, tests=tests)), plausible=20.0)
    typical = np.array([abs(each.parameter.typical) for each in found.model.free])
    unknown = np.isinf(np.diag(found.covariance))
    assert unknown.any() and not unknown.all()
    known = found.finite_covariance / np.outer(typical, typical)
    assert not known[unknown].any()
    values = np.linalg.eigvalsh(known)
    assert values[0] > -1e-12 * values[-1]
    held = next(check for check in judge(found).checks if check.name == HELD_OUT)
    assert 0.0 <= held.p_value <= 1.0
