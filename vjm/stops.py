"""How hard the stops of the plays of a mechanism are pressed, and where in its play each slide is."""

from __future__ import annotations

from collections.abc import Iterator
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
    for law, strain, along in _plays(state, change):
        force, slope = law.pressed(strain)
        forces.append(force)
        slopes.append(slope[..., None] * along)
    batch = change.shape[:-2]
    if not forces:
        return np.zeros((*batch, 0)), np.zeros((*batch, 0, change.shape[-1]))
    return np.stack(forces, axis=-1), np.stack(slopes, axis=-2)


def slid(state: Strained, change: Array) -> tuple[Array, Array, Array]:
    """Strains (..., K), mm, of the K plays, half their widths (K,), mm, and changes (..., K, k) of the strains along
    those of the unknowns (..., N, k)."""
    found = list(_plays(state, change))
    batch = change.shape[:-2]
    if not found:
        return np.zeros((*batch, 0)), np.zeros(0), np.zeros((*batch, 0, change.shape[-1]))
    strains, slopes = [strain for _, strain, _ in found], [along for _, _, along in found]
    return np.stack(strains, axis=-1), np.array([law.play for law, _, _ in found]), np.stack(slopes, axis=-2)


def _plays(state: Strained, change: Array) -> Iterator[tuple[Clearance, Array, Array]]:
    """The law of each play with its strain (...) and that one's change (..., k)."""
    for chain, strain, place in state.strains:
        for spring in chain.springs:
            if isinstance(spring.law, Clearance):
                (number,) = spring.coordinates
                at = place.start + int(np.searchsorted(chain.moving, number))
                yield spring.law, strain[..., number], change[..., at, :]
