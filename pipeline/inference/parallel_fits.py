"""Fits that are made at once: between processes go numbers alone, the rest is where it was."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from functools import partial

import numpy as np

from pipeline.inference.fit import Fit
from pipeline.inference.load_cases import Group, LoadCases
from pipeline.inference.model import Model, Term
from pipeline.inference.predicted import Prediction
from pipeline.inference.residual import residual
from pipeline.processors import at_once
from vjm.equilibrium import Equilibrium

Bare = list[np.ndarray]
"""A state without its mechanism: what laws of a user's own are made of may not be sent."""
Values = tuple[Mapping[str, float], ...]
"""Of the effects of a model, in order."""
Numbers = tuple[Values, frozenset[str], tuple[Term, ...], Prediction, list[Bare], int, bool, bool]


def fits_at_once(calls: Sequence[tuple[Model, Callable[[], Fit]]], load_cases: LoadCases) -> list[Fit]:
    """Fits of models to load cases, each with the call that makes it; same as one after the other."""
    found = at_once([partial(_numbers, call) for _, call in calls])
    return [_fit(model, each, load_cases) for (model, _), each in zip(calls, found, strict=True)]


def _numbers(call: Callable[[], Fit]) -> Numbers:
    found = call()
    bare = [state.arrays for state in found.prediction.states]
    whole = replace(found.prediction, states=())
    it, values = found.model, tuple(term.values for term in found.model.terms)
    return values, it.fixed, it.nominals, whole, bare, found.evaluations, found.ended, found.own_line


def _fit(model: Model, numbers: Numbers, load_cases: LoadCases) -> Fit:
    values, fixed, nominals, prediction, bare, evaluations, ended, own_line = numbers
    terms = tuple(replace(term, values=own) for term, own in zip(model.terms, values, strict=True))
    model = replace(model, terms=terms, fixed=fixed, nominals=nominals)
    states = tuple(_state(model, load_cases, *each) for each in zip(load_cases.groups, bare, strict=True))
    prediction = replace(prediction, states=states)
    return Fit(model, prediction, residual(load_cases, prediction), evaluations, ended, own_line)


def _state(model: Model, load_cases: LoadCases, group: Group, bare: Bare) -> Equilibrium:
    return Equilibrium(model.mechanism(group, load_cases.campaign.gauges), *bare)
