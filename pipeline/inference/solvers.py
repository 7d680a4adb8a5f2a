"""What a solver of the free parameters is given and returns, and scipy's solver, by which the own one is checked."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Protocol

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import least_squares

from pipeline.inference.load_cases import LoadCases
from pipeline.inference.objective import Evaluation, Objective
from pipeline.inference.prior import away, residual, slope
from vjm.work import over

Array = NDArray[np.float64]
Watch = Callable[[str], None]
FAR = 2.0
"""A model that leaves so many times what noise does is far from it: no verdict hangs on how much it leaves."""
DRAGGING = 0.01
"""Of what is left beyond noise: less than this is nothing there."""
WORK, ROWS = 1000.0, 20
"""Work (`vjm.work`) after which a fit of no row ends where it is, and the rows for which it takes as many again. The
longest fits of eleven of the slowest benches take three quarters of that; where rows have no equilibrium each
evaluation takes a hundred times as long."""
NO_NEARER = 10.0
"""Times what another model leaves: far above it."""
TOLERANCE = 1e-10
"""Of scipy's solver, for chi-square, the parameters and the gradient, each relative."""
LARGEST = 1e9
"""Typical sizes that a bound of scipy's solver may be away."""


@dataclass(frozen=True, eq=False)
class Pulled:
    """An objective with a pull towards null, and its derivatives by typical sizes.

    scale, null: (P,). plausible: typical sizes that are one sigma of the pull.
    """

    aim: Objective
    scale: Array
    null: Array
    plausible: float

    @classmethod
    def of(cls, aim: Objective, plausible: float) -> Pulled:
        free = aim.model.free
        scale = np.array([abs(each.parameter.typical) for each in free])
        null = np.array([each.parameter.null for each in free])
        return cls(aim, scale, null, plausible)

    def residuals(self, there: Evaluation) -> Array:
        """(N + 1 + P,)"""
        return np.concatenate([there.residuals, residual(self._away(there))])

    def jacobian(self, there: Evaluation) -> Array:
        """(N + 1 + P, P)"""
        pull = np.diag(slope(self._away(there)) / self.plausible)
        return np.vstack([there.jacobian * self.scale, pull])

    def _away(self, there: Evaluation) -> Array:
        return away(self.aim.model.free, there.values, self.plausible)


@dataclass(frozen=True, eq=False)
class End:
    """Where a descent ends. evaluations: of the campaign. ended: whether its work ran out before."""

    there: Evaluation
    evaluations: int
    ended: bool


@dataclass(frozen=True)
class Effort:
    """What a fit may take. share: of its work. known: chi-square that another model leaves to the same readings: one
    that would not come near it at the pace at which it falls ends where it is."""

    share: float = 1.0
    known: float = np.inf

    def beats(self, total: float, count: int) -> bool:
        """Whether a sum of so many squares is far above what another model leaves."""
        return total > NO_NEARER * max(self.known, count)

    def of(self, count: int) -> Effort:
        """That of each of so many fits of which the best is taken."""
        return replace(self, share=self.share / count)


ALL = Effort()
"""As much as any fit may take."""


class Solver(Protocol):
    """Finds the least chi-square near where an objective is evaluated, within its bounds.

    plausible: see `fit`. Its end counts the evaluations after that.
    """

    def __call__(self, begin: Evaluation, watch: Watch | None, plausible: float, effort: Effort) -> End: ...


def trust_region(begin: Evaluation, watch: Watch | None, plausible: float, effort: Effort) -> End:
    """The trust region reflective method of scipy (M. A. Branch, T. F. Coleman, Y. Li, SIAM J. Sci. Comput. 21, 1999).

    Every evaluation settles the true inputs, which takes longer than the own solver; it may be cut by its work only
    where it ends.
    """
    aim, here = begin.objective, begin.settle()
    count = here.rounds - begin.rounds
    bounds = np.array([each.bounds for each in aim.model.free]).T
    pulled = Pulled.of(aim, plausible)
    wide = np.clip((bounds - pulled.null) / pulled.scale, -LARGEST, LARGEST)

    def there(x: Array) -> Evaluation:
        nonlocal here, count
        values = np.clip(pulled.null + pulled.scale * x, *bounds)
        if not np.array_equal(values, here.values):
            here = aim.at(values, here.prediction)
            count += here.rounds
            if watch is not None:
                watch(f"{count} evaluations, chi-square {float(here.residuals @ here.residuals):.5g}")
        return here

    inside = 1e-9 * np.minimum(wide[1] - wide[0], 1.0)
    found = least_squares(
        lambda x: pulled.residuals(there(x)),
        np.clip((here.values - pulled.null) / pulled.scale, wide[0] + inside, wide[1] - inside),
        lambda x: pulled.jacobian(there(x).with_slopes),
        bounds=wide,
        ftol=TOLERANCE,
        xtol=TOLERANCE,
        gtol=TOLERANCE,
    )
    return End(there(found.x).with_slopes, count, over())


def far(total: float, count: int) -> bool:
    """Whether a sum of so many squares is far above noise."""
    return total > FAR * count


def nothing(gain: float, total: float, count: int) -> bool:
    """Whether a sum of so many squares is far above noise, and what it fell by is nothing."""
    return far(total, count) and gain < DRAGGING * (total - count)


def idle(total: float, count: int) -> float:
    """Part of a sum of so many squares that is not worth an evaluation: none near noise, a tenth of nothing far from
    it."""
    return 0.1 * DRAGGING * (total - count) if far(total, count) else 0.0


def allowance(load_cases: LoadCases) -> float:
    """Work that a campaign may take, as a multiple of that of a parallelogram without any rows."""
    return load_cases.unknowns + float(load_cases.fitted.sum()) / ROWS
