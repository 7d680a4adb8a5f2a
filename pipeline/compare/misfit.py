"""How a prediction fails: the residual of one channel as a few numbers, each with its standard error.

Model of each number: rho = N n + x v + noise, where rho is the residual (measured minus predicted) in the channel's
unit, N holds the nuisance regressors, x the number's own regressor and v the number. Weighted least squares with
known sigmas gives, with the part x' of x/sigma that N/sigma does not explain and the whitened residual r,

    v = x'·r / x'·x',    std(v) = 1 / |x'|,

without rescaling by chi-square. Every number stands alone: a true curvature also shows in the asymmetry, and the
other way round, and any large misfit shows in the scatter.

The regressors, with the load s, its largest magnitude S and its direction of change D (-1, 0, 1):

| number      | regressor                           | nuisances        | means                                        |
|-------------|-------------------------------------|------------------|----------------------------------------------|
| offset      | 1                                   | s                | misfit at zero load                          |
| slope       | s                                   | 1                | misfit of a stiffness or compliance          |
| curvature   | s²                                  | 1, s             | misfit that bends                            |
| asymmetry   | abs(s)                              | 1, s             | half of slope in tension less compression     |
| dead_band   | s / (S/20), clipped to -1 .. 1      | 1, s             | half the jump at zero load                   |
| loop        | D / (2 range of s)                  | 1, s, s²         | area between rising and falling load         |
| step        | step                                | 1 a test, s      | drift                                        |
| temperature | temperature                         | 1, s             | growth with temperature                      |
| q           | q                                   | 1, s             | offset that grows with the angle             |
| slope_q     | s (abs(q) - mean)                   | 1, s, abs(q)     | slope that grows with the angle's magnitude  |
| scatter     | abs(s), on normal scores of abs(r)  | 1                | size of the misfit that grows with the load  |

The normal score of abs(r) is the standard normal variable of the same rank, so that noise alone gives a normal
estimate here too. Reference: N. R. Draper, H. Smith, Applied Regression Analysis, 3rd ed., Wiley 1998, ch. 2 and 5.
"""

from collections.abc import Iterable
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray
from scipy.stats import norm

Array = NDArray[np.float64]
TOLD_APART = 0.01
"""A regressor of which the nuisances explain all but this part is not reported: its error bar would be ten times
that of the regressor alone, and any further effect would pass for it."""
BAND = 0.05
"""Part of the largest load within which the jump of a dead band takes place."""


@dataclass(frozen=True, eq=False)
class Series:
    """One channel over the steps of one test or of several, in the order in which they were done.

    residual: (N,) measured minus predicted, in sigmas. load: (N,) the channel's own driving load or displacement.
    sigma: (N,) in the channel's `unit`; ones with the unit "sigma" leave the numbers in sigmas. q: (N,) rad.
    step: (N,). temperature: (N,) °C or None. test: (N,) number of the test. rising: (N,) direction of the motion,
    -1, 0, 1; None: that of the load. ValueError for other shapes, values that are not finite, a sigma of zero.
    """

    residual: Array
    load: Array
    sigma: Array
    q: Array
    step: Array
    test: NDArray[np.int64]
    temperature: Array | None = None
    rising: Array | None = None
    unit: str = "sigma"
    load_unit: str = "N"

    def __post_init__(self) -> None:
        for name in ("residual", "load", "sigma", "q", "step", "test", "temperature", "rising"):
            value = getattr(self, name)
            if value is not None and np.shape(value) != np.shape(self.residual):
                raise ValueError(
                    f"{name} has shape {np.shape(value)}, the residual {np.shape(self.residual)}"
                )
            if value is not None and not np.isfinite(value).all():
                raise ValueError(f"{name} has values that are not finite")
        if np.any(self.sigma <= 0.0):
            raise ValueError("sigma must be positive")


@dataclass(frozen=True)
class Signature:
    """One number of a misfit. std: its standard error. significance: abs(value) / std, normal under noise alone."""

    name: str
    value: float
    std: float
    unit: str
    significance: float


@dataclass(frozen=True)
class Misfit:
    """The numbers that the data determine, and for the others the reason why not."""

    signatures: tuple[Signature, ...]
    omitted: dict[str, str] = field(default_factory=dict)

    def __getitem__(self, name: str) -> Signature:
        return next(s for s in self.signatures if s.name == name)


def direction(load: Array, test: NDArray[np.int64]) -> Array:
    """(N,) sign of the load's change since the step before; the first step of a test has that of its second."""
    change = np.sign(np.diff(load, prepend=load[:1]))
    first = np.flatnonzero(np.diff(test, prepend=test[:1] - 1) != 0)
    following = np.minimum(first + 1, load.size - 1)
    alone = (following == first) | (test[following] != test[first])
    change[first] = np.where(alone, 0.0, change[following])
    return np.asarray(change, dtype=float)


def misfit(series: Series) -> Misfit:
    """Every number of the table above that the series determines."""
    found, omitted = [], {}
    for name, (regressor, nuisances, unit) in _regressors(series).items():
        if regressor is None:
            omitted[name] = "not measured"
            continue
        scores = name == "scatter"
        sigma = np.ones_like(series.sigma) if scores else series.sigma
        target = _scores(series.residual) if scores else series.residual
        estimate = _alone(regressor / sigma, nuisances / sigma[:, None], target)
        if estimate is None:
            omitted[name] = "these steps do not tell it from what is simpler"
        else:
            value, std = estimate
            found.append(Signature(name, value, std, unit, abs(value) / std))
    return Misfit(tuple(found), omitted)


def explained(series: Series, signature: Signature) -> Array:
    """(N,) what a number of `misfit` explains of the residual, in sigmas; zeros for the scatter."""
    regressor, _, _ = _regressors(series)[signature.name]
    if signature.name == "scatter" or regressor is None:
        return np.zeros_like(series.residual)
    return np.asarray(signature.value * regressor / series.sigma)


def flagged(signatures: Iterable[Signature], rate: float = 0.05) -> tuple[Signature, ...]:
    """Those that noise alone would not give: at most the part `rate` of all looks at noise raises any flag.

    Bonferroni: with m numbers looked at, of all tests and channels together, each is held to rate / m on both sides;
    that is safe however they depend on each other.
    """
    looked_at = tuple(signatures)
    if not looked_at:
        return ()
    edge = norm.isf(0.5 * rate / len(looked_at))
    return tuple(s for s in looked_at if s.significance > edge)


def _regressors(series: Series) -> dict[str, tuple[Array | None, Array, str]]:
    """Own regressor (None: not there), nuisances (N, k) and unit of each number."""
    s, q = series.load, series.q
    one, size, reach = np.ones_like(s), np.abs(s), max(float(np.ptp(s)), np.finfo(float).tiny)
    largest = max(float(size.max(initial=0.0)), np.finfo(float).tiny)
    turn = _centred(np.abs(q))
    rising = direction(s, series.test) if series.rising is None else series.rising
    by_test = (series.test[:, None] == np.unique(series.test)).astype(float)
    line = np.column_stack([one, s])
    u, v = series.unit, series.load_unit
    return {
        "offset": (one, s[:, None], u),
        "slope": (s, one[:, None], f"{u}/{v}"),
        "curvature": (s**2, line, f"{u}/{v}²"),
        "asymmetry": (size, line, f"{u}/{v}"),
        "dead_band": (np.clip(s / (BAND * largest), -1.0, 1.0), line, u),
        "loop": (rising / (2.0 * reach), np.column_stack([line, s**2]), f"{u}·{v}"),
        "step": (_centred(series.step), np.column_stack([by_test, s]), f"{u}/step"),
        "temperature": (None if series.temperature is None else _centred(series.temperature), line, f"{u}/K"),
        "q": (_centred(q), line, f"{u}/rad"),
        "slope_q": (s * turn, np.column_stack([line, turn]), f"{u}/({v}·rad)"),
        "scatter": (size, one[:, None], f"score/{v}"),
    }


def _centred(values: Array) -> Array:
    """Less their mean, which an offset explains anyway; zeros where they are all the same."""
    constant = np.ptp(values) <= 1e-9 * np.max(np.abs(values))
    return np.zeros_like(values) if constant else values - np.mean(values)


def _alone(regressor: Array, nuisances: Array, target: Array) -> tuple[float, float] | None:
    """Value and standard error of a regressor beside its nuisances; None where they explain it."""
    scale = np.linalg.norm(nuisances, axis=0)
    length = np.linalg.norm(regressor)
    if length == 0.0:
        return None
    x = regressor / length
    basis, sizes, _ = np.linalg.svd(nuisances[:, scale > 0] / scale[scale > 0], full_matrices=False)
    basis = basis[:, sizes > 1e-10 * sizes.max(initial=0.0)]
    # Twice: the first pass leaves rounding of the size of x.
    for _ in range(2):
        x = x - basis @ (basis.T @ x)
    left = float(x @ x)
    if left < TOLD_APART:
        return None
    return float(x @ target / left / length), float(1.0 / np.sqrt(left) / length)


def _scores(residual: Array) -> Array:
    """Standard normal variable of the rank that abs(residual) has among those of normal noise."""
    # Beyond these bounds the score itself would be infinite.
    size = np.clip(np.abs(residual), 1e-12, 37.0)
    return np.asarray(norm.isf(2.0 * norm.sf(size)), dtype=float)
