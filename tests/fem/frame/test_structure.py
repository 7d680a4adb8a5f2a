"""Beams, bodies and joints in any arrangement: closed forms, springs in series, loops, and what has no stiffness."""

from __future__ import annotations

import numpy as np
import pytest

from fem.beam import uniform_stiffness
from fem.frame.section import section_of, uniform
from fem.frame.so3 import exp
from fem.frame.structure import FREE, RIGID, Beam, Joint, NoStiffness, Structure, stiffness_at
from tests.fem.frame.rigs import ORTHOGLIDE

LENGTH, WIDTH = 310.0, 80.0
EA, EIY, EIZ, GJ = 6.82e6, 1.98e8, 4.51e7, 1.08e7
SECTION = uniform(EA, EIY, EIZ, GJ)
EYE = np.eye(3)
CLAMP = (RIGID,) * 6
HINGE_Y = (RIGID, RIGID, RIGID, RIGID, FREE, RIGID)


def close(found: np.ndarray, expected: np.ndarray, tolerance: float = 1e-9) -> None:
    root = np.sqrt(np.abs(np.diag(expected)))
    root = np.where(root > 0, root, root.max())
    assert np.max(np.abs(found - expected) / np.outer(root, root)) < tolerance


@pytest.mark.parametrize("elements", [2, 8])
def test_cantilever(elements: int) -> None:
    ends = np.array([[0.0, 0, 0], [LENGTH, 0, 0]])
    whole = Structure(ends, (Beam(0, 1, SECTION, EYE),), ())
    close(stiffness_at(whole, 1, elements), uniform_stiffness(LENGTH, EA, EIY, EIZ, GJ))


def test_a_turned_bar_is_turned() -> None:
    turn = exp(np.array([0.3, -0.8, 1.1]))
    ends = np.array([[10.0, 20, 30], [10.0, 20, 30] + LENGTH * turn[:, 0]])
    found = stiffness_at(Structure(ends, (Beam(0, 1, SECTION, turn),), ()), 1)
    both = np.kron(np.eye(2), turn)
    close(both.T @ found @ both, uniform_stiffness(LENGTH, EA, EIY, EIZ, GJ))


def test_springs_in_series_and_levers() -> None:
    """A drive that also gives about z, a rigid arm and a bar: compliances add at the tip, moved there by levers."""
    drive, turn, arm = 3500.0, 1e6, np.array([20.0, -30.0, 40.0])
    places = np.array([[0.0, 0, 0], [0.0, 0, 0], arm, arm + [LENGTH, 0, 0]])
    joints = (
        Joint(0, 1, places[0], EYE, (1 / drive, RIGID, RIGID, RIGID, RIGID, 1 / turn)),
        Joint(1, 2, np.array([1.0, 2.0, 3.0]), EYE, CLAMP),
    )
    found = stiffness_at(Structure(places, (Beam(2, 3, SECTION, EYE),), joints), 3)
    compliance = np.linalg.inv(uniform_stiffness(LENGTH, EA, EIY, EIZ, GJ))
    compliance[0, 0] += 1 / drive
    lever = np.concatenate([np.cross(EYE[2], places[3]), EYE[2]])
    compliance += np.outer(lever, lever) / turn
    close(found, np.linalg.inv(compliance))


def linkage(give: float = 0.0) -> Structure:
    """Two bars of Eq. 12 between four hinges about y: node 0 the base, node 1 the platform."""
    places = [np.zeros(3), np.array([LENGTH, 0, 0])]
    beams, joints = [], []
    hinge = (give, RIGID, give, 0.1 * give, FREE, 0.1 * give)
    for side in (-0.5, 0.5):
        arm = np.array([0.0, 0.0, side * WIDTH])
        base, tip = len(places), len(places) + 1
        places += [arm, arm + [LENGTH, 0, 0]]
        beams.append(Beam(base, tip, section_of(ORTHOGLIDE, LENGTH), EYE))
        joints += [Joint(0, base, arm, EYE, hinge), Joint(tip, 1, places[tip], EYE, hinge)]
    return Structure(np.array(places), tuple(beams), tuple(joints))


def test_a_closed_loop_is_equation_11() -> None:
    """K_p of the parallelogram at q = 0; without z, which is free."""
    k, arm = ORTHOGLIDE, WIDTH / 2
    expected = 2 * np.diag([k[0, 0], k[1, 1], 0, k[3, 3] + arm**2 * k[1, 1], arm**2 * k[0, 0], k[5, 5]])
    expected[1, 5] = expected[5, 1] = 2 * k[1, 5]
    found = stiffness_at(linkage(), 1)
    close(found, expected)
    assert abs(found[2, 2]) < 1e-9 * k[0, 0]


def test_flexible_axes_are_in_series_with_their_bars() -> None:
    give = 1e-5
    found = stiffness_at(linkage(give), 1)
    assert found[0, 0] == pytest.approx(2 / (1 / ORTHOGLIDE[0, 0] + 2 * give), rel=1e-9)


def test_a_mechanism_has_no_stiffness_and_says_so() -> None:
    ends = np.array([[0.0, 0, 0], [0.0, 0, 0], [LENGTH, 0, 0], [2 * LENGTH, 0, 0]])
    loose = Structure(
        ends,
        (Beam(1, 2, SECTION, EYE),),
        (Joint(0, 1, ends[0], EYE, HINGE_Y),),
    )
    with pytest.raises(NoStiffness, match="still moves"):
        stiffness_at(loose, 3)
    alone = stiffness_at(Structure(ends[:3], loose.beams, loose.joints), 2)
    turn = np.array([0.0, 0.0, -LENGTH, 0.0, 1.0, 0.0])
    assert np.max(np.abs(alone @ turn)) < 1e-6 * np.max(np.abs(alone))


def test_a_beam_must_lie_along_its_frame() -> None:
    ends = np.array([[0.0, 0, 0], [0.0, LENGTH, 0]])
    with pytest.raises(ValueError, match="does not lie along"):
        stiffness_at(Structure(ends, (Beam(0, 1, SECTION, EYE),), ()), 1)
