"""Machines that are not as their file says: their truth, their postures, what is asked of the answer."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from pipeline.assessment.doubts.answers import Told
from pipeline.assessment.doubts.kinds import KINDS, MACHINES, SOFT_DRIVES
from pipeline.assessment.doubts.machines import LOAD, NOISE, POSTURES, Factors, loadings, measured
from pipeline.assessment.doubts.trial import trial
from pipeline.campaign import Noise
from pipeline.inference.load_cases import load_cases
from pipeline.inference.model import Model, Term
from pipeline.inference.prediction import predict
from vjm.effects import catalogue

AS_WRITTEN = Factors()
SILENT = replace(NOISE, displacement=0.0 * NOISE.displacement, wrench=0.0 * NOISE.wrench)


def positions(by: Factors, noise: Noise = SILENT) -> np.ndarray:
    return np.concatenate([test.data.displacement[:, :3] for test in measured(0, by, noise).tests])


def test_postures_and_loads_are_the_same_whatever_the_machine() -> None:
    plan = loadings(0)
    assert len(plan) == POSTURES and all(it.role == "fit" for it in plan)
    assert [float(np.linalg.norm(it.loads)) for it in plan] == pytest.approx([LOAD] * POSTURES)
    soft = measured(0, Factors(drives=SOFT_DRIVES))
    assert [test.rig.at for test in soft.tests] == [it.point for it in plan]
    assert all(test.rig.manipulator is soft.rig.manipulator for test in soft.tests), (
        "the truth stood in the file"
    )


def test_position_and_force_alone_are_read() -> None:
    data = measured(0, AS_WRITTEN).tests[0].data
    assert np.isfinite(data.displacement[:, :3]).all() and np.isnan(data.displacement[:, 3:]).all()
    assert np.isfinite(data.wrench[:, :3]).all() and np.isnan(data.wrench[:, 3:]).all()
    assert measured(0, AS_WRITTEN).tolerance == {"bars": 0.03, "drives": 0.03, "links": 0.03}


def test_a_soft_drive_is_the_effect_of_the_catalogue() -> None:
    """Frame elements of a machine with soft drives, and springs with the compliance that these have more."""
    campaign = measured(0, Factors(drives=SOFT_DRIVES), SILENT)
    effect, k = catalogue()["actuator_compliance"], 3515.0
    values = {p.name: p.null for p in effect.parameters} | {"mm_per_N": 1.0 / (SOFT_DRIVES * k) - 1.0 / k}
    cases = load_cases(replace(campaign, noise=NOISE))
    moved = [
        predict(model, cases, slopes=False).values[:, :3]
        for model in (Model((Term(effect, values),)), Model())
    ]
    more = positions(Factors(drives=SOFT_DRIVES)) - positions(AS_WRITTEN)
    # The frame is linear: what the springs turn under a thousand newtons is some parts in a hundred of it.
    assert moved[0] - moved[1] == pytest.approx(more, abs=0.05 * np.abs(more).max())


def test_soft_drives_show() -> None:
    drawn = MACHINES["soft drives"].draw(np.random.default_rng(0))
    more = (positions(drawn) - positions(AS_WRITTEN)) / NOISE.displacement[:3]
    assert np.linalg.norm(more) > 20.0


def said(verdict: str, *sets: tuple[str, ...], certain: tuple[str, ...] = ()) -> Told:
    return Told(verdict, sets, frozenset(certain), (), (), (), False)


@pytest.mark.parametrize(
    ("answer", "drives", "typed"),
    [
        (said("identified", ("actuator_compliance",)), True, False),
        (said("ambiguous", ("base_compliance",), ("actuator_compliance",)), True, False),
        (said("ambiguous", ("base_compliance",), ("modulus_error",)), False, False),
        (said("ambiguous", ("base_compliance",), ()), False, True),
        (said("ambiguous", *(("actuator_compliance", name) for name in "abcd")), False, False),
        (said("within_noise", ()), False, True),
        (said("unknown", ("actuator_compliance",)), False, True),
        (said("unknown", (), certain=("actuator_compliance",)), False, False),
    ],
)
def test_what_is_right_of_a_machine(answer: Told, drives: bool, typed: bool) -> None:
    assert (not KINDS["soft drives"].judged(answer)) is drives
    assert (not KINDS["typed in"].judged(answer)) is typed


@pytest.mark.long
def test_soft_drives_are_named() -> None:
    done = trial("soft drives", 0, "", "")
    assert done.right and done.hidden == ()
