"""Campaigns on a manipulator: readings are its equilibria, derivatives are differences, LIN and FEA are F = K t."""

from __future__ import annotations

import pickle
from dataclasses import replace

import numpy as np
import pytest

from pipeline.campaign import Campaign, ManipulatorRig
from pipeline.inference.frame_prediction import predict_frame
from pipeline.inference.linear_prediction import predict_linear
from pipeline.inference.load_cases import LoadCases, load_cases
from pipeline.inference.model import Model, Term
from pipeline.inference.prediction import predict
from pipeline.inference.subsets import carried
from pipeline.manipulator.table import vjm_stiffness
from tests.pipeline.inference import manipulators
from tests.pipeline.inference.manipulators import LOADS, POINTS, STEPS, WAY
from tests.vjm.manipulator.example import under
from vjm.effects import catalogue
from vjm.manipulator.posture import postures

KNOWN = catalogue()
SPRUNG = {"stiffness_Nmm_per_rad": 2000.0}
SCALE = np.array([1e-3, 1e-3, 1e-3, 1e-5, 1e-5, 1e-5, 1.0, 1.0, 1.0, 50.0, 50.0, 50.0])
"""About the noise of each channel."""


@pytest.fixture(scope="module")
def small() -> Campaign:
    return manipulators.campaign()


@pytest.fixture(scope="module")
def cases(small: Campaign) -> LoadCases:
    return load_cases(small)


def model(**values: dict[str, float]) -> Model:
    return Model(tuple(Term(KNOWN[name], own) for name, own in values.items()))


def test_tests_of_all_postures_are_a_group(small: Campaign, cases: LoadCases) -> None:
    (group,) = cases.groups
    assert group.numbers.tolist() == [0, 1, 2]
    np.testing.assert_array_equal(group.nominal[2, 0], [*POINTS[1], 0.0, 0.0, 0.0])
    other = replace(small.tests[2], rig=replace(small.tests[2].rig, gravity=(0.0, 0.0, -1.0)))
    apart = load_cases(replace(small, tests=(*small.tests[:2], other)))
    assert [it.numbers.tolist() for it in apart.groups] == [[0, 1], [2]]
    sent = pickle.loads(pickle.dumps(small))
    assert [it.numbers.tolist() for it in load_cases(sent).groups] == [[0, 1, 2]]


@pytest.mark.parametrize("name", ["joint_friction", "bar_length_mismatch", "joint_clearance"])
def test_postures_together_are_each_by_itself(cases: LoadCases, name: str) -> None:
    """A part of a campaign is another batch, and where it begins is a state of the whole."""
    turned = {"bar_length_mismatch": {"mismatch_mm": 0.05}, "joint_torsional_stiffness": SPRUNG}
    rough = {"joint_friction": {"torque_Nmm": 50.0, "presliding_rad": 1e-5}}
    loose = {"joint_clearance": {"play_mm": 0.02}, **turned}
    one = model(**{"joint_friction": rough, "joint_clearance": loose}.get(name, turned))
    whole = predict(one, cases)
    for rows in (np.arange(8), np.arange(8, 12)):
        part = cases.only(rows)
        for start in (None, carried(whole, part, cases)):
            alone = predict(one, part, start=start)
            np.testing.assert_allclose(alone.values / SCALE, whole.values[rows] / SCALE, atol=1e-7)
            np.testing.assert_allclose(alone.by_free, whole.by_free[rows], rtol=1e-5, atol=1e-7)


def test_hinges_relaxed_where_unequal_bars_turn_them_follow_the_bars(cases: LoadCases) -> None:
    """The turns are inputs of a posture that a number of the model moves: the derivative has their part."""

    def values(mismatch: float) -> Model:
        return model(
            bar_length_mismatch={"mismatch_mm": mismatch},
            joint_torsional_stiffness={k: 100.0 * v for k, v in SPRUNG.items()},
        )

    found = predict(values(0.5), cases)
    ends = [predict(values(0.5 + side), cases, slopes=False).values for side in (5e-3, -5e-3)]
    slope = (ends[0] - ends[1]) / 1e-2
    assert np.max(np.abs(slope) / SCALE) > 1.0
    np.testing.assert_allclose(
        found.by_free[..., 0] / SCALE, slope / SCALE, atol=1e-4 * np.max(np.abs(slope) / SCALE)
    )


def test_readings_are_the_equilibria_of_the_manipulator(small: Campaign, cases: LoadCases) -> None:
    """Loads read are true moments, those of the bare solver conjugate to the rotation vector: at 1 mrad and 3 N·m they
    differ by 1.5 N·mm at most."""
    found = predict(Model(), cases)
    assert not found.lost.any()
    whole = small.rig.manipulator
    assert whole is not None
    for rows, point in ((slice(0, 4), POINTS[0]), (slice(8, 12), POINTS[1])):
        at = postures(whole, np.tile(point, (STEPS.size, 1)))
        state = under(whole, at, STEPS[:, None] * LOADS)
        moved = state.pose - at.pose
        np.testing.assert_allclose(found.values[rows, :6] / SCALE[:6], moved / SCALE[:6], atol=2e-2)
        np.testing.assert_allclose(found.values[rows, 6:], STEPS[:, None] * LOADS, atol=1e-6)
    sliding = found.values[4:8]
    np.testing.assert_allclose(sliding[:, [0, 5]], STEPS[:, None] * WAY[[0, 5]], atol=1e-12)
    np.testing.assert_allclose(sliding[:, 7:11], STEPS[:, None] * LOADS[1:5], atol=1e-6)


@pytest.mark.long
def test_derivatives_by_what_is_prescribed_are_differences(cases: LoadCases) -> None:
    """Steps of a noise each: the curvature over one is a millionth of the slope."""
    plain = predict(Model(), cases)
    for k in range(6):
        shift = np.zeros_like(plain.shift)
        size = np.where(cases.channels[:, k] < 6, SCALE[k], SCALE[6 + k])
        shift[:, k] = size
        ends = [predict(Model(), cases, shift=sign * shift).values for sign in (1.0, -1.0)]
        slope = (ends[0] - ends[1]) / (2.0 * size[:, None])
        gap = (slope - plain.by_inputs[..., k]) * size[:, None] / SCALE
        assert np.max(np.abs(gap)) < 1e-4


@pytest.mark.parametrize(
    "name",
    [
        "load_offset",
        pytest.param("modulus_error", marks=pytest.mark.long),
        pytest.param("base_compliance", marks=pytest.mark.long),
    ],
)
def test_derivatives_by_numbers_are_differences(cases: LoadCases, name: str) -> None:
    effect = KNOWN[name]
    first = effect.parameters[0]
    one = model(**{name: effect.typicals})
    found = predict(one, cases)
    step = 0.01 * first.typical
    ends = [
        predict(
            model(**{name: effect.typicals | {first.name: first.null + first.typical + side}}), cases
        ).values
        for side in (step, -step)
    ]
    slope = (ends[0] - ends[1]) / (2.0 * step)
    gap = np.abs(slope - found.by_free[..., 0]) * first.typical / SCALE
    assert np.max(np.abs(slope)) > 0.0 and np.max(gap) < 1e-3 * max(
        1.0, np.max(np.abs(slope) * first.typical / SCALE)
    )


def test_effects_reach_the_whole_manipulator(cases: LoadCases) -> None:
    """Softer bars let the platform move more, in every direction that is loaded."""
    plain = predict(Model(), cases, slopes=False).values
    soft = predict(model(modulus_error={"scale": 0.7}), cases, slopes=False).values
    assert np.all(np.abs(soft[:4, :6]) > np.abs(plain[:4, :6]))


def test_friction_remembers_the_steps_before(cases: LoadCases) -> None:
    """The last step comes after a reversal: alone it would read otherwise."""
    rough = model(joint_friction={"torque_Nmm": 50.0, "presliding_rad": 1e-5})
    whole = predict(rough, cases, slopes=False)
    assert not whole.lost.any()
    alone = predict(rough, cases.only(np.array([3])), slopes=False)
    assert np.max(np.abs(whole.values[3, :6] - alone.values[0, :6]) / SCALE[:6]) > 0.1


def test_states_to_begin_from_change_nothing(cases: LoadCases) -> None:
    whole = predict(model(modulus_error={"scale": 0.9}), cases)
    again = predict(model(modulus_error={"scale": 0.9}), cases, start=whole)
    np.testing.assert_allclose(again.values / SCALE, whole.values / SCALE, atol=1e-6)


@pytest.mark.parametrize(("weight", "apart"), [(0.0, 1e-6), (40.0, 3e-4)])
def test_lin_and_fea_are_a_constant_stiffness_under_a_known_weight(weight: float, apart: float) -> None:
    """What is read obeys F + W = K t, K of the frame that of springs at rest, K of LIN that under the weight."""
    weighted = load_cases(manipulators.campaign(weight=weight))
    lin = predict_linear(weighted)
    fea = predict_frame(weighted, lambda: lin)
    np.testing.assert_allclose(lin.values / SCALE, fea.values / SCALE, rtol=apart, atol=apart)
    for rows, test in ((slice(0, 8), 0), (slice(8, 12), 2)):
        rig = weighted.campaign.tests[test].rig
        assert isinstance(rig, ManipulatorRig) and rig.at is not None
        k = vjm_stiffness(rig.manipulator, rig.at)
        carried = fea.values[rows, 6:] + np.array([0.0, 0.0, -weight, 0.0, 0.0, 0.0])
        np.testing.assert_allclose((fea.values[rows, :6] @ k) / SCALE[6:], carried / SCALE[6:], atol=1e-6)
    np.testing.assert_allclose(lin.values[4:8, 0], STEPS * WAY[0], atol=1e-12)
    springs = predict(Model(), weighted, slopes=False)
    # Loads of a hundredth of what buckles a leg: springs that know their geometry differ by a per cent.
    np.testing.assert_allclose(springs.values[:, :6], lin.values[:, :6], rtol=0.03, atol=2e-4)


def test_stops_are_pressed_as_differences_say(cases: LoadCases) -> None:
    """Six plays; of the steps under prescribed loads those that press all stops by more than the differences."""
    it, few = model(joint_clearance={"play_mm": 0.01}), cases.only(np.array([0, 1, 3]))
    here = predict(it, few, slopes=False).stops
    assert here.shape[1] == 6 and np.all(np.abs(here[..., 0]) > 1.2)
    for k, step in enumerate([1.0, 1.0, 1.0, 50.0, 50.0, 50.0]):
        shift = np.zeros((3, 7))
        shift[:, k] = step
        ends = [predict(it, few, slopes=False, shift=s).stops[..., 0] for s in (shift, -shift)]
        np.testing.assert_allclose((ends[0] - ends[1]) / (2.0 * step), here[..., 1 + k], rtol=1e-3, atol=1e-6)
