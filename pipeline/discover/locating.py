"""Where the rest of a fit sits: every site and every body by the evidence of one function, the best first."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from pipeline.discover.bases import basis_of, unloaded
from pipeline.discover.bodies import Body, bodies, weighed
from pipeline.discover.elements import Element, elements
from pipeline.discover.evidence import Columns, Evidence, Rest
from pipeline.discover.sites import Site, sites
from pipeline.inference.fit import Fit
from vjm.effects.base import Effect

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Located:
    """A site and what speaks for it."""

    site: Site
    evidence: Evidence

    @property
    def value(self) -> float:
        """E."""
        return self.evidence.value


@dataclass(frozen=True, eq=False)
class Map:
    """What was found about a fit. sites: the best first, of two signs of one site the better. bodies: likewise."""

    found: Fit
    rest: Rest
    sites: tuple[Located, ...]
    bodies: tuple[Body, ...]

    @cached_property
    def best(self) -> float:
        """The greatest evidence of a site."""
        return self.sites[0].value if self.sites else 0.0

    @property
    def body(self) -> Body | None:
        """The best body, None where there is none."""
        return self.bodies[0] if self.bodies else None

    def group(self, within: float) -> tuple[Located, ...]:
        """The sites whose evidence is within so much of the best."""
        return tuple(it for it in self.sites if it.value >= self.best - within)


def mapped(found: Fit, effects: Mapping[str, Effect], beside: Array | None = None) -> Map:
    """Of a fit whose tests may all be fitted. effects: those that bodies are taken from. beside: (N, P) columns that
    are fitted anew in both hypotheses, in standard deviations before any data."""
    every, rest = elements(found), Rest.of(found.residual)
    if beside is not None:
        rest = replace(rest, tolerance=np.hstack([rest.tolerance, beside]))
    largest: dict[str, float] = {}
    for each in every:
        size = float(np.max(np.abs(each.coordinate), initial=0.0))
        largest[each.kind] = max(largest.get(each.kind, 0.0), size)
    done: dict[tuple[int, float], Array] = {}

    def of(element: Element, sign: float) -> Array:
        key = (id(element), sign)
        if key not in done:
            says = basis_of(sign * element.coordinate, rest.first, largest[element.kind])
            done[key] = rest.without_zeros(sign * element.moved(says, unloaded(), rest.rows))
        return done[key]

    best: dict[str, Located] = {}
    for site in sites(every):
        if not largest[site.kind] > 0.0:
            continue
        total = np.sum([of(each, site.sign(each)) for each in site.elements], axis=0)
        it = Located(site, rest.evidence(Columns(total, largest[site.kind])))
        if site.name not in best or it.value > best[site.name].value:
            best[site.name] = it
    ordered = sorted(best.values(), key=lambda it: -it.value)
    some = sorted(weighed(found, rest, bodies(found, effects.values())), key=lambda it: -it.value)
    return Map(found, rest, tuple(ordered), tuple(some))
