"""Starts for linkages whose bars slide in their base hinges: the same linkage without slides, each let go.

Laws of slides are steep beyond a kink; from rest Newton's method overshoots them and wanders. The force that a slide
will carry is nearly that of the linkage without it, and its law's inverse is known.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Protocol, runtime_checkable

import numpy as np

from vjm import lagrangian
from vjm.equilibrium import Equilibrium
from vjm.frames import Array
from vjm.mechanism import ElasticChain, Mechanism


@runtime_checkable
class Giving(Protocol):
    """A scalar law whose strain is known from its force."""

    def give(self, force: Array) -> Array:
        """Strain at a force; both (...)."""


def with_slides(state: Equilibrium, mechanism: Mechanism) -> Equilibrium:
    """A state of the same mechanism without slides, or with other laws in them, as a start: it is no equilibrium.

    ValueError for mechanisms that differ in anything else, their memories too: slides have none.
    """
    old, new = lagrangian.layout(state.mechanism), lagrangian.layout(mechanism)
    before, after = ([_slides(chain) for chain in m.chains] for m in (state.mechanism, mechanism))
    added = sum(len(b) for b in after) - sum(len(a) for a in before)
    if new.size != old.size + added or new.memories[-1].stop != state.memory.shape[-1]:
        raise ValueError(f"{new.size} unknowns are not {old.size} and {added} slides without memory")
    unknowns = np.zeros((*state.converged.shape, new.size))
    unknowns[..., new.platform] = state.unknowns[..., old.platform]
    rest = lagrangian.rest(mechanism, state.drives)
    for k, chain in enumerate(mechanism.chains):
        multiplier = state.unknowns[..., old.closing[k]]
        others = _others(state.mechanism.chains[k], before[k])
        moving = np.zeros((*state.converged.shape, chain.moving.size))
        moving[..., _others(chain, after[k])] = state.unknowns[..., old.coordinates[k]][..., others]
        coordinates = lagrangian.chain_coordinates(chain, moving, rest[k])
        force = lagrangian.closing_force(chain, coordinates, multiplier)
        for number, at in zip(after[k], np.searchsorted(chain.moving, after[k]), strict=True):
            moving[..., at] = rest[k][..., number] + _law(chain, number).give(force[..., at])
        unknowns[..., new.coordinates[k]] = moving
        unknowns[..., new.closing[k]] = multiplier
    return replace(state, mechanism=mechanism, unknowns=unknowns)


def slides(mechanism: Mechanism) -> bool:
    """Whether any of its bars slides in a hinge."""
    return any(_slides(chain) for chain in mechanism.chains)


def _slides(chain: ElasticChain) -> list[int]:
    """Coordinates with a law that gives."""
    return sorted({s.coordinates[0] for s in chain.springs if isinstance(s.law, Giving)})


def _law(chain: ElasticChain, number: int) -> Giving:
    laws = (s.law for s in chain.springs if s.coordinates == (number,))
    return next(law for law in laws if isinstance(law, Giving))


def _others(chain: ElasticChain, slides: list[int]) -> np.ndarray:
    """Places of the other coordinates among the moving ones."""
    return np.flatnonzero(~np.isin(chain.moving, slides))
