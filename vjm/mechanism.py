"""What the solvers need to know of a mechanism: elastic chains that meet at one platform."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Protocol

import numpy as np

from vjm.chain import Chain, Role
from vjm.frames import Array


@dataclass(frozen=True, eq=False)
class ElasticChain:
    """A chain with its springs.

    stiffness: (v, v) of the v virtual coordinates together, N, mm, rad; may couple them.
    rest: (n,) coordinates of the unloaded chain, where the springs carry nothing.
    """

    chain: Chain
    stiffness: Array
    rest: Array

    def __post_init__(self) -> None:
        v, n = self.virtual.size, self.chain.size
        if self.stiffness.shape != (v, v):
            raise ValueError(f"{v} virtual coordinates need a {v}x{v} stiffness, got {self.stiffness.shape}")
        if self.rest.shape != (n,):
            raise ValueError(f"{n} coordinates need as many rest values, got shape {self.rest.shape}")

    @cached_property
    def virtual(self) -> np.ndarray:
        """Numbers of the virtual coordinates theta."""
        return self.chain.indices(Role.VIRTUAL)

    @cached_property
    def passive(self) -> np.ndarray:
        """Numbers of the passive coordinates q."""
        return self.chain.indices(Role.PASSIVE)

    @cached_property
    def moving(self) -> np.ndarray:
        """Numbers of the coordinates that equilibrium decides: passive and virtual, in chain order."""
        return self.chain.indices(Role.PASSIVE, Role.VIRTUAL)

    @cached_property
    def full_stiffness(self) -> Array:
        """(m, m) stiffness of the moving coordinates, zero for the passive ones."""
        full = np.zeros((self.chain.size, self.chain.size))
        full[np.ix_(self.virtual, self.virtual)] = self.stiffness
        return full[np.ix_(self.moving, self.moving)]

    def energy(self, coordinates: Array) -> Array:
        """Elastic energy (...), N·mm, at coordinates (..., n)."""
        strain = (coordinates - self.rest)[..., self.virtual]
        return 0.5 * np.einsum("...i,ij,...j->...", strain, self.stiffness, strain)


class Mechanism(Protocol):
    """Elastic chains in parallel from the base to one platform.

    chains: each ends at the platform point.
    unloaded_pose: (6,) pose of the platform with all chains at rest, base frame.
    length: a characteristic length, mm; makes residuals and eigenvalues dimensionless.
    """

    @property
    def chains(self) -> tuple[ElasticChain, ...]: ...

    @property
    def unloaded_pose(self) -> Array: ...

    @property
    def length(self) -> float: ...


def energy(mechanism: Mechanism, coordinates: tuple[Array, ...]) -> Array:
    """Elastic energy of all chains (Eq. 3), N·mm; one array of coordinates (..., n_i) per chain."""
    return np.sum([c.energy(x) for c, x in zip(mechanism.chains, coordinates, strict=True)], axis=0)
