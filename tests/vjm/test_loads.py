"""Dead loads: what a chain feels of them is the slope of their potential, and how that changes its curvature."""

from __future__ import annotations

import numpy as np
import pytest

from vjm.chain import Chain, Fixed, Joint, Mark, Role
from vjm.frames import exp
from vjm.loads import DeadLoads

STEP = 1e-5
SIZE = 5
"""Joints tied together count once."""


def along_a_chain() -> DeadLoads:
    """Loads before, between and beyond joints of every kind, two of them one half turn each of the same coordinate."""
    x, y, askew = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.6, 0.0, 0.8)
    half = {"role": Role.VIRTUAL, "tie": "bend", "share": 0.5}
    chain = Chain(
        (
            Joint("rotation", y, Role.PASSIVE),
            Fixed(np.array([40.0, 0.0, 5.0]), exp([0.1, 0.2, 0.3])),
            Joint("rotation", askew, **half),
            Joint("translation", x, Role.VIRTUAL),
            Joint("rotation", x, Role.VIRTUAL),
            Joint("rotation", askew, **half),
            Fixed(np.array([0.0, 30.0, 0.0])),
            Joint("translation", askew, Role.VIRTUAL),
        )
    )
    places = ((0, 0.0), (1, 7.0), (2, 0.0), (4, -3.0), (8, 2.0))
    marks = tuple(Mark(after, np.array([ahead, 0.5 * ahead, 0.0])) for after, ahead in places)
    forces = np.random.default_rng(3).normal(size=(len(marks), 3))
    # In a chain of two coordinates more, in another order.
    return DeadLoads(chain, np.array([2, 0, 4, 6, 1]), marks, forces)


def potential(loads: DeadLoads, coordinates: np.ndarray) -> np.ndarray:
    """(...), N·mm: each mark is where the chain so far ends."""
    own, out = coordinates[..., loads.coordinates], np.zeros(coordinates.shape[:-1])
    for mark, force in zip(loads.marks, loads.forces, strict=True):
        path = Chain((*loads.path.elements[: mark.elements], Fixed(mark.offset)))
        out -= path.pose(own[..., : path.size])[..., :3] @ force
    return out


@pytest.mark.parametrize("batch", [(), (4,), (2, 3)])
def test_the_pull_is_the_slope_of_the_potential(batch: tuple[int, ...]) -> None:
    loads = along_a_chain()
    assert loads.path.size == SIZE
    values = np.random.default_rng(5).normal(size=(*batch, SIZE + 2))
    force, slope = loads.pull(values, True)
    assert force.shape == values.shape and slope.shape == (*values.shape, SIZE + 2)
    np.testing.assert_array_equal(force[..., [3, 5]], 0.0)
    for k, step in enumerate(STEP * np.eye(SIZE + 2)):
        there, back = values + step, values - step
        change = -(potential(loads, there) - potential(loads, back)) / (2.0 * STEP)
        np.testing.assert_allclose(force[..., k], change, rtol=0, atol=1e-7 * abs(force).max())
        change = (loads.pull(there, False)[0] - loads.pull(back, False)[0]) / (2.0 * STEP)
        np.testing.assert_allclose(slope[..., k], change, rtol=0, atol=1e-7 * abs(slope).max())
