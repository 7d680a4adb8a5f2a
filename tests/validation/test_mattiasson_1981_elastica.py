"""Cantilever under a dead force across its tip: the elastica.

K. Mattiasson, "Numerical results from large deflection beam and frame problems analysed by means of elliptic
integrals", International Journal for Numerical Methods in Engineering 17 (1981) 145-153, table I: deflections
along and across the unloaded bar over its length, and the tip's angle, for P L² / EI.

The table is inextensible and prints five decimals; the bars here have EA L² / EI of 1e6, which moves the tip
by less than 1e-5 L. What limits the tolerances is the refinement, stated with each.
"""

from __future__ import annotations

import numpy as np
import pytest

from tests.vjm.beams import Section
from vjm.equilibrium import equilibrium
from vjm.mechanisms.bar import Bar
from vjm.refined import Refined

TABLE = {1.0: (0.05643, 0.30172, 0.46135), 2.0: (0.16064, 0.49346, 0.78175), 5.0: (0.38763, 0.71379, 1.21537)}
TABLE |= {10.0: (0.55500, 0.81061, 1.43029)}
LENGTH, BENDING = 310.0, 4.0e7
STIFFNESS = Section(1e6 * BENDING / LENGTH**2, 1e8, BENDING, BENDING).stiffness(LENGTH)


@pytest.mark.parametrize(("segments", "limit"), [(4, 1e-3), (16, 2.5e-5)])
@pytest.mark.parametrize("ratio", TABLE)
@pytest.mark.parametrize("plane", ["y", "z"])
def test_tip_of_the_elastica(ratio: float, plane: str, segments: int, limit: float) -> None:
    across, turn, sign = (1, 5, 1.0) if plane == "y" else (2, 4, -1.0)
    load = np.zeros(6)
    load[across] = ratio * BENDING / LENGTH**2
    state = equilibrium(Bar(LENGTH, STIFFNESS, bar=Refined(segments)), load, ())
    assert state.converged
    along, deflection, angle = TABLE[ratio]
    found = [1 - state.pose[0] / LENGTH, state.pose[across] / LENGTH]
    np.testing.assert_allclose(found, [along, deflection], atol=limit)
    assert sign * state.pose[turn] == pytest.approx(angle, abs=limit)


def test_the_error_falls_with_the_fourth_power_of_the_segments() -> None:
    load = np.zeros(6)
    load[1] = 10 * BENDING / LENGTH**2
    tips = [equilibrium(Bar(LENGTH, STIFFNESS, bar=Refined(n)), load, ()).pose[:2] for n in (4, 8, 32)]
    errors = [np.linalg.norm(tip - tips[-1]) for tip in tips[:2]]
    assert 12 < errors[0] / errors[1] < 20
