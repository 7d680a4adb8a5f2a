"""Springs at the middle of the bar by planar geometry alone: what the order of the factors of Eq. 1 does."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.optimize import brentq

from vjm import closed_forms, paper
from vjm.frames import move_stiffness
from vjm.mechanisms.parallelogram import Parallelogram

LENGTH = paper.LENGTH
HALF = LENGTH / 2
SPRINGS = move_stiffness(paper.BAR_STIFFNESS, [-HALF, 0, 0])[np.ix_([0, 2, 4], [0, 2, 4])]


def energy(transverse: float, turn: float, chord: float, share: float) -> float:
    """Energy of a bar between pins `chord` apart; translations stand in a frame turned by share x turn."""
    c, s = np.cos(share * turn), np.sin(share * turn)

    def gap(axial: float) -> float:
        x = HALF + c * axial + s * transverse + HALF * np.cos(turn)
        z = -s * axial + c * transverse - HALF * np.sin(turn)
        return float(np.hypot(x, z) - chord)

    theta = np.array([brentq(gap, -5, 5, xtol=1e-15), transverse, turn])
    return float(0.5 * theta @ SPRINGS @ theta)


def determinant(chord: float, share: float) -> float:
    """Curvature determinant of the energy over (transverse, turn) at the straight bar, by differences."""
    at = {(i, j): energy(2e-2 * i, 2e-4 * j, chord, share) for i in (-1, 0, 1) for j in (-1, 0, 1)}
    a = at[1, 0] + at[-1, 0] - 2 * at[0, 0]
    b = at[0, 1] + at[0, -1] - 2 * at[0, 0]
    mixed = (at[1, 1] + at[-1, -1] - at[1, -1] - at[-1, 1]) / 4
    return a * b - mixed**2


def critical(share: float) -> float:
    """Critical load of two bars, N."""
    chord = brentq(determinant, LENGTH - 0.9, LENGTH - 1e-3, args=(share,), xtol=1e-10)
    return 2 * paper.BAR_STIFFNESS[0, 0] * (chord - LENGTH)


def test_translations_before_the_turn_as_in_equation_1() -> None:
    linkage = Parallelogram(LENGTH, paper.WIDTH, paper.BAR_STIFFNESS, spring_at="middle")
    # 1e-5: the finite differences.
    assert critical(0.0) == pytest.approx(closed_forms.in_plane_critical(linkage).compression, rel=1e-5)


def test_translations_in_the_half_turned_frame_are_nearly_the_two_link_column() -> None:
    hinge = closed_forms.middle_hinge_only(paper.BAR_STIFFNESS, LENGTH)
    # What is left is the coupling K35'²/K33' of a bar that is not symmetric about its middle.
    coupling = SPRINGS[1, 2] ** 2 / (SPRINGS[1, 1] * SPRINGS[2, 2])
    assert abs(critical(0.5) / hinge - 1.0) < 1.5 * coupling + 1e-3
    assert critical(0.0) > 0.85 * hinge
