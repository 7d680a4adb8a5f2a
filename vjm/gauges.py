"""Gauges: the displacement of a point of a chain along a direction."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np

from vjm.chain import Chain, Element
from vjm.frames import Array


class Posed(Protocol):
    """Anything that knows the coordinates (..., n) of each chain, there and unloaded, such as an equilibrium."""

    @property
    def coordinates(self) -> tuple[Array, ...]: ...

    @property
    def unloaded_coordinates(self) -> tuple[Array, ...]: ...


@dataclass(frozen=True, eq=False)
class Gauge:
    """A displacement gauge; reads zero in the unloaded state. Seen from the base body: `vjm.readings` adds its motion.

    chain: number of the chain it sits on. path: from the base to its point. coordinates: numbers of the
    path's coordinates in that chain. direction: (3,) base frame.
    """

    chain: int
    path: Chain
    coordinates: np.ndarray
    direction: Array

    def at(self, coordinates: Array, unloaded: Array) -> Array:
        """Displacement (...), mm, at all coordinates (..., n) of its chain from the unloaded ones."""
        return np.asarray((self.point(coordinates) - self.point(unloaded)) @ self.direction)

    def point(self, coordinates: Array) -> Array:
        """Place (..., 3) of its point at all coordinates (..., n) of its chain."""
        return self.path.pose(coordinates[..., self.coordinates])[..., :3]

    def slope(self, coordinates: Array, direction: Array | None = None) -> Array:
        """Derivative (..., n) of the reading by the coordinates (..., n), along its own or a direction (..., 3)."""
        jacobian = self.path.jacobian(coordinates[..., self.coordinates])[..., :3, :]
        slope = np.zeros(coordinates.shape)
        along = self.direction if direction is None else direction
        slope[..., self.coordinates] = np.einsum("...k,...kn->...n", along, jacobian)
        return slope

    def reading(self, state: Posed) -> Array:
        """Displacement (...), mm, at a state."""
        return self.at(state.coordinates[self.chain], state.unloaded_coordinates[self.chain])


def path_numbers(elements: tuple[Element, ...], chain: Chain) -> tuple[Chain, np.ndarray]:
    """A path whose joints are the first ones of a chain, or tied to its, with the numbers (n,) of its coordinates."""
    path = Chain(elements)
    ties = {joint.tie: k for k, joint in enumerate(chain.joints) if joint.tie is not None}
    numbers = [k if joint.tie is None else ties[joint.tie] for k, joint in enumerate(path.joints)]
    return path, np.array(numbers, dtype=int)


def gauge(
    number: int, elements: tuple[Element, ...], chain: Chain, direction: tuple[float, float, float]
) -> Gauge:
    """Gauge at the end of `elements`, whose joints up to the station are those of chain `number`.

    ValueError for a direction not of length 1.
    """
    if abs(np.linalg.norm(direction) - 1.0) > 1e-12:
        raise ValueError(f"a gauge's direction must have length 1, got {direction}")
    path, numbers = path_numbers(elements, chain)
    return Gauge(number, path, numbers, np.asarray(direction, dtype=float))
