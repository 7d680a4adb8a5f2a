"""Observed order of convergence, extrapolated value and error band of a mesh study.

Source: I. B. Celik et al., Procedure for estimation and reporting of uncertainty due to discretization in CFD
applications, J. Fluids Eng. 130 (2008) 078001: order from the three finest meshes, band with a safety factor of 1.25.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import log

from scipy.optimize import brentq

SAFETY = 1.25
ORDERS = (0.2, 8.0)


@dataclass(frozen=True)
class Extrapolation:
    """value(h) = limit + c h^order through the three finest meshes.

    `order` is NaN, and `limit` the finest value, where the values do not approach a limit monotonically; the
    band is then the spread of the three.
    """

    limit: float
    order: float
    spread: float

    def band(self, value: float) -> float:
        """Relative error band of a value of the study: 1.25 times its distance to the limit."""
        distance = abs(value - self.limit) if self.order == self.order else self.spread
        return SAFETY * distance / abs(self.limit)


def extrapolate(sizes: Sequence[float], values: Sequence[float]) -> Extrapolation:
    """Extrapolate the three finest of a study; `sizes` in mm, coarse to fine.

    Raises ValueError for fewer than three values or sizes that do not fall.
    """
    h, v = [float(s) for s in sizes], [float(x) for x in values]
    if len(h) != len(v) or len(h) < 3:
        raise ValueError(f"{len(v)} values on {len(h)} meshes, needed are at least three of each")
    if any(a <= b for a, b in pairwise(h)):
        raise ValueError("mesh sizes are not in falling order")
    (h1, h2, h3), (v1, v2, v3) = h[-3:], v[-3:]
    spread = max(v1, v2, v3) - min(v1, v2, v3)
    coarse, fine = v1 - v2, v2 - v3
    unsettled = Extrapolation(v3, float("nan"), spread)
    if coarse * fine <= 0.0 or spread <= 1e-12 * abs(v3):
        return unsettled

    def mismatch(order: float) -> float:
        return log((h1**order - h2**order) / (h2**order - h3**order)) - log(coarse / fine)

    if mismatch(ORDERS[0]) * mismatch(ORDERS[1]) > 0.0:
        return unsettled
    order = float(brentq(mismatch, *ORDERS))
    return Extrapolation(v3 - fine * h3**order / (h2**order - h3**order), order, spread)


def limit_of_two(sizes: tuple[float, float], values: tuple[float, float], order: float) -> Extrapolation:
    """The limit of value(h) = limit + c h^order from two meshes whose order is known from elsewhere.

    The order is that of a quantity of the same field and corners on the same meshes. Raises ValueError for equal sizes
    or an order that is not positive.
    """
    (h1, h2), (v1, v2) = sizes, values
    if h1 == h2 or not order > 0.0:
        raise ValueError(
            f"sizes {h1:g} and {h2:g} mm with order {order:g}, allowed are two sizes, order above 0"
        )
    limit = v1 - (v2 - v1) * h1**order / (h2**order - h1**order)
    return Extrapolation(limit, order, abs(v1 - v2))
