"""The own solver: Levenberg-Marquardt in a box, with steps that leave a bound at once."""

from __future__ import annotations

import logging
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import qr
from scipy.optimize import lsq_linear

from pipeline.inference.objective import Evaluation
from pipeline.inference.solvers import Effort, End, Pulled, Watch, idle, nothing
from vjm.effects.base import Parameter
from vjm.work import over

Array = NDArray[np.float64]
LOG = logging.getLogger(__name__)
STEPS = 40
PROMISE = 1e-3
"""Of chi-square, of which noise makes one for every number, a step of 0.03 standard errors; where the model leaves
more than noise, in its mean square."""
VAIN = 0.05
"""Of chi-square, a fifth of a standard error: a smaller promise that is not kept is left, as happens at kinks."""
HALFWAY = 0.5
"""Of what is left to a bound: a step from where an effect hardly shows may lead to what no linkage bears."""
LOSING, LOSSES = 1.0, 8
"""Damping after a step on which rows lost their equilibrium, and how often that may be before a fit ends there."""
ROUGH = 0.1
"""Of what a step promises, by which chi-square at its end may be off."""
SHORTEST = 0.03
"""Of a step not taken, at least, that the next one takes: else as much as a parabola through both its ends wants."""
SLOWLY = 3.0
"""By which the least damping falls after each step that is taken, once one was not."""
WEAK = 1e-10
"""Damping that a step is first shortened by: along what the data hardly see the least shortens most."""
HELD = 0.1
"""Of the number that shows most, in typical sizes each: a damped step takes no other for less."""
LATE = 10
"""A fit that is far above noise ends when so many evaluations took nothing."""
PACE = 3
"""Evaluations over which it is seen how fast a sum of squares falls."""
TINY = 1e-12


def levenberg_marquardt(begin: Evaluation, watch: Watch | None, plausible: float, effort: Effort) -> End:
    """The least chi-square near where an objective is evaluated: Levenberg-Marquardt in a box.

    Each step solves the linear problem within the bounds exactly (P. B. Stark, R. L. Parker, Computational
    Statistics 10, 1995), so that effects leave the bound where they begin at once. With residuals in sigmas the
    stop has a meaning: no step promises more than `PROMISE` of chi-square.
    """
    aim, there, count = begin.objective, begin, 0
    bounds = np.array([each.bounds for each in aim.model.free]).T
    reach = np.array([_reach(each.parameter) for each in aim.model.free]).T
    pulled = Pulled.of(aim, plausible)
    scale, damping, least = pulled.scale, 0.0, 0.0
    refused, losses, past, given_up = np.inf, 0, list[float](), False
    here, slopes = pulled.residuals(there), pulled.jacobian(there)
    for left in reversed(range(STEPS)):
        step = _step(slopes, here, room := (bounds - there.values) / scale * reach, damping)
        promise = here @ here - np.sum((here + slopes @ step) ** 2)
        unit = max(1.0, float(here @ here) / here.size)
        if not promise > _enough(unit, past, here.size):
            # Shorter steps promise nothing, and a longer one from here was not worth taking.
            if _less(damping) >= refused or (damping == 0.0 and there.settled):
                break
            if damping == 0.0:
                there, count = _settled(there, count)
                here, slopes = pulled.residuals(there), pulled.jacobian(there)
                continue
            # It may be the damping that promises so little.
            damping, least = _less(damping), least / 10.0
            continue
        tried = aim.at(
            np.clip(there.values + scale * step, *bounds), there.prediction, within=float(ROUGH * promise)
        )
        count += tried.rounds
        gain = here @ here - np.sum(pulled.residuals(tried) ** 2)
        _tell(watch, count, (float(here @ here), float(gain), float(promise), damping), tried)
        if tried.lost < there.lost or (tried.lost == there.lost and gain > 0.1 * promise):
            there = tried.with_slopes
            here, slopes = pulled.residuals(there), pulled.jacobian(there)
            damping, refused = max(_less(damping), least), np.inf
            least /= SLOWLY
        elif not there.settled and tried.lost == there.lost:
            # Where inputs are not settled a sum of squares is too small, which makes the step look worse.
            there, count = _settled(there, count)
            here, slopes = pulled.residuals(there), pulled.jacobian(there)
        else:
            # Beyond what the linkage bears every row costs many tries: back at once, and no soon return.
            losing, refused = tried.lost > there.lost, min(refused, damping)
            part = max(1.0 / (2.0 - float(gain / promise)), SHORTEST)
            damping = max(10.0 * damping, LOSING) if losing else _shorter(slopes, here, room, damping, part)
            # Along a curved ridge the next step would be as much too long again: it grows by and by.
            least, losses = (damping, losses + 1) if losing else (damping / SLOWLY, losses)
        past.append(float(here @ here))
        vain = gain <= 0.0 and promise < VAIN * unit
        given_up = over() or beaten(past, left, here.size, effort)
        if vain or damping > 1e6 or losses == LOSSES or given_up or drags(past, here.size):
            break
    # Inputs may not be settled where the work ran out, whatever a last step promises.
    return End(there, count, given_up or over())


def _tell(
    watch: Watch | None, count: int, step: tuple[float, float, float, float], tried: Evaluation
) -> None:
    """A step for whoever watches and for the log. step: sum of squares before it, what it gained, what it promised,
    damping."""
    before, gain, promise, damping = step
    if watch is not None:
        watch(f"{count} evaluations, chi-square {min(before, before - gain):.5g}")
    line = "sum of squares %.9g, tried %.9g, promised %.3g less, damping %.3g, rows lost %d, numbers %s"
    LOG.debug(line, before, before - gain, promise, damping, tried.lost, tried.values)


def _enough(unit: float, past: list[float], count: int) -> float:
    """What a step has to promise, after so many sums of squares: the first one little, so that what is small beside
    all that is left is found too."""
    return max(PROMISE * unit, idle(past[-1], count) if past else 0.0)


def _settled(there: Evaluation, count: int) -> tuple[Evaluation, int]:
    """An evaluation with settled inputs, far above noise as far as they settle, and the predictions until then."""
    found = there.settle()
    return replace(found, settled=True).with_slopes, count + found.rounds - there.rounds


def _reach(it: Parameter) -> tuple[float, float]:
    """Of the way to its bounds, how far one step may take a number: half of that to where an effect is strongest."""
    low, high = (HALFWAY if it.one_sided and it.null == other else 1.0 for other in (it.high, it.low))
    return low, high


def drags(past: list[float], count: int) -> bool:
    """Whether sums of squares after each evaluation stay far above noise and hardly fall: no verdict hangs on them."""
    return len(past) > LATE and nothing(past[-1 - LATE] - past[-1], past[-1], count)


def beaten(past: list[float], left: int, count: int, effort: Effort) -> bool:
    """Whether sums of so many squares after each evaluation, should they go on to fall as over the last `PACE`, would
    be far above what another model leaves after so many more."""
    if len(past) <= PACE or not effort.beats(past[-1], count):
        return False
    return effort.beats(past[-1] * (past[-1] / past[-1 - PACE]) ** (left / PACE), count)


def _less(damping: float) -> float:
    return damping / 10.0 if damping > 1e-3 else 0.0


def _shorter(slopes: Array, residuals: Array, box: Array, damping: float, share: float) -> float:
    """The damping that makes the step at least so much shorter."""
    held = _held(np.linalg.norm(slopes, axis=0))

    def length(damping: float) -> float:
        return float(np.linalg.norm(held * _step(slopes, residuals, box, damping)))

    longest = share * length(damping)
    damping = max(10.0 * damping, WEAK)
    while length(damping) > longest:
        damping *= 10.0
    return damping


def _held(size: Array) -> Array:
    """(P,) what numbers are damped by, of their sizes: those that hardly show like those that do, else they would go
    far before their curvature is seen."""
    return np.maximum(size, HELD * size.max(initial=0.0))


def _step(slopes: Array, residuals: Array, box: Array, damping: float) -> Array:
    """(P,) step of least sum of squares within the box (2, P), each column damped by its own size."""
    (triangle,) = qr(np.column_stack([slopes, residuals]), mode="r")
    count = slopes.shape[1]
    triangle, aimed = triangle[:count, :count], triangle[:count, count]
    size = np.linalg.norm(triangle, axis=0)
    size = np.where(size > 0, size, 1.0)
    matrix = np.vstack([triangle, np.sqrt(damping) * np.diag(_held(size))]) / size
    right = np.concatenate([-aimed, np.zeros(size.size)])
    low, high = np.minimum(box[0], 0.0) * size, np.maximum(box[1], 0.0) * size
    found = lsq_linear(matrix, right, bounds=(low - TINY, high + TINY), method="bvls", tol=1e-14)
    return np.asarray(np.clip(found.x, low, high) / size)
