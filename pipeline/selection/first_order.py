"""Chi-square of every set of candidates about a fit, to first order: linear algebra on their signatures.

How plausible numbers are counts beside the readings, as it does when sets are compared: what takes implausible numbers
off another effect is worth that, and what would need them itself promises less.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import product

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import lsq_linear

from pipeline.inference.eliminated import Marginal
from pipeline.inference.fit import Fit
from pipeline.inference.orthonormal_basis import basis
from pipeline.inference.prior import away, residual, slope
from pipeline.inference.rounding import RANK, ROUNDING, TINY
from pipeline.selection.signatures import Look, Signature

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Gain:
    """By how much chi-square falls, with that of the numbers; probes: of effects with kinks, those that did best."""

    value: float
    probes: dict[str, float]


Rescue = Callable[[str], float | None]
"""Chi-square of a fit with an effect at its typical size, of what brings back lost rows: these have no slope."""


def unlooked(name: str) -> None:
    """Of a fit without lost rows."""


@dataclass(frozen=True, eq=False)
class FirstOrder:
    """A fit and what could be added to it.

    residual: (N,) whitened, of the rows that are looked at, where what was written about the rig is true. base: (N, P)
    what the fit can move. nominal: (N, K) what a standard deviation of what was written does. tests: (N,) numbers.
    share: of the fitted readings that are looked at. rescue: chi-square with an effect at its typical size, looked at
    once it is asked for; None where no row is lost that it could bring back. plausible: typical sizes of a number that
    count as one sigma.
    """

    fit: Fit
    signatures: dict[str, Signature]
    residual: Array
    base: Array
    nominal: Array
    tests: NDArray[np.int_]
    share: float
    plausible: float
    rescue: Rescue = unlooked

    def without(self, test: int) -> FirstOrder:
        """As if a test had not been done."""
        kept = self.tests != test
        some = {
            name: replace(s, columns=tuple(c[kept] for c in s.columns)) for name, s in self.signatures.items()
        }
        return replace(
            self,
            signatures=some,
            residual=self.residual[kept],
            base=self.base[kept],
            nominal=self.nominal[kept],
            tests=self.tests[kept],
            rescue=unlooked,
        )

    @cached_property
    def _marginal(self) -> tuple[Array, Array, Array]:
        """Residual, base and columns of all candidates, what was written about the rig eliminated."""
        parts = self.residual, self.base, self._flat
        if not self.nominal.shape[1]:
            return parts
        # What is looked at stands for more readings than it has; what was written does not.
        marginal = Marginal.of(self.nominal / np.sqrt(self.share))
        residual, base, flat = (marginal.weakened(each) for each in parts)
        return residual, base, flat

    @cached_property
    def _small(self) -> tuple[Array, dict[str, list[Array]]]:
        """Residual and columns, free of what the fit can move, in an orthonormal basis of all columns."""
        residual, base, flat = self._marginal
        return self._split(*_free_of(base, residual, flat))

    @cached_property
    def _weighed(self) -> tuple[Array, dict[str, list[Array]]]:
        """The same, with how plausible the numbers are: of the fit and of what is added, each a reading more."""
        free = self.fit.model.free
        scale = np.array([abs(f.parameter.typical) for f in free]) * self.plausible
        far = away(free, self.fit.model.values, self.plausible)
        own = np.array([size for s in self.signatures.values() for size in s.sizes])
        zeros = self.base.shape[1] - len(free)
        # What is looked at stands for more readings than it has; numbers do not.
        fitted = np.sqrt(self.share) * np.hstack([np.diag(slope(far) / scale), np.zeros((len(free), zeros))])
        added = np.sqrt(self.share) * np.diag(slope(np.zeros(own.size)) * own / self.plausible)
        misfit, base, flat = self._marginal
        base = np.vstack([base, fitted, np.zeros((len(own), base.shape[1]))])
        misfit = np.concatenate([misfit, -np.sqrt(self.share) * residual(far), np.zeros(len(own))])
        return self._split(*_free_of(base, misfit, np.vstack([flat, np.zeros((len(free), len(own))), added])))

    @property
    def _flat(self) -> Array:
        """(N, all) columns side by side."""
        every = [c for s in self.signatures.values() for c in s.columns]
        return np.hstack([np.zeros((self.residual.size, 0)), *every])

    def _split(self, residual: Array, flat: Array) -> tuple[Array, dict[str, list[Array]]]:
        place = 0
        out: dict[str, list[Array]] = {}
        for name, signature in self.signatures.items():
            out[name] = []
            for columns in signature.columns:
                out[name].append(flat[:, place : place + columns.shape[1]])
                place += columns.shape[1]
        return residual, out

    def gain(self, names: Sequence[str]) -> Gain:
        """By how much chi-square of the whole campaign and of the numbers falls when these effects are added
        together."""
        residual, columns = self._weighed
        best = Gain(self._rescued(names), {})
        for choice in product(*(range(len(columns[name])) for name in names)):
            matrix = np.hstack([columns[name][k] for name, k in zip(names, choice, strict=True)])
            low = np.concatenate([self.signatures[name].low for name in names])
            value = _fall(matrix, residual, low) / self.share
            if value > best.value:
                best = Gain(value, self._probes(names, choice))
        return best

    def within(self, name: str, low: Array, high: Array) -> float:
        """By how much it falls with one smooth effect whose numbers (p,), in typical sizes, lie within bounds."""
        residual, columns = self._weighed
        return max(self._rescued([name]), _fall(columns[name][0], residual, low, high) / self.share)

    def alone(self, name: str) -> tuple[float, Array]:
        """By how much it falls with one smooth effect, and the effect's numbers in typical sizes."""
        residual, columns = self._weighed
        own = columns[name][0]
        step = np.linalg.lstsq(own, residual, rcond=RANK)[0]
        fall = float(residual @ residual - np.sum((residual - own @ step) ** 2))
        return fall / self.share, np.asarray(step, dtype=float)

    def _rescued(self, names: Sequence[str]) -> float:
        """Fall of chi-square by the best of them alone, at its typical size; 0 where none was looked at."""
        there = [found for name in names if (found := self.rescue(name)) is not None]
        return max(0.0, self.fit.chi_square - min(there, default=self.fit.chi_square))

    def _probes(self, names: Sequence[str], choice: tuple[int, ...]) -> dict[str, float]:
        every = {n: self.signatures[n].probes for n in names}
        return {n: every[n][k] for n, k in zip(names, choice, strict=True) if every[n]}

    def columns(self, name: str, probe: int = 0) -> Array:
        """(k, p) of an effect in the basis of all, free of what the fit can move; of kinks those of one probe."""
        return self._small[1][name][probe]


def first_order(
    found: Fit, every: Sequence[Signature], at: Look, plausible: float, rescue: Rescue = unlooked
) -> FirstOrder:
    """Of a fit and the signatures about it."""
    it = found.residual
    used = it.load_cases.predicted & it.load_cases.fitted[:, None]
    rows = at.rows
    mask = used[rows]
    base = np.hstack([it.slopes[rows][mask], it.offsets[rows][mask]])
    tests = np.broadcast_to(it.load_cases.test[rows][:, None], mask.shape)[mask]
    share = float(mask.sum() / max(used.sum(), 1)) or 1.0
    return FirstOrder(
        found,
        {s.effect.name: s for s in every},
        it.as_written[rows][mask],
        base,
        it.nominal[rows][mask],
        tests,
        share,
        plausible,
        rescue,
    )


def _free_of(base: Array, residual: Array, columns: Array) -> tuple[Array, Array]:
    """Residual (N,) and columns (N, K) without what the base can move, in an orthonormal basis of the columns left."""
    free = basis(base)
    whole = np.linalg.norm(columns, axis=0)
    columns = columns - free @ (free.T @ columns)
    # What is left of a column that the base can move is rounding, and as a direction it would look like anything.
    columns = np.where(np.linalg.norm(columns, axis=0) > RANK * whole, columns, 0.0)
    axes, _ = np.linalg.qr(columns)
    return axes.T @ (residual - free @ (free.T @ residual)), axes.T @ columns


def _fall(matrix: Array, residual: Array, low: Array, high: Array | None = None) -> float:
    """By how much the sum of squares falls when the columns may explain the residual, each times what lies within its
    bounds."""
    sizes = np.linalg.norm(matrix, axis=0)
    seen = sizes > RANK * max(sizes.max(initial=0.0), TINY)
    if not seen.any():
        return 0.0
    high = np.full(sizes.size, np.inf) if high is None else high
    # In sizes of columns, as they are looked for.
    matrix, low, high = matrix[:, seen] / sizes[seen], low[seen] * sizes[seen], high[seen] * sizes[seen]
    if np.all(np.isinf(low)) and np.all(np.isinf(high)):
        step = np.linalg.lstsq(matrix, residual, rcond=RANK)[0]
    else:
        step = lsq_linear(matrix, residual, bounds=(low - ROUNDING, high + ROUNDING), method="bvls").x
    return float(residual @ residual - np.sum((residual - matrix @ step) ** 2))
