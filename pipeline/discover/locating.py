"""Where the rest of a fit sits: every site and every body by the evidence of one function, the best first."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from pipeline.discover.bases import basis_of, unloaded
from pipeline.discover.bodies import Body, bodies, weighed
from pipeline.discover.coordinate_noise import at_known_inputs
from pipeline.discover.elements import Element, elements
from pipeline.discover.evidence import Columns, Evidence, Rest
from pipeline.discover.sites import Site, sites
from pipeline.inference.fit import Fit
from pipeline.selection.adequacy.correlated import correlated, decorrelating
from pipeline.selection.criteria import CRITERIA
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

    @property
    def largest(self) -> float:
        """Of the site's coordinate."""
        return self.evidence.site.largest


@dataclass(frozen=True, eq=False)
class Map:
    """What was found about a fit. sites: the best first, of two signs of one site the better. bodies: likewise.
    independent: the same as if noise were not correlated from row to row, None where it is not."""

    found: Fit
    rest: Rest
    sites: tuple[Located, ...]
    bodies: tuple[Body, ...]
    independent: Map | None = None

    @property
    def plain(self) -> Map:
        """In whitened residuals, whatever noise is from row to row."""
        return self.independent or self

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


def mapped(
    found: Fit,
    effects: Mapping[str, Effect],
    beside: Array | None = None,
    known: Sequence[Located] = (),
) -> Map:
    """Of a fit whose tests may all be fitted. effects: those that bodies are taken from. beside: (N, P) columns that
    are fitted anew in both hypotheses, in standard deviations before any data. known: places of laws in the model, of
    which the free functions are fitted anew in both too: what a form of a law does not say is no law elsewhere.

    Where a law might be proposed, noise that is correlated from row to row beside it counts as what it is.
    """
    found = at_known_inputs(found)
    every, rest = elements(found), Rest.of(found.residual)
    if beside is not None:
        rest = replace(rest, tolerance=np.hstack([rest.tolerance, beside]))
    freed = [_free(it, every, rest) for it in known]
    if freed:
        rest = replace(rest, tolerance=np.hstack([rest.tolerance, *freed]))
    plain = _mapped(found, effects, every, rest)
    if max(plain.best, plain.body.value if plain.body else 0.0) < CRITERIA.law_proposed:
        return plain
    there = without_best(plain)
    sensors = correlated(there, CRITERIA)
    if not sensors:
        return plain
    again = _mapped(found, effects, every, rest.with_noise(decorrelating(there, sensors)))
    return replace(again, independent=plain)


def _free(it: Located, every: Sequence[Element], rest: Rest) -> Array:
    """(N, 30) of the free function at a place, in its standard deviations when the place was found, about this fit."""
    site, evidence = it.site, it.evidence
    places = {(each.kind, each.place) for each in site.elements}
    own = [each for each in every if (each.kind, each.place) in places]
    total = np.sum([_columns(each, site.sign(each), evidence.site.largest, rest) for each in own], axis=0)
    return np.asarray(total @ (evidence.size * evidence.prior.root))


def _columns(element: Element, sign: float, largest: float, rest: Rest) -> Array:
    """(N, 30) what curve and sliders over the coordinate of an element do, seen as the residuals are."""
    says = basis_of(sign * element.coordinate, rest.first, largest)
    return rest.seen(sign * element.moved(says, unloaded(), rest.rows))


def without_best(seen: Map) -> Fit:
    """A map's fit with the function at its best site, or the best body, taken off what it leaves, and fitted beside
    its numbers."""
    seen = seen.plain
    found, left, body = seen.found, seen.found.residual, seen.body
    if body is not None and (not seen.sites or body.value > seen.best):
        columns, explained = body.columns, body.columns @ body.weights
    elif seen.sites:
        evidence = seen.sites[0].evidence
        columns, explained = evidence.site.values, evidence.explained
    else:
        return found
    at = (left.rows[:, 0], left.rows[:, 1])
    slopes = np.zeros((*left.values.shape, columns.shape[1]))
    slopes[at] = columns
    values = left.values.copy()
    values[at] -= explained
    return Fit(found.model, found.prediction, replace(left, values=values, slopes=slopes), 0)


def _mapped(found: Fit, effects: Mapping[str, Effect], every: Sequence[Element], rest: Rest) -> Map:
    largest: dict[str, float] = {}
    for each in every:
        size = float(np.max(np.abs(each.coordinate), initial=0.0))
        largest[each.kind] = max(largest.get(each.kind, 0.0), size)
    done: dict[tuple[int, float], Array] = {}

    def of(element: Element, sign: float) -> Array:
        key = (id(element), sign)
        if key not in done:
            done[key] = _columns(element, sign, largest[element.kind], rest)
        return done[key]

    best: dict[str, Located] = {}
    for site in sites(every):
        if not largest[site.kind] > 0.0 or not site.moved:
            continue
        total = np.sum([of(each, site.sign(each)) for each in site.elements], axis=0)
        it = Located(site, rest.evidence(Columns(total, largest[site.kind])))
        if site.name not in best or it.value > best[site.name].value:
            best[site.name] = it
    ordered = sorted(best.values(), key=lambda it: -it.value)
    some = sorted(weighed(found, rest, bodies(found, effects.values())), key=lambda it: -it.value)
    return Map(found, rest, tuple(ordered), tuple(some))
