"""A rectangular beam that shear deflects noticeably, against the solid.

S. P. Timoshenko, Strength of Materials, part I, 3rd ed., Van Nostrand 1955, chapter V (deflection of beams, effect of
shear) and chapter XI (torsion). Torsion constant of a rectangle: S. P. Timoshenko, J. N. Goodier, Theory of
Elasticity, 2nd ed., McGraw-Hill 1951, section 94.

The solid's end faces are rigid, the textbook's are not. The difference between two lengths is free of the ends: the
added millimetres bend, shear, twist and stretch by the formulas alone. Hence 0.1 %, and 1 % in shear, which is the
small difference of large numbers.
"""

from __future__ import annotations

from functools import cache
from math import pi, tanh

import numpy as np
import pytest

from fem.material import Isotropic
from fem.stiffness import bar_stiffness
from meshes.bar import Bar
from meshes.resolution import Resolution
from meshes.section import Rectangle
from meshes.store import mesh_bar

E, WIDTH, HEIGHT = 70e3, 8.0, 12.0
SHORT, LONG = 30.0, 45.0
AREA, IY, IZ = WIDTH * HEIGHT, WIDTH * HEIGHT**3 / 12, HEIGHT * WIDTH**3 / 12


@cache
def solid(length: float, nu: float) -> np.ndarray:
    mesh = mesh_bar(Bar(Rectangle(WIDTH, HEIGHT), length), Resolution(2.0, 2))
    return bar_stiffness(mesh, length, Isotropic(E, nu))


def added(place: int, nu: float) -> float:
    """Compliance that the longer bar has more than the shorter one."""
    return float(np.subtract(*(np.linalg.inv(solid(length, nu))[place, place] for length in (LONG, SHORT))))


@pytest.mark.parametrize("nu", [pytest.param(0.0, marks=pytest.mark.long), 0.33])
def test_stretch_and_bending(nu: float) -> None:
    more = LONG - SHORT
    assert added(0, nu) == pytest.approx(more / (E * AREA), rel=1e-3)
    assert added(4, nu) == pytest.approx(more / (E * IY), rel=1e-3)
    assert added(5, nu) == pytest.approx(more / (E * IZ), rel=1e-3)


@pytest.mark.parametrize("nu", [0.0, 0.33])
def test_torsion(nu: float) -> None:
    series = sum(tanh(n * pi * HEIGHT / (2 * WIDTH)) / n**5 for n in range(1, 60, 2))
    j = HEIGHT * WIDTH**3 * (1 / 3 - 64 / pi**5 * WIDTH / HEIGHT * series)
    assert added(3, nu) == pytest.approx((LONG - SHORT) / (E / (2 * (1 + nu)) * j), rel=1e-3)


@pytest.mark.parametrize(("push", "turn"), [(1, 5), (2, 4)])
def test_shear(push: int, turn: int) -> None:
    """5/6 of the area at nu = 0: with f the end's softness from the turn, 1/K = L³/12EI + f L²/2 + L/GA_s."""
    # Bending has eight times the share of shear: the mesh has to resolve its linear run along the bar.
    bending = (LONG - SHORT) / added(turn, 0.0)

    def shear_part(length: float) -> float:
        k = solid(length, 0.0)
        f = (np.linalg.inv(k)[turn, turn] - length / bending) / 2
        return float(1 / k[push, push] - length**3 / (12 * bending) - f * length**2 / 2)

    area = (LONG - SHORT) / (shear_part(LONG) - shear_part(SHORT)) / (E / 2)
    assert area == pytest.approx(5 / 6 * AREA, rel=1e-2)
