"""Shapes of hidden laws: force and coordinate of the order one over the range that the fitted tests reach.

At a hinge the force is drawn over the turn. A series site has to bear the load that passes, so that there the smooth
forms which saturate, or which start without stiffness, give the coordinate over the load; dry friction alone, which
bears no more than its level, and a periodic law are for hinges only.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np

from fem.frame.laws.form import Elastic, Law
from fem.frame.laws.forms import hysteresis, kinked, sliders, smooth, uneven
from fem.frame.laws.forms.wrapped import OverLoad

FLAT = 200.0
"""Stiffness beside a law over the load, in units of its own: half a percent of its reach."""
INSIDE = 1e-3
"""Stiffness inside the gap of a series site, in the same units: of the order of 20 N/mm, as of play."""
SMOOTH = 0.02
"""Part of the range over which a power starts with a finite slope."""


@dataclass(frozen=True)
class Shape:
    """hinge: of a torque over a turn. series: of what bears the load, None where there is none. lopsided: not odd, so
    that at both ends of a bar alike it nearly cancels in a hinge."""

    hinge: Law
    series: Law | None
    lopsided: bool = False


class Draw:
    """Numbers of a case, in the order in which they are asked for."""

    def __init__(self, generator: np.random.Generator, second: bool, load: float) -> None:
        self.generator, self.second, self.load = generator, second, load

    def number(self, low: float, high: float) -> float:
        """Between both, uniform."""
        return float(self.generator.uniform(low, high))

    def signed(self, low: float, high: float) -> float:
        """The same, of either sign."""
        return self.number(low, high) * float(self.generator.choice((-1.0, 1.0)))


def _both(law: Elastic, lopsided: bool = False) -> Shape:
    """The same curve: torque over turn, coordinate over load."""
    return Shape(law, OverLoad(law, FLAT), lopsided)


def _odd_polynomial(d: Draw) -> Shape:
    # Slope 1 + 3 c x² + 5 e x⁴ stays positive where 9 c² < 20 e.
    return _both(smooth.OddPolynomial(1.0, d.signed(0.3, 0.6), d.number(0.2, 0.4)))


def _dead_zone(d: Draw) -> Shape:
    gap = d.number(0.2, 0.5)
    law = kinked.DeadZone(gap, 1.0 / (1.0 - gap), 0.0)
    gap_of_series = kinked.DeadZone(1.0, d.number(3.0, 10.0), INSIDE)
    return Shape(law, OverLoad(law, FLAT) if d.second else gap_of_series)


def _two_slopes(d: Draw) -> Shape:
    slopes = (1.0, d.number(0.2, 0.5))
    plus, minus = slopes if d.generator.random() < 0.5 else slopes[::-1]
    law = kinked.TwoSlopes(plus, minus)
    return Shape(law, law, lopsided=True)


def _power(d: Draw) -> Shape:
    exponent = d.number(0.5, 0.8) if d.generator.random() < 0.5 else d.number(1.4, 2.5)
    law = smooth.Power(1.0, exponent, SMOOTH)
    return Shape(law, OverLoad(law, FLAT) if d.second else law)


def _exponential(d: Draw) -> Shape:
    start = d.number(0.3, 0.6)
    return _both(smooth.Exponential(1.0 / float(np.expm1(1.0 / start)), start))


def _progressive(d: Draw) -> Shape:
    share = d.number(0.2, 0.4)
    law = smooth.Progressive(1.0 / share, 1.0 - share)
    return Shape(law, law)


def _two_levels(d: Draw) -> Shape:
    first = d.number(0.35, 0.65)
    presliding = d.number(0.02, 0.08), d.number(0.3, 0.6)
    return Shape(sliders.CoulombTwoLevels((first, 1.0 - first), presliding), None)


def _by_load(d: Draw) -> Shape:
    share, spring = 1.0 / d.load, 1.0 / d.number(0.02, 0.2)
    hinge = sliders.CoulombByLoad(share, spring)
    return Shape(hinge, sliders.CoulombByLoad(0.5 * share, spring, 1.0))


def _linear_and_coulomb(d: Draw) -> Shape:
    law = sliders.LinearAndCoulomb(1.0, d.number(0.3, 0.6), d.number(0.02, 0.1))
    return Shape(law, law)


def _linear_and_cubic(d: Draw) -> Shape:
    law = smooth.LinearAndCubic(d.number(0.3, 0.6), d.number(0.4, 0.7))
    return _both(law) if d.second else Shape(law, law)


def _creep(d: Draw) -> Shape:
    law = hysteresis.Creep(1.0, d.number(0.5, 1.5), d.number(2.0, 5.0))
    return Shape(law, law)


def _periodic(d: Draw) -> Shape:
    return Shape(smooth.Periodic(0.3, 0.4, d.number(0.3, 0.6), d.number(-0.5, 0.5)), None, lopsided=True)


def _preloaded(d: Draw) -> Shape:
    law = smooth.PreloadedLinear(d.signed(0.3, 0.6), 1.0)
    return Shape(law, law, lopsided=True)


def _same(law: Law, lopsided: bool = False) -> Shape:
    return Shape(law, law, lopsided)


def _two_dead_zones(d: Draw) -> Shape:
    gaps, stiffness = (d.number(0.15, 0.3), d.number(0.4, 0.6)), (1.5, 0.7)
    hinge = kinked.TwoDeadZones(gaps[0], stiffness[0], gaps[1], stiffness[1], 0.0)
    series = kinked.TwoDeadZones(2.0 * gaps[0], 3.0 * stiffness[0], 2.0 * gaps[1], 3.0 * stiffness[1], INSIDE)
    return Shape(hinge, series, lopsided=True)


GRAMMAR: Mapping[str, Callable[[Draw], Shape]] = {
    "Cubic": lambda d: _both(smooth.Cubic(1.0)),
    "OddPolynomial": _odd_polynomial,
    "EvenPart": lambda d: _both(smooth.EvenPart(1.0, d.signed(0.2, 0.3)), lopsided=True),
    "Tanh": lambda d: _both(smooth.Tanh(1.0, d.number(0.15, 0.4))),
    "Atan": lambda d: _both(smooth.Atan(1.0, d.number(0.15, 0.4))),
    "DeadZone": _dead_zone,
    "TwoSlopes": _two_slopes,
    "Power": _power,
    "Exponential": _exponential,
    "Progressive": _progressive,
    "Coulomb": lambda d: Shape(sliders.Coulomb(1.0, d.number(0.02, 0.2)), None),
    "CoulombTwoLevels": _two_levels,
    "CoulombByLoad": _by_load,
    "Iwan": lambda d: Shape(sliders.Iwan(1.0, d.number(0.3, 1.0)), None),
    "LinearAndCoulomb": _linear_and_coulomb,
    "LinearAndCubic": _linear_and_cubic,
    "Creep": _creep,
    "Periodic": _periodic,
    "PreloadedLinear": _preloaded,
    "Linear": lambda d: _same(smooth.Linear(1.0)),
}
"""Laws that a grammar of usual forms has."""
OUTSIDE: Mapping[str, Callable[[Draw], Shape]] = {
    "BoucWen": lambda d: _same(hysteresis.BoucWen(0.5, 0.6, d.number(0.1, 0.3))),
    "Staircase": lambda d: _same(uneven.Staircase(0.3, 0.8, 1.0, d.number(0.04, 0.08)), lopsided=True),
    "TwoDeadZones": _two_dead_zones,
    "LogisticAndCubic": lambda d: _same(
        uneven.LogisticAndCubic(0.8, d.signed(0.15, 0.4), 0.08, 0.1, 0.3), lopsided=True
    ),
    "RambergOsgood": lambda d: _same(sliders.RambergOsgood(1.0, d.number(0.2, 0.4), 0.5, 4.0, 2.0)),
    "Detent": lambda d: _same(
        uneven.Detent(1.0, d.signed(0.2, 0.25), d.signed(0.3, 0.5), 0.25), lopsided=True
    ),
    "Dahl": lambda d: _same(hysteresis.Dahl(0.5, 0.5, d.number(0.1, 0.3))),
    "OneSidedHysteresis": lambda d: _same(hysteresis.OneSidedHysteresis(1.0, 0.4, 0.6, 6.0), lopsided=True),
    "Damage": lambda d: _same(hysteresis.Damage(1.2, d.number(0.4, 0.55), 0.3, 0.4)),
    # Its jump goes over 0.04 of a range that is 2 wide.
    "Jump": lambda d: _same(uneven.Jump(0.8, 0.3, d.signed(0.25, 0.5), 0.04), lopsided=True),
}
"""Laws that it does not have."""
SMOOTH_LAWS = ("Cubic", "EvenPart", "Tanh", "Atan", "Exponential", "Progressive", "LinearAndCubic", "Linear")
"""Of cases with two laws: no gap, no memory."""
EVERY = {**GRAMMAR, **OUTSIDE}
