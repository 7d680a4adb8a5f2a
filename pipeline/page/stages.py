"""The error on the way from plain virtual springs to a model, one effect more at each stage."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

from pipeline.add.summary import error_of
from pipeline.answer import ModelError
from pipeline.compare.error import Discrepancy
from pipeline.inference.fit import Fit, fit
from pipeline.inference.inputs import linearised
from pipeline.inference.model import Model
from pipeline.inference.program import Program

Say = Callable[[str], None]


@dataclass(frozen=True, eq=False)
class Stages:
    """error: of every stage, the plain model first. before, after: the first and the last against the data."""

    error: tuple[ModelError, ...]
    before: Discrepancy
    after: Discrepancy


def stages(model: Model, cases: Program, say: Say = lambda _: None) -> Stages:
    """Every stage fitted from the model's own values; the model itself is taken as it is."""
    say("plain virtual springs")
    plain = as_it_is(Model(), cases)
    found = [(plain, 0)]
    for count in range(1, len(model.terms)):
        part = replace(model, terms=model.terms[:count])
        say(" + ".join(part.names))
        found.append((fit(part, cases, plain.prediction), len(part.free)))
    if model.terms:
        say(" + ".join(model.names))
        found.append((as_it_is(model, cases), len(model.free)))
    errors = tuple(error_of(each, cases, free) for each, free in found)
    first, last = (Discrepancy(cases, each.prediction, free) for each, free in (found[0], found[-1]))
    return Stages(errors, first, last)


def as_it_is(model: Model, cases: Program) -> Fit:
    """A model against the data with nothing fitted but the inputs, which were measured as well."""
    fixed = replace(model, fixed=frozenset(each.name for each in model.free) | model.fixed)
    there, left = linearised(fixed, cases)
    return Fit(fixed, *linearised(fixed, cases, start=there, shift=left.shift), 2)
