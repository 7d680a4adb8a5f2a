"""How plausible the sizes of effects are: the one prior that fits, first-order estimates and costs of sets share.

A parameter lies about its nominal value, where the effect is absent, with a standard deviation of `plausible` typical
sizes. Near it that is a wide normal law: it decides only where readings hardly do. Beyond `TAIL` deviations it falls as
a power law, with the same value and slope there: a base a hundred times softer than usual is unusual, and where the
readings ask for it no sum of other effects is more plausible. With t deviations from the nominal value

    chi-square = r(t)²,  r² = t² within c,  c² (1 + 2 ln(t / c)) beyond,  c = TAIL.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from pipeline.inference.model import Free

Array = NDArray[np.float64]
TAIL = 2.0
"""Standard deviations where the power law begins. Its density falls with t to the power -c², as that of Student's law
of three degrees of freedom."""


def away(free: Sequence[Free], values: Array, plausible: float) -> Array:
    """(P,) standard deviations t from the nominal values to values (P,) of these parameters."""
    null = np.array([each.parameter.null for each in free])
    typical = np.array([abs(each.parameter.typical) for each in free])
    return np.asarray((values - null) / (typical * plausible))


def residual(deviations: Array) -> Array:
    """(P,) r(t), with the sign of t: what each parameter adds to the whitened residuals."""
    size = np.maximum(np.abs(deviations), TAIL)
    beyond = TAIL * np.sqrt(1.0 + 2.0 * np.log(size / TAIL))
    return np.asarray(np.where(np.abs(deviations) > TAIL, np.sign(deviations) * beyond, deviations))


def slope(deviations: Array) -> Array:
    """(P,) dr/dt: one near the nominal value, c² / (t r) with c² = r(c)² beyond."""
    size = np.maximum(np.abs(deviations), TAIL)
    return np.asarray(residual(np.array(TAIL)) ** 2 / (size * residual(np.asarray(size))))


def held_back(free: Sequence[Free], values: Array, plausible: float, jacobian: Array) -> float:
    """Chi-square that these parameters, at their best values (P,), would take off the readings without this prior, to
    first order. jacobian: (N, P) whitened, by the parameters in their units."""
    far = away(free, values, plausible)
    scaled = jacobian * np.array([abs(each.parameter.typical) * plausible for each in free])
    push = residual(far) * slope(far)
    # Of the curvature its root: squares of what the readings hardly show are lost beside the others.
    _, sizes, axes = np.linalg.svd(np.vstack([scaled, np.diag(slope(far))]), full_matrices=False)
    return float(np.sum((axes @ push / sizes) ** 2))


def in_tails(free: Sequence[Free], values: Array, plausible: float) -> bool:
    """Whether any of these values (P,) lies where the power law holds."""
    return bool(np.any(np.abs(away(free, values, plausible)) > TAIL))


def implausibility(free: Sequence[Free], values: Array, plausible: float) -> float:
    """Chi-square of values (P,) of these parameters alone."""
    return float(np.sum(residual(away(free, values, plausible)) ** 2))
