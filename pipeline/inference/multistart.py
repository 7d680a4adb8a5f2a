"""Where fits begin: sizes on a ladder for effects with kinks, a second look for the others, the best by chi-square."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import partial

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import lsq_linear

from pipeline.inference.fit import Fit, at_null, fit
from pipeline.inference.load_cases import LoadCases
from pipeline.inference.model import Free, Model
from pipeline.inference.nuisances import beside
from pipeline.inference.objective import Objective
from pipeline.inference.parallel_fits import fits_at_once
from pipeline.inference.predicted import Prediction
from pipeline.inference.rounding import AT_BOUND
from pipeline.inference.settings import LADDER
from pipeline.inference.solvers import ALL, Effort, far
from pipeline.inference.subsets import at_rows
from pipeline.inference.thinning import thinned
from vjm.effects.base import Effect

Array = NDArray[np.float64]
Watch = Callable[[str], None]


def best_fit(
    model: Model,
    load_cases: LoadCases,
    new: Collection[str] = (),
    start: Prediction | None = None,
    watch: Watch | None = None,
    plausible: float = np.inf,
    effort: Effort = ALL,
) -> Fit:
    """The best of several fits by chi-square; `evaluations` counts those of all, in solutions of the campaign.

    new: names of the effects that were just added, at null. One with kinks (`smooth` False) begins at the valleys
    of a ladder of sizes of its one-sided numbers, 0.1 to 10 times typical and on while that helps, closer where all
    at once there is too much of it; one that no size helps is absent. If all are smooth the fit begins at null, and
    again at typical sizes if it ends at a bound, with lost rows, or where it says nothing about one of their numbers,
    and a look from there promises more.
    start: a prediction of a like model.
    plausible, effort: see `fit`.
    """
    spent = 0
    kinked = [t.effect for t in model.terms if t.effect.name in new and not t.effect.smooth]
    rows, own = load_cases.by_role[0]
    near = None if start is None else at_rows(start, load_cases, own, rows)
    model, own = beside(model, own, near)
    look = thinned(own, near) if kinked else (own, near)
    begins, present = [model], model
    for effect in kinked:
        ladders = [_ladder(begin, effect, *look, watch) for begin in begins]
        found = [each for found, _ in ladders for each in found][: LADDER.minima]
        spent += sum(count for _, count in ladders)
        if not found:
            present = present.without(effect.name)
        begins = found or [begin.without(effect.name) for begin in begins]
    # Another process has nobody to watch it.
    calls = [
        partial(fit, it, load_cases, start, None if k else watch, plausible, effort.of(len(begins)))
        for k, it in enumerate(begins)
    ]
    fits = fits_at_once(list(zip(begins, calls, strict=True)), load_cases)
    # One that ran out of its work would do so again.
    if not kinked and not fits[0].ended and _doubtful(fits[0], load_cases, new):
        typical = _typical(fits[0].model, new)
        spent += 1
        # Where the linear step from there promises no more there is nothing to find.
        if height(typical, own, near) < fits[0].chi_square - LADDER.worth * max(fits[0].rms, 1.0) ** 2:
            fits.append(fit(typical, load_cases, start, watch, plausible, effort))
    best = min(fits, key=lambda each: each.order)
    best = best if present.names == model.names else at_null(model, best)
    return replace(best, evaluations=spent + sum(each.evaluations for each in fits))


def _sizes(model: Model, effect: Effect) -> list[Free]:
    """The free one-sided numbers of an effect."""
    return [each for each in model.free if each.effect == effect.name and each.parameter.one_sided]


def _ladder(
    model: Model, effect: Effect, load_cases: LoadCases, start: Prediction | None, watch: Watch | None
) -> tuple[list[Model], int]:
    """The model at the valleys of the ladder, best first, and the number of solutions; no valley where no rung leaves
    less than the model without the effect."""
    sizes = _sizes(model, effect)
    if not sizes:
        return [model], 0

    def rung(at: Mapping[str, float]) -> Model:
        values = [at.get(each.name, value) for each, value in zip(model.free, model.values, strict=True)]
        return model.at(np.array(values))

    def look(at: Mapping[str, float]) -> float:
        if watch is not None:
            watch(", ".join(f"{name} = {value:.3g}" for name, value in at.items()))
        return height(rung(at), load_cases, start)

    it = _Ladder(sizes, look)
    it.climb()
    ground = height(model.without(effect.name), load_cases, start)
    it.dig(ground)
    count = len(it.places) + 1
    if min(it.heights) >= ground:
        return [], count
    valleys = _valleys(it.heights, int(np.sum(load_cases.predicted)))[: LADDER.minima]
    return [rung(it.places[k]) for k in valleys], count


@dataclass
class _Ladder:
    """Places on a ladder of sizes, in order, and the height of each."""

    sizes: list[Free]
    height: Callable[[Mapping[str, float]], float]
    places: list[dict[str, float]] = field(default_factory=list)
    heights: list[float] = field(default_factory=list)

    def climb(self) -> None:
        """Up while that may help, and between where an effect does not show and where there is too much of it."""
        at = {s.name: s.parameter.null for s in self.sizes}
        for size in _rungs(self.heights):
            at = {s.name: _rung(s, size, at[s.name]) for s in self.sizes}
            self._look(len(self.places), at)
            least = min(self.heights)
            if self.heights[-1] > LADDER.hopeless * least and self.heights[-1] == max(self.heights[-2:]):
                break
        for _ in range(LADDER.between):
            edge = _edge(self.heights)
            if not edge:
                break
            before, beyond = self.places[edge - 1 : edge + 1]
            self._look(edge, {name: 0.5 * (value + beyond[name]) for name, value in before.items()})

    def dig(self, ground: float) -> None:
        """Down from the first rung where that is the best and leaves no less than the ground: a smaller one may."""
        for _ in range(LADDER.below):
            if not ground <= self.heights[0] == min(self.heights):
                break
            part = LADDER.sizes[0] / LADDER.sizes[1]
            first = self.places[0]
            nulls = {s.name: s.parameter.null for s in self.sizes}
            self._look(0, {name: null + part * (first[name] - null) for name, null in nulls.items()})

    def _look(self, number: int, at: dict[str, float]) -> None:
        self.places.insert(number, at)
        self.heights.insert(number, self.height(at))


def _valleys(heights: list[float], count: int) -> list[int]:
    """Numbers of the rungs that are lower than those beside them, lowest first.

    count: of the squares that each height is the sum of. Where these are far above noise a rise by less than their
    mean parts no valleys.
    """
    padded = [np.inf, *heights, np.inf]
    found: list[int] = []
    rim = LADDER.worth * min(heights) / count if far(min(heights), count) else 0.0
    for k in sorted(range(len(heights)), key=lambda k: heights[k]):
        low = heights[k] <= padded[k] and heights[k] < padded[k + 2]
        low &= k > 0 or heights[k] <= LADDER.foot * min(heights)
        if low and all(max(heights[min(k, j) : max(k, j) + 1]) - heights[k] >= rim for j in found):
            found.append(k)
    return found


def _edge(heights: list[float]) -> int:
    """Number of the first rung worse than those before, where these are several and none is better; else 0.

    Up to such an edge the effect does not show, and beyond it there is too much of it: what is between may be best.
    """
    worse = [k for k, height in enumerate(heights) if height > heights[0] + LADDER.worth]
    return worse[0] if worse and worse[0] > 1 and min(heights) > heights[0] - LADDER.worth else 0


def _rung(each: Free, size: float, before: float) -> float:
    """The number at so many typical sizes; where that is out of bounds half way from the last rung to the bound."""
    low, high = each.bounds
    wanted = each.parameter.null + size * each.parameter.typical
    far = high if each.parameter.typical > 0.0 else low
    beyond = (wanted - far) * each.parameter.typical > 0.0
    return float(np.clip(0.5 * (before + far) if beyond else wanted, low, high))


def _rungs(heights: list[float]) -> Iterator[float]:
    """Sizes to try; beyond the last one as long as each is better than all before."""
    yield from LADDER.sizes
    size = LADDER.sizes[-1]
    while heights[-1] == min(heights) and size < LADDER.largest:
        size *= LADDER.sizes[1] / LADDER.sizes[0]
        yield size


def height(model: Model, load_cases: LoadCases, start: Prediction | None) -> float:
    """Chi-square after one linear step of what is smooth in the model: a rung is judged with the rest fitted."""
    kinked = {t.effect.name for t in model.terms if not t.effect.smooth}
    model = replace(model, fixed=model.fixed | {f.name for f in model.free if f.effect in kinked})
    there = Objective(model, load_cases).at(model.values, start, within=np.inf).with_slopes
    here = Fit(model, there.prediction, there.residual, there.rounds)
    if not model.free:
        return here.chi_square
    scale = np.array([abs(each.parameter.typical) for each in model.free])
    bounds = np.array([each.bounds for each in model.free]).T - np.clip(model.values, *_bounds(model))
    step = lsq_linear(here.jacobian * scale, here.whitened, bounds=_apart(bounds / scale))
    return 2.0 * float(step.cost) + here.residual.charged


def _apart(bounds: Array) -> Array:
    """Bounds (2, P), by typical sizes, that are apart where a number stands at one."""
    return bounds + np.array([[-LADDER.room], [LADDER.room]])


def _bounds(model: Model) -> Array:
    return np.array([each.bounds for each in model.free]).T


def _doubtful(found: Fit, load_cases: LoadCases, new: Collection[str]) -> bool:
    """Whether a fit may have missed the effect."""
    mine = np.array([each.effect in new for each in found.model.free], dtype=bool)
    if not mine.any():
        return False
    low, high = _bounds(found.model)
    near = AT_BOUND * (high - low)
    values, std = found.model.values, found.std
    ended = (values - low <= near) | (high - values <= near) | ~(std < high - low)
    return bool(ended[mine].any() or found.prediction.lost[load_cases.fitted].any())


def _typical(model: Model, new: Collection[str]) -> Model:
    values = [
        float(np.clip(each.parameter.null + each.parameter.typical, *each.bounds))
        if each.effect in new
        else value
        for each, value in zip(model.free, model.values, strict=True)
    ]
    return model.at(np.array(values))
