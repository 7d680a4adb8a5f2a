"""Sweeps under a wrench and with effects: against the stiffness at rest, against other drawings, and what is lost."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from pipeline.manipulator import loaded
from pipeline.manipulator.description import read
from pipeline.manipulator.mapping import CriticalMap, critical_at, mapped
from pipeline.manipulator.question import CHANGED, FOUND, GIVING, LOADED, LOST, REST, Question
from pipeline.manipulator.question_options import question_of
from pipeline.manipulator.reasons import NO_EQUILIBRIUM, reasons_of
from pipeline.manipulator.table import vjm_stiffness
from tests.vjm.manipulator.example import without_load
from vjm.manipulator.buckling import critical_load
from vjm.manipulator.legs import segmented
from vjm.manipulator.measures import principal, rotational, translational
from vjm.manipulator.parts import Manipulator, Parallelogram
from vjm.manipulator.posture import postures

POINTS = np.array([[0.0, 0.0, 0.0], [50.0, -40.0, 60.0], [-60.0, 30.0, 70.0]])
# The legs' critical forces are the business of another test.
CRITICAL = CriticalMap((np.zeros(1), np.zeros(1), np.zeros(1)), np.full((1, 1, 1, 3), 9000.0))
WRENCH = np.array([3.0, -2.0, 1.0, 50.0, 0.0, -40.0])


@pytest.fixture(scope="module")
def orthoglide() -> Manipulator:
    return read("orthoglide").manipulator


def column(values: np.ndarray, question: Question, name: str) -> np.ndarray:
    return values[:, question.columns.index(name)]


def asked(whole: Manipulator, question: Question) -> np.ndarray:
    return mapped(whole, question, CRITICAL, POINTS)


def test_columns_follow_the_question(orthoglide: Manipulator) -> None:
    softer = question_of(orthoglide, ["modulus_error=0.8"], "1,0,0")
    assert Question().columns == REST
    assert softer.columns == (*REST, *LOADED, *CHANGED, *GIVING)
    assert replace(softer, wrench=None).columns == (*REST, *CHANGED)
    assert asked(orthoglide, softer).shape == (3, len(softer.columns))


def test_a_small_wrench_moves_the_platform_by_the_compliance_at_rest(orthoglide: Manipulator) -> None:
    """A few newtons turn legs of 310 mm by 1e-5: what is left of geometry and loaded stiffness is 1e-4."""
    question = Question(WRENCH)
    values = asked(orthoglide, question)
    assert np.all(values[:, 3] == FOUND)
    for row, point in zip(values, POINTS, strict=True):
        k = vjm_stiffness(orthoglide, point)
        way = np.linalg.solve(k, WRENCH)
        found = dict(zip(question.columns, row, strict=True))
        assert found["shift_mm"] == pytest.approx(np.linalg.norm(way[:3]), rel=1e-3)
        assert found["turn_rad"] == pytest.approx(np.linalg.norm(way[3:]), rel=1e-3)
        tran, rot = principal(translational(k)), principal(rotational(k))
        loaded_ones = [found[name] for name in LOADED[3:]]
        np.testing.assert_allclose(loaded_ones, [tran[0], tran[-1], rot[0], rot[-1]], rtol=1e-3)


def test_the_error_of_an_effect_is_that_of_another_drawing(orthoglide: Manipulator) -> None:
    question = question_of(orthoglide, ["modulus_error=0.8"], "3,-2,1,50,0,-40")
    values = asked(orthoglide, question)
    for row, point in zip(values, POINTS, strict=True):
        one, other = vjm_stiffness(orthoglide, point), vjm_stiffness(drawn_softer(orthoglide), point)
        found = dict(zip(question.columns, row, strict=True))
        for name, block in (("K_tran_error", translational), ("K_rot_error", rotational)):
            expected = principal(block(other))[0] / principal(block(one))[0] - 1.0
            assert found[name] == pytest.approx(expected, abs=1e-8)
        works = [WRENCH @ np.linalg.solve(k, WRENCH) for k in (one, other)]
        assert found["displacement_error"] == pytest.approx(works[1] / works[0] - 1.0, rel=1e-2)
        assert found["offset_mm"] == pytest.approx(0.0, abs=1e-9)


def drawn_softer(whole: Manipulator) -> Manipulator:
    legs = []
    for leg in whole.legs:
        parts = [
            replace(p, bar_stiffness=0.8 * p.bar_stiffness) if isinstance(p, Parallelogram) else p
            for p in leg.parts
        ]
        legs.append(replace(leg, parts=tuple(parts)))
    return replace(whole, legs=tuple(legs))


def test_an_effect_at_null_has_no_error(orthoglide: Manipulator) -> None:
    question = question_of(orthoglide, ["modulus_error=1.0"], "300,-200,100")
    values = asked(orthoglide, question)
    for name in (*CHANGED, *GIVING):
        np.testing.assert_allclose(column(values, question, name), 0.0, atol=1e-9)


def test_longer_bars_move_the_platform_along_all_legs(orthoglide: Manipulator) -> None:
    question = question_of(orthoglide, ["dimension_error=0.1"])
    moved = column(asked(orthoglide, question), question, "offset_mm")
    assert moved[0] == pytest.approx(0.1 * np.sqrt(3.0), rel=1e-3)


def test_what_has_no_stable_equilibrium_says_so(orthoglide: Manipulator) -> None:
    """Lumped bars fail in tension far below 20 kN; the columns at rest stay, those under the wrench are zero."""
    plain, question = Question(), Question(np.array([2e4, 0.0, 0.0, 0.0, 0.0, 0.0]))
    values, rest = asked(orthoglide, question), asked(orthoglide, plain)
    assert np.all(values[:, 3] == LOST)
    last = REST.index("reason")
    np.testing.assert_array_equal(values[:, 4:last], rest[:, 4:last])
    assert {reasons_of(orthoglide)[int(k)] for k in values[:, last]} == {NO_EQUILIBRIUM}
    assert not values[:, len(REST) + 1 :].any()


def test_the_wrench_that_makes_a_leg_buckle(orthoglide: Manipulator) -> None:
    """Pushed along leg x in the isotropic posture, the leg carries all of it; pulled, it does not buckle."""
    force = critical_at(orthoglide, POINTS[:1])[0][0]
    critical = CriticalMap(CRITICAL.axes, force.reshape(1, 1, 1, 3))
    for sign, expected in ((-1.0, force[0] / 500.0), (1.0, np.inf)):
        question = Question(np.array([sign * 500.0, 0.0, 0.0, 0.0, 0.0, 0.0]))
        (factor,) = column(mapped(orthoglide, question, critical, POINTS[:1]), question, "critical_factor")
        if np.isinf(expected):
            # Rounding is all that the other legs carry.
            assert factor > 1e9
        else:
            assert factor == pytest.approx(expected, rel=1e-9)


def test_the_critical_factor_is_that_of_the_whole(orthoglide: Manipulator) -> None:
    """Legs one by one between held ends, against the path of the whole manipulator under that wrench: as for a push
    along a leg, what the map leaves out is a few per cent."""
    wrench, point = np.array([-300.0, -200.0, 100.0, 0.0, 0.0, 0.0]), POINTS[2:]
    critical = CriticalMap(CRITICAL.axes, critical_at(orthoglide, point)[0].reshape(1, 1, 1, 3))
    question = Question(wrench)
    (factor,) = column(mapped(orthoglide, question, critical, point), question, "critical_factor")
    bent = replace(orthoglide, legs=tuple(segmented(leg) for leg in orthoglide.legs))
    found = critical_load(without_load(bent, postures(orthoglide, point[0])), wrench)
    assert found.found and found.factor == pytest.approx(factor, rel=0.06)


def test_blocks_make_no_difference(orthoglide: Manipulator, monkeypatch: pytest.MonkeyPatch) -> None:
    question = question_of(orthoglide, ["joint_friction"], "300,-200,100")
    whole = asked(orthoglide, question)
    monkeypatch.setattr(loaded, "SPACE", 1.0)
    np.testing.assert_allclose(asked(orthoglide, question), whole, rtol=1e-9, atol=1e-12)
