"""A cantilever bent into a hook by a dead force across its tip.

K. Mattiasson, "Numerical results from large deflection beam and frame problems analysed by means of elliptic
integrals", International Journal for Numerical Methods in Engineering 17 (1981) 145-153, table I: shortening and
deflection over the length, and the tip's angle, for P L² / EI. Five printed decimals; EA L²/EI is 1e7 here.
"""

from __future__ import annotations

import numpy as np
import pytest

from fem.frame.rig import Rig
from fem.frame.section import uniform
from tests.fem.frame.rigs import LENGTH, measure, steps

TABLE = {1.0: (0.05643, 0.30172, 0.46135), 2.0: (0.16064, 0.49346, 0.78175), 5.0: (0.38763, 0.71379, 1.21537)}
TABLE |= {10.0: (0.55500, 0.81061, 1.43029)}
EI = 4.0e7
RIG = Rig("bar", LENGTH, uniform(1e7 * EI / LENGTH**2, EI, EI, 1e8))
RATIOS = np.array(list(TABLE))
EXACT = np.array(list(TABLE.values()))


def tips(coordinate: str, elements: int) -> np.ndarray:
    """(4, 3) shortening and deflection over the length, and angle, at the four loads of the table."""
    loads = RATIOS * EI / LENGTH**2
    u = measure(RIG, (), steps(**{coordinate: list(loads)}), elements=elements).displacement
    across, turn, sign = {"y": (1, 5, 1.0), "z": (2, 4, -1.0)}[coordinate]
    return np.stack((-u[:, 0] / LENGTH, u[:, across] / LENGTH, sign * u[:, turn]), axis=-1)


@pytest.mark.parametrize("coordinate", ["y", "z"])
def test_tip_of_the_elastica(coordinate: str) -> None:
    # Eight elements of up to 0.3 rad each; sixteen reach the table's last digit but one.
    np.testing.assert_allclose(tips(coordinate, 8), EXACT, atol=4e-4)
    np.testing.assert_allclose(tips(coordinate, 16), EXACT, atol=4e-5)


def test_the_error_falls_with_the_fourth_power_of_the_elements() -> None:
    fine = tips("y", 32)[-1]
    errors = [float(np.linalg.norm(tips("y", n)[-1] - fine)) for n in (4, 8)]
    assert 12 < errors[0] / errors[1] < 20
