"""What was written down about a rig, as nuisance parameters: known but for a standard deviation, fitted beside effects.

Each is counted in standard deviations u from its nominal value, with the prior u ~ N(0, 1). They are eliminated
linearly about a point (`pipeline.inference.eliminated`), and linearised once more at their estimate.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from pipeline.campaign import Campaign
from pipeline.campaign.names import channel_columns
from pipeline.inference.load_cases import LoadCases
from pipeline.inference.model import Model, Term
from pipeline.inference.predicted import Prediction
from pipeline.inference.prediction import predict
from pipeline.inference.settings import WRITTEN
from pipeline.inference.suitable import columns_read
from pipeline.parameter_names import path_of
from vjm.effects.base import Parameter
from vjm.tolerances import tolerances
from vjm.tolerances.angle import POSTURE
from vjm.tolerances.base import Tolerance
from vjm.tolerances.gain import Gain

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Nominal:
    """One number that was written down. deviation: its standard deviation, in the parameter's unit."""

    tolerance: Tolerance
    parameter: Parameter
    deviation: float

    @property
    def path(self) -> str:
        """Among the numbers of a model: tolerance.parameter."""
        return path_of(self.tolerance.name, self.parameter.name)

    @property
    def name(self) -> str:
        """In results: its key in the table of tolerances, with the parameter where the key has several."""
        key = self.tolerance.keys[self.parameter.name]
        if isinstance(self.tolerance, Gain):
            return f"{key} of {self.tolerance.column}"
        several = list(self.tolerance.keys.values()).count(key) > 1
        return path_of(key, self.parameter.name) if several else key


def nominals(campaign: Campaign) -> tuple[Nominal, ...]:
    """Those of a campaign, none where all is exact."""
    known = {key: value for key, value in campaign.tolerance.items() if key in campaign.rig.written}
    of_rig = (
        Nominal(it, p, known[it.keys[p.name]])
        for it in tolerances()
        for p in it.parameters
        if known.get(it.keys[p.name], 0.0) > 0.0
    )
    return (*of_rig, *_gains(campaign))


def _gains(campaign: Campaign) -> Iterator[Nominal]:
    """Of the sensors that were read and whose gain is known to a standard deviation."""
    columns, gains = channel_columns(campaign.gauges), campaign.noise.gains
    read = columns_read(campaign)
    for channel in np.flatnonzero(gains > 0.0):
        if columns[channel] in read:
            it = Gain().at(columns[channel])
            yield Nominal(it, it.parameters[0], float(gains[channel]))


def departed(model: Model, numbers: tuple[Nominal, ...], at: Array) -> Model:
    """The model with what was written at (K,) standard deviations from it, no farther than `WRITTEN.farthest`."""
    values: dict[str, dict[str, float]] = {}
    kept = np.clip(at, -WRITTEN.farthest, WRITTEN.farthest)
    for each, u in zip(numbers, kept, strict=True):
        own = values.setdefault(each.tolerance.name, each.tolerance.nulls)
        own[each.parameter.name] = each.parameter.null + float(u) * each.deviation
    known = {each.tolerance.name: each.tolerance for each in numbers}
    return replace(model, nominals=tuple(Term(known[name], own) for name, own in values.items()))


def departures(model: Model, numbers: tuple[Nominal, ...]) -> Array:
    """(K,) standard deviations from what was written at which a model is."""
    values = {term.effect.name: term.values for term in model.nominals}
    return np.array(
        [
            (values[n.tolerance.name][n.parameter.name] - n.parameter.null) / n.deviation
            if n.tolerance.name in values
            else 0.0
            for n in numbers
        ]
    )


def lined(model: Model, cases: LoadCases, near: Prediction | None) -> Prediction:
    """The readings of a model with their derivative by each number that was written, in its standard deviations, at the
    inputs of a prediction near by."""
    numbers = nominals(cases.campaign)
    at = departures(model, numbers)
    here = departed(model, numbers, at).nominals
    own = {each.path for each in numbers}
    moved = Model((*here, *model.terms), _fixed(here, own) | _fixed(model.terms, set()))
    shift = None if near is None else near.shift
    found = predict(moved, cases, start=near, shift=shift, order=WRITTEN.order)
    names = [each.name for each in moved.free]
    order = [names.index(each.path) for each in numbers]
    deviations = np.array([each.deviation for each in numbers])
    out = np.asarray(found.by_free[..., order] * deviations)
    for k in [k for k, each in enumerate(numbers) if each.parameter.name == POSTURE]:
        # No number of the mechanism: the tests are solved again at another angle.
        there = departed(model, numbers, at + WRITTEN.step * np.eye(len(numbers))[k])
        other = predict(there, cases, slopes=False, start=found, shift=shift, order=0)
        both = ~(other.lost | found.lost)
        out[both, :, k] = (other.values - found.values)[both] / WRITTEN.step
    return replace(found, by_free=found.by_free[..., :0], nominal=at, by_nominal=out)


def beside(model: Model, cases: LoadCases, near: Prediction | None) -> tuple[Model, LoadCases]:
    """A model with what was written as it is in a prediction of a like one, and the load cases along the line of
    that; as they are where it has none."""
    if near is None or not near.nominal.size:
        return model, cases
    return departed(model, nominals(cases.campaign), near.nominal), replace(cases, by_nominal=near.by_nominal)


def _fixed(terms: tuple[Term, ...], free: set[str]) -> frozenset[str]:
    every = (path_of(term.effect.name, p.name) for term in terms for p in term.effect.parameters)
    return frozenset(name for name in every if name not in free)
