"""Stresses of straight and of buckled bars beside closed forms."""

from __future__ import annotations

import numpy as np
import pytest

from pipeline.validation.result import Buckling
from pipeline.validation.yielding import Yielding, marked_buckling

TUBE = Yielding(
    limit=235.0,
    area=np.pi / 4.0 * (16.0**2 - 12.0**2),
    length=300.0,
    modulus=210000.0,
    moment={"xy": np.pi / 64.0 * (16.0**4 - 12.0**4)},
    fibre={"xy": 8.0},
)


def test_a_straight_pair_of_tubes() -> None:
    assert TUBE.straight(98e3, 0.0) == pytest.approx(557.1, rel=1e-3)
    # Turned by 60 degrees the bars carry twice the force.
    assert TUBE.straight(98e3, 60.0) == pytest.approx(2.0 * TUBE.straight(98e3, 0.0))
    assert TUBE.straight(-98e3) == pytest.approx(2.0 * TUBE.straight(98e3, 0.0))


@pytest.mark.parametrize("waves", [1.0, 2.0])
def test_bending_of_a_buckled_bar_is_that_of_its_shape(waves: float) -> None:
    """w = A (1 - cos kx) between guided or clamped ends, k = n π / L, at the load EI k²; by quadrature."""
    length, height = TUBE.length, 3.0
    k = waves * np.pi / length
    x = np.linspace(0.0, length, 20001)
    slope, curvature = height * k * np.sin(k * x), height * k**2 * np.cos(k * x)
    shortening = np.trapezoid(0.5 * slope**2, x)
    load = TUBE.modulus * TUBE.moment["xy"] * k**2
    found = TUBE.bending(np.array([shortening]), np.array([load]), "xy")
    assert found[0] == pytest.approx(TUBE.modulus * 8.0 * np.abs(curvature).max(), rel=1e-6)


def test_a_load_is_marked_from_the_yield_stress_on() -> None:
    at = TUBE.limit * TUBE.area
    given = [
        Buckling.model_validate(
            {"body": "bar", "model": "solid", "supports": "free", "plane": "xy", "mode": 1, "load_N": load}
        )
        for load in (0.999 * at, 1.001 * at)
    ]
    assert [r.beyond_yield for r in marked_buckling(given, TUBE)] == [False, True]
    assert marked_buckling(given, None) == given
