"""What is certain though not all is explained."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from pipeline.answer.of_diagnosis import answered
from pipeline.campaign import Campaign
from pipeline.inference.load_cases import load_cases
from pipeline.inference.model import Model
from pipeline.inference.multistart import best_fit
from pipeline.selection.certain import falls
from pipeline.selection.criteria import CRITERIA
from pipeline.selection.diagnosis import diagnose
from tests.pipeline.selection.bench import bench, creeping_gauge, growing_gain, with_fault
from vjm.effects import catalogue
from vjm.effects.modulus_error import ModulusError

TILT = "mounting_tilt.rx_rad"
NAMES = (
    "bar_geometric_nonlinearity",
    "self_weight",
    "modulus_error",
    "load_offset",
    "joint_friction",
    "mounting_tilt",
)
KNOWN = {name: catalogue()[name] for name in NAMES}


def rippled(campaign: Campaign) -> Campaign:
    """A reading that swings as nothing known does."""
    tests = []
    for test in campaign.tests:
        moved = test.data.displacement.copy()
        moved[:, 1] += 0.006 * np.sin(2.5 * np.arange(len(moved)))
        tests.append(replace(test, data=replace(test.data, displacement=moved)))
    return replace(campaign, tests=tuple(tests))


def test_an_effect_is_certain_where_the_rest_is_not_explained() -> None:
    found = diagnose(rippled(bench(TILT, 0.004)), Model(), KNOWN)
    assert found.verdict == "unknown" and found.certain == ("mounting_tilt",)
    answer = answered(found)
    (it,) = answer.certain
    assert it.effect == "mounting_tilt" and it.parameters["rx_rad"] == pytest.approx(0.004, rel=0.05)
    assert answer.sentences[0].startswith("unknown: mounting_tilt (rx_rad = 0.00")
    assert "is certain" in answer.sentences[0]


@pytest.mark.long
def test_what_the_zero_of_a_sensor_would_do_as_well_is_not_certain() -> None:
    """A weight along z is a constant of the cell, which may have a zero of its own in each test."""
    found = diagnose(rippled(bench("self_weight.platform_z_N", -14.0)), Model(), KNOWN)
    assert "self_weight" in found.sets[0] and not found.certain


@pytest.mark.parametrize("fault", [growing_gain, pytest.param(creeping_gauge, marks=pytest.mark.long)])
def test_what_only_takes_up_the_fault_of_a_sensor_is_not(fault: object) -> None:
    assert not diagnose(with_fault(bench(), fault), Model(), KNOWN).certain  # type: ignore[arg-type]


def test_nothing_is_certain_of_a_bench_without_an_effect() -> None:
    assert not diagnose(bench(), Model(), KNOWN).certain


def test_each_pattern_more_leaves_less_and_the_right_one_leaves_noise() -> None:
    model = Model().with_effects([catalogue()["bar_geometric_nonlinearity"]])
    fit = best_fit(model, load_cases(with_fault(bench(), growing_gain)))
    left = falls(fit, CRITERIA, 4)
    assert left[0] == pytest.approx(float(fit.whitened @ fit.whitened))
    assert np.all(np.diff(left) <= 1e-9)
    assert left[1] < fit.degrees + 4.0 * np.sqrt(2.0 * fit.degrees) < left[0]


def test_friction_at_one_angle_alone_is_not_certain_to_be_the_friction_of_a_hinge() -> None:
    """Far more is left without it, and half of the tests would have none of it."""
    ids = ("axial_held_q+0", "swing_q+0", "swing_q+30", "axial_held_q+30")
    stuck, free = bench("joint_friction.torque_Nmm", 1000.0, ids), bench(ids=ids)
    pairs = zip(stuck.tests, free.tests, strict=True)
    tests = tuple(one if one.q > 0.3 else other for one, other in pairs)
    known = {name: catalogue()[name] for name in ("bar_geometric_nonlinearity", "joint_friction")}
    found = diagnose(replace(stuck, tests=tests), Model(), known)
    assert found.verdict == "unknown" and "joint_friction" in found.sets[0] and not found.certain
    # With the same friction in all of them a rest that is not explained leaves it certain.
    assert diagnose(rippled(stuck), Model(), known).certain == ("joint_friction",)


class Narrow(ModulusError):
    parameters = (replace(ModulusError.parameters[0], low=0.98, high=1.02),)


def test_nothing_is_certain_where_a_number_is_held_back() -> None:
    """Bars softer by more than a bound allows: what the number may not explain a constant load takes up."""
    campaign = rippled(bench("modulus_error.scale", 0.96))
    found = diagnose(campaign, Model(), {**KNOWN, "modulus_error": Narrow()})
    assert {"modulus_error", "load_offset"} <= set(found.sets[0])
    assert "modulus_error.scale" in found.decision.at_bound and not found.certain
