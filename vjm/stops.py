"""How hard the stops of the plays of a mechanism are pressed."""

from __future__ import annotations

from typing import Protocol

import numpy as np

from vjm.clearance import Clearance
from vjm.frames import Array
from vjm.laws import Spring


class Sprung(Protocol):
    """A chain with laws on some of its coordinates, such as `vjm.mechanism.ElasticChain`."""

    @property
    def springs(self) -> tuple[Spring, ...]: ...

    @property
    def moving(self) -> np.ndarray: ...


class Strained(Protocol):
    """An equilibrium that knows each chain with all its coordinates (..., n) from rest, and where those that move
    stand among the unknowns."""

    @property
    def strains(self) -> tuple[tuple[Sprung, Array, slice], ...]: ...


def pressed(state: Strained, change: Array) -> tuple[Array, Array]:
    """Forces (..., K), N, by which the stops of the K plays are pressed, zero where none is, with the sign of the
    stop, and their changes (..., K, k) along those of the unknowns (..., N, k).
    """
    forces, slopes = [], []
    for chain, strain, place in state.strains:
        for spring in chain.springs:
            if not isinstance(spring.law, Clearance):
                continue
            (number,) = spring.coordinates
            at = place.start + int(np.searchsorted(chain.moving, number))
            force, slope = spring.law.pressed(strain[..., number])
            forces.append(force)
            slopes.append(slope[..., None] * change[..., at, :])
    batch = change.shape[:-2]
    if not forces:
        return np.zeros((*batch, 0)), np.zeros((*batch, 0, change.shape[-1]))
    return np.stack(forces, axis=-1), np.stack(slopes, axis=-2)
