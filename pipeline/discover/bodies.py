"""What is no law at a site by nature and looks like one: factors of the bars, the cell's point and turn, what is not as
drawn. Each is a few numbers beside the sites, known before to their typical size.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pipeline.discover.evidence import Rest, best_scale
from pipeline.inference.fit import Fit
from pipeline.inference.model import Model
from pipeline.inference.prediction import predict
from pipeline.inference.residual import whitening
from vjm.effects.base import Effect
from vjm.effects.sensor_fault import SensorFault

Array = NDArray[np.float64]
WHOLES = ("bars", "platform", "sensors", "links", "drives")
"""Parts whose effects are no laws of a joint or of the base."""


@dataclass(frozen=True, eq=False)
class Body:
    """An effect as columns. value: its evidence, as of `pipeline.discover.evidence`. columns: (N, P) by its numbers, in
    typical sizes. weights: (P,) of these. scale: of their prior."""

    effect: Effect
    value: float
    columns: Array
    weights: Array
    scale: float


def bodies(found: Fit, effects: Iterable[Effect]) -> Mapping[str, Effect]:
    """Those of the effects that are bodies and not in the model of a fit, by name."""
    return {it.name: it for it in effects if _is_body(it) and it.name not in found.model.names}


def _is_body(effect: Effect) -> bool:
    return (
        effect.acts_on in WHOLES
        and not effect.hinge
        and bool(effect.parameters)
        and effect.smooth
        and not effect.history
        and not isinstance(effect, SensorFault)
    )


def weighed(found: Fit, rest: Rest, effects: Mapping[str, Effect]) -> list[Body]:
    """The evidence of each, from derivatives beside null."""
    if not effects:
        return []
    here, cases = found.prediction, found.residual.load_cases
    model = found.model.with_effects(effects.values())
    new = [k for k, each in enumerate(model.free) if each.effect in effects]
    there = predict(model, cases, start=here, shift=here.shift)
    columns = whitening(cases, here).apply(there.by_free[..., new])
    columns[here.lost | there.lost] = 0.0
    free = rest.seen(found.residual.flat(columns))
    out = []
    for name, effect in effects.items():
        own = [k for k, n in enumerate(new) if model.free[n].effect == name]
        sizes = np.array([abs(model.free[new[k]].parameter.typical) for k in own])
        mine = free[:, own] * sizes
        value, weights, scale = best_scale(
            np.eye(len(own)), rest.product(mine, mine), rest.product(mine, rest.residuals)
        )
        out.append(Body(effect, value, mine, weights, scale))
    return out


def started(model: Model, body: Body) -> Model:
    """The model with a body at the numbers that its columns ask for, inside their bounds."""
    new = model.with_effects([body.effect])
    values = new.values
    own = [k for k, each in enumerate(new.free) if each.effect == body.effect.name]
    for k, weight in zip(own, body.weights, strict=True):
        each = new.free[k]
        low, high = each.bounds
        values[k] = float(np.clip(each.parameter.null + weight * abs(each.parameter.typical), low, high))
    return new.at(values)
