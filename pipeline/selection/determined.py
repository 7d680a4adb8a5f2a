"""Which numbers of a set the data determine: one that they do not is no part of an explanation."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from pipeline.inference.fit import Fit, fit
from pipeline.inference.intervals import has_an_end, profile_likelihood
from pipeline.inference.load_cases import LoadCases
from pipeline.inference.model import Model, at_bound
from pipeline.selection.criteria import Criteria


def undetermined(found: Fit, whole: LoadCases) -> tuple[str, ...]:
    """Names effect.parameter of the free numbers about which the data say nothing by themselves."""
    land = profile_likelihood(found, whole)
    return tuple(each.name for k, each in enumerate(found.model.free) if not has_an_end(land, k))


def blind(found: Fit, whole: LoadCases) -> frozenset[str]:
    """Names of the effects with numbers of which the data determine none: of two that do the same, each is."""
    told = undetermined(found, whole)
    names = (term.effect.name for term in found.model.terms)
    numbers = {name: [free.name for free in found.model.free if free.effect == name] for name in names}
    return frozenset(name for name, its in numbers.items() if its and set(its) <= set(told))


def determined(found: Fit, whole: LoadCases, criteria: Criteria) -> Fit:
    """The fit with numbers that nothing determines put at their null and left there, those that show least first.

    One that ends at its bound is not determined either where null fits as well: near a bound an effect may be far from
    linear, so the derivatives there do not say how far the number may go. What only combinations determine is told by
    as many numbers as there are combinations. The same fit where all are determined, or where it would leave more.
    """
    here = found
    while unseen := tuple(dict.fromkeys((*undetermined(here, whole), *at_bound(here.model)))):
        fewer = _with_one_less(here, unseen, whole, criteria, found.chi_square)
        if fewer is None:
            return found
        here = fewer
    return here


def _with_one_less(
    here: Fit, unseen: Sequence[str], whole: LoadCases, criteria: Criteria, least: float
) -> Fit | None:
    """The fit with one of these numbers at null that leaves hardly more than the least; None where each leaves more.

    Of a product of two numbers, such as the spring of a friction that never slips, one at null is no effect at all, the
    other at its usual size tells the product.
    """
    free = {each.name: k for k, each in enumerate(here.model.free)}
    sizes = {n: float(np.linalg.norm(here.jacobian[:, free[n]])) * _typical(here, free[n]) for n in unseen}
    for name in sorted(unseen, key=lambda each: sizes[each]):
        fewer = fit(_nulled(here.model, name), whole, here.prediction, None, criteria.plausible)
        if fewer.chi_square <= least + criteria.undetermined_rise:
            return fewer
    return None


def _typical(found: Fit, k: int) -> float:
    return abs(found.model.free[k].parameter.typical)


def _nulled(model: Model, name: str) -> Model:
    values = model.values
    for k, each in enumerate(model.free):
        if each.name == name:
            values[k] = each.parameter.null
    return replace(model.at(values), fixed=model.fixed | {name})
