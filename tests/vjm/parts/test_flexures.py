"""Flexures of leaves and notches against their closed forms."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from fem.beam import uniform_stiffness
from pipeline.manipulator.frame import frame_stiffness
from vjm.bars import Y
from vjm.equilibrium import Equilibrium, equilibrium
from vjm.frames import Array, rotation_y
from vjm.laws import Linear
from vjm.manipulator.machine import machine
from vjm.manipulator.parts import Manipulator
from vjm.manipulator.posture import postures
from vjm.manipulator.rest import stiffness_at_rest
from vjm.parts import (
    Fork,
    Frame,
    Leg,
    Part,
    Tie,
    beside,
    elastic,
    hinge,
    leaf_pair,
    notch,
    parallelogram,
    slide,
)
from vjm.stiffness import loaded_stiffness

L, THICK, DEEP, MODULUS = 60.0, 0.4, 15.0, 2e5
EA, EI = MODULUS * THICK * DEEP, MODULUS * DEEP * THICK**3 / 12
LEAF = uniform_stiffness(L, EA, EI, EI * (DEEP / THICK) ** 2, 4 * EI / 2.6)


def along_x(distance: float) -> Frame:
    return Frame(np.array([distance, 0.0, 0.0]))


def flexure(*parts: Part) -> Manipulator:
    return Manipulator("flexure", (Leg("flexure", parts),), L)


def at_rest(whole: Manipulator) -> Array:
    """(6, 6) as it stands, by the equations of rest and by those of the loaded state, which must agree."""
    start = machine(whole).unloaded_pose
    k = stiffness_at_rest(whole, postures(whole, start)).total
    loaded = loaded_stiffness(equilibrium(machine(whole), np.zeros(6), ()))
    size = np.sqrt(np.diag(k))
    assert np.max(np.abs(k - loaded) / np.outer(size, size)) < 1e-8
    return k


def held_at(whole: Manipulator, shift: float) -> Equilibrium:
    state = equilibrium(machine(whole), [0.0, 0.0, shift, 0.0, 0.0, 0.0], ("z", "ry"))
    assert state.converged
    return state


def test_cross_spring_pivot() -> None:
    """Two leaves that cross at their middles turn about the crossing with 2 EI / L."""
    leaf, middle = elastic(L, LEAF), Frame(np.array([-L / 2, 0.0, 0.0]))
    to_middle = along_x(-L / 2)
    branches = [
        (Frame(rotation=rotation_y(turn)), middle, leaf, to_middle, Frame(rotation=rotation_y(-turn)))
        for turn in (-np.pi / 4, np.pi / 4)
    ]
    compliance = np.linalg.inv(at_rest(flexure(Fork(tuple(branches)))))
    assert 1 / compliance[4, 4] == pytest.approx(2 * EI / L, rel=1e-6)


def test_folded_flexure() -> None:
    """Out by one pair of leaves and back by another: 12 EI / L³, and no shift along the leaves."""
    out, back = leaf_pair(elastic(L, LEAF, 4), 40.0), leaf_pair(elastic(L, LEAF, 4), 20.0)
    around = Frame(rotation=rotation_y(np.pi))
    whole, simple = flexure(out, around, back, around), flexure(out)
    compliance = np.linalg.inv(at_rest(whole))
    about = compliance[2, 2] - compliance[2, 4] ** 2 / compliance[4, 4]
    assert 1 / about == pytest.approx(12 * EI / L**3, rel=2e-3)
    shift = 0.03 * L
    single = held_at(simple, shift).pose[0] - L
    assert single == pytest.approx(-0.6 * shift**2 / L, rel=1e-2)
    assert abs(held_at(whole, shift).pose[0]) < 0.02 * abs(single)


def test_notch_guide() -> None:
    """Four notch hinges of stiffness k between rigid links of length L: 4 k / L²."""
    k = 80.0
    hinges = notch(np.diag([1e7, 1e7, 1e7, 1e9, k, 1e9]))
    whole = flexure(Fork(beside(*[(hinges, along_x(L), hinges)] * 2, apart=40.0)))
    compliance = np.linalg.inv(at_rest(whole))
    assert 1 / compliance[2, 2] == pytest.approx(4 * k / L**2, rel=1e-3)


def test_a_slide_with_a_law() -> None:
    """A spring along a slide and a leaf behind it are in series: 1/k + L/EA."""
    k = 2e3
    whole = flexure(slide((1.0, 0.0, 0.0), Linear(np.array([[k]]))), elastic(L, LEAF))
    assert np.linalg.inv(at_rest(whole))[0, 0] == pytest.approx(1 / k + L / EA, rel=1e-9)


def test_frame_elements_refuse_what_they_do_not_have() -> None:
    """A tie, a member with play or one that gives at its ends would silently be left out."""
    stiff = elastic(L, LEAF)
    branches = parallelogram((stiff, stiff), 40.0).branches
    tied = Fork(branches, (), ties=(Tie((((0, 0), 1.0), ((1, 0), 1.0)), Linear(np.eye(1))),))
    loose = replace(stiff, link=replace(stiff.link, base_give=1e-6 * np.eye(6)))
    heavy = replace(stiff, line_load=np.array([0.0, 0.0, -1e-3]))
    for part, said in ((tied, "no laws between"), (loose, "give along"), (heavy, "without weight")):
        whole = flexure(part)
        at = postures(whole, machine(whole).unloaded_pose)
        with pytest.raises(ValueError, match=said):
            frame_stiffness(whole, at.pose, at.coordinates)


def test_a_tie_between_branches() -> None:
    """A spring k on the sum of the turns of two base hinges, which turn alike: 4 k / L² along the free direction."""
    k, stiff = 50.0, elastic(L, 1e6 * LEAF)
    linkage = parallelogram((stiff, stiff), 40.0)
    tied = Fork(linkage.branches, (), ties=(Tie((((0, 0), 1.0), ((1, 0), 1.0)), Linear(np.array([[k]]))),))
    compliance = np.linalg.inv(at_rest(flexure(tied)))
    free = compliance[2, 2] - compliance[2, 4] ** 2 / compliance[4, 4]
    assert 1 / free == pytest.approx(4 * k / L**2, rel=1e-6)


def test_forks_within_forks() -> None:
    """A branch may be a guide itself: three guides side by side are three times one, along the guide."""
    guide = leaf_pair(elastic(L, LEAF), 8.0)
    one, three = (
        at_rest(flexure(guide)),
        at_rest(flexure(Fork(beside((guide,), (guide,), (guide,), apart=80.0)))),
    )
    np.testing.assert_allclose(three[:3, :3], 3 * one[:3, :3], rtol=1e-9, atol=1e-9 * one[0, 0])


@pytest.mark.parametrize(
    ("make", "said"),
    [
        (lambda: Fork(((hinge(Y),),)), "two branches or more, got 1"),
        (lambda: Fork(((along_x(1.0),), (hinge(Y),))), "branch 1 of a fork is rigid"),
        (lambda: Fork(((hinge(Y),), (hinge(Y),)), (1.0,)), "2 axes of a fork need as many shares, got 1"),
        (lambda: elastic(-1.0, LEAF), "length must be zero or more"),
        (lambda: elastic(0.0, LEAF, 2), "no length has no segments"),
    ],
)
def test_parts_that_make_no_sense(make: object, said: str) -> None:
    with pytest.raises(ValueError, match=said):
        make()  # type: ignore[operator]
