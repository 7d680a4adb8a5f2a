"""How plausible the sizes of effects are: the one prior that fits, first-order estimates and costs of sets share.

A parameter lies about its nominal value, where the effect is absent, with a standard deviation of `plausible` typical
sizes. It is a wide normal law: it decides only where readings hardly do.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from pipeline.inference.model import Free

Array = NDArray[np.float64]


def weight(plausible: float) -> float:
    """Sigmas that one typical size counts."""
    return 1.0 / plausible


def away(free: Sequence[Free], values: Array, plausible: float) -> Array:
    """(P,) sigmas from the nominal values to values (P,) of these parameters."""
    null = np.array([each.parameter.null for each in free])
    typical = np.array([abs(each.parameter.typical) for each in free])
    return np.asarray((values - null) / typical * weight(plausible))


def implausibility(free: Sequence[Free], values: Array, plausible: float) -> float:
    """Chi-square of values (P,) of these parameters alone."""
    return float(np.sum(away(free, values, plausible) ** 2))
