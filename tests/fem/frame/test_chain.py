"""A joint chain: its rates and its second derivatives are those of any energy of the place where it ends."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from fem.frame.chain import SLOTS, End, end_of, geometric, work_rate
from fem.frame.so3 import exp
from meshes.solid import Floats

RNG = np.random.default_rng(0)
X, PLACE, FORCE = RNG.normal(size=(3, 3))
R, FRAME = exp(RNG.normal(size=(2, 3)))
Q = RNG.normal(size=7) * 0.3
PULL = RNG.normal(size=(3, 3))
ALL = tuple(SLOTS)


def end(step: Floats) -> End:
    return end_of(X + step[:3], exp(step[3:6]) @ R, PLACE, FRAME, Q + step[6:], ALL)


def energy_at(place: Floats, triad: Floats) -> float:
    """Any smooth function of a place and a triad."""
    return float(FORCE @ place + (PULL * triad).sum())


def slope(f: Callable[[Floats], float], n: int) -> Floats:
    step = 1e-5 * np.eye(n)
    return np.array([(f(s) - f(-s)) / 2e-5 for s in step])


def curvature(f: Callable[[Floats], float], n: int) -> Floats:
    step = 1e-3 * np.eye(n)
    return np.array([[(f(a + b) - f(a - b) - f(b - a) + f(-a - b)) / 4e-6 for b in step] for a in step])


def test_second_derivatives_through_all_joints() -> None:
    here = end(np.zeros(13))

    def near_the_end(s: Floats) -> float:
        return energy_at(here.x + s[:3], exp(s[3:]) @ here.R)

    def total(s: Floats) -> float:
        return energy_at(end(s).x, end(s).R)

    load = slope(near_the_end, 6)
    np.testing.assert_allclose(work_rate(here.rates, load), slope(total, 13), atol=1e-9)
    found = here.rates.T @ curvature(near_the_end, 6) @ here.rates + geometric(here.rates, load)
    # Central differences: 1e-6 times a fourth derivative of order one.
    np.testing.assert_allclose(found, curvature(total, 13), atol=3e-6)


def test_a_joint_at_rest_is_not_there() -> None:
    here = end_of(X, R, PLACE, FRAME, np.zeros(7), ALL)
    np.testing.assert_allclose(here.x, X + R @ PLACE, atol=1e-15)
    np.testing.assert_allclose(here.R, R @ FRAME, atol=1e-15)
