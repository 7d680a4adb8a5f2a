"""Gauges: the displacement of a point of a bar along a direction, as an output of an equilibrium."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from vjm import lagrangian
from vjm.chain import Chain, Element
from vjm.equilibrium import Equilibrium
from vjm.frames import Array
from vjm.mechanism import ElasticChain


@dataclass(frozen=True, eq=False)
class Gauge:
    """A displacement gauge; reads zero in the unloaded state.

    chain: number of the chain it sits on. path: from the base to its point. coordinates: numbers of the
    path's coordinates in that chain. direction: (3,) base frame. zero: its place along that direction at rest.
    """

    chain: int
    path: Chain
    coordinates: np.ndarray
    direction: Array
    zero: float

    def reading(self, state: Equilibrium) -> Array:
        """Displacement (...), mm."""
        position = self.path.pose(self._local(state))[..., :3]
        return np.asarray(position @ self.direction - self.zero)

    def gradient(self, state: Equilibrium) -> Array:
        """Derivative (..., N) of the reading by the unknowns of the state."""
        place = lagrangian.layout(state.mechanism).coordinates[self.chain]
        moving = state.mechanism.chains[self.chain].moving
        jacobian = self.path.jacobian(self._local(state))[..., :3, :]
        by_coordinate = np.zeros((*jacobian.shape[:-2], state.mechanism.chains[self.chain].chain.size))
        by_coordinate[..., self.coordinates] = np.einsum("k,...kn->...n", self.direction, jacobian)
        gradient = np.zeros_like(state.unknowns)
        gradient[..., place] = by_coordinate[..., moving]
        return gradient

    def _local(self, state: Equilibrium) -> Array:
        return state.coordinates[self.chain][..., self.coordinates]


def gauge(
    number: int, elements: tuple[Element, ...], chain: ElasticChain, direction: tuple[float, float, float]
) -> Gauge:
    """Gauge at the end of `elements`, whose joints up to the station are those of chain `number`.

    ValueError for a direction that is not of length 1.
    """
    if abs(np.linalg.norm(direction) - 1.0) > 1e-12:
        raise ValueError(f"a gauge's direction must have length 1, got {direction}")
    path = Chain(elements)
    ties = {joint.tie: k for k, joint in enumerate(chain.chain.joints) if joint.tie is not None}
    numbers = [k if joint.tie is None else ties[joint.tie] for k, joint in enumerate(path.joints)]
    coordinates = np.array(numbers, dtype=int)
    zero = path.pose(chain.rest[coordinates])[:3] @ np.asarray(direction)
    return Gauge(number, path, coordinates, np.asarray(direction, dtype=float), float(zero))
