"""The test of the menu that adds most: after it most effects of typical size are seen and told from their rivals."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from pipeline.callbacks import OnProgress
from pipeline.campaign import Campaign
from pipeline.inference.load_cases import load_cases
from pipeline.inference.model import Model
from pipeline.inference.prediction import predict
from pipeline.parameter_names import path_of
from pipeline.plan.isolability import Visible, visible
from pipeline.plan.seen import Seen, seen
from pipeline.selection.possible_tests import Choice, menu
from vjm.effects.base import Effect


@dataclass(frozen=True, eq=False)
class Worth:
    """A test, and what it does: effects that are newly told apart at their typical size; score before and after."""

    choice: Choice
    newly: tuple[str, ...]
    before: float
    after: float


def score(found: list[Visible]) -> float:
    """Sum over all numbers of how near typical sizes are to being seen, and to being told apart; 0 to 2 each."""
    return float(sum(min(1.0, _ratio(v.detected, v)) + min(1.0, _ratio(v.apart, v)) for v in found))


def best_next(
    campaign: Campaign, model: Model, candidates: Mapping[str, Effect], so_far: Seen, on_progress: OnProgress
) -> Worth | None:
    """The best of the menu; None if none adds anything."""
    choices = _borne(menu(campaign), campaign, model)
    if not choices:
        return None
    offered = seen(replace(campaign, tests=tuple(c.test for c in choices)), model, candidates, on_progress)
    now = visible(so_far, candidates)
    here = score(now)
    best: Worth | None = None
    for number, choice in enumerate(choices):
        then = visible(so_far.and_(offered.of(np.array([number]))), candidates)
        after = score(then)
        if after > (here if best is None else best.after) + 0.01:
            best = Worth(choice, _newly(now, then), here, after)
    return best


def _borne(choices: list[Choice], campaign: Campaign, model: Model) -> list[Choice]:
    """Those tests of which the model has an equilibrium at every step: of others nothing can be foretold."""
    if not choices:
        return []
    cases = load_cases(replace(campaign, tests=tuple(c.test for c in choices)))
    lost = set(cases.test[predict(model, cases, slopes=False, order=0).lost].tolist())
    return [choice for number, choice in enumerate(choices) if number not in lost]


def _newly(now: list[Visible], then: list[Visible]) -> tuple[str, ...]:
    """Numbers whose typical size is told apart only then."""
    old = {(v.effect, v.parameter.name) for v in now if _ratio(v.apart, v) >= 1.0}
    return tuple(
        path_of(v.effect, v.parameter.name)
        for v in then
        if _ratio(v.apart, v) >= 1.0 and (v.effect, v.parameter.name) not in old
    )


def _ratio(size: float | None, it: Visible) -> float:
    return 0.0 if size is None else it.typical / size
