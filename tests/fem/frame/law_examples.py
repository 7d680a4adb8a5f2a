"""An example of each law with a second route to its force: formulas of one number at a time, or fine integration."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from math import atan, copysign, exp, expm1, pi, sin, tanh

import numpy as np
from scipy.optimize import brentq

from fem.frame.laws.form import Elastic, Law
from fem.frame.laws.forms import hysteresis, kinked, sliders, smooth, uneven, wrapped

Route = Callable[[Sequence[float]], list[float]]
"""Forces after each of the coordinates of a history, from the unloaded state."""


def elastic(force: Callable[[float], float]) -> Route:
    """Of a law without memory."""
    return lambda history: [force(q) for q in history]


def stops(*elements: tuple[float, float], spring: float = 0.0) -> Route:
    """Springs with sliders (force, presliding): each carries what it did before and k dq, at most its force."""

    def route(history: Sequence[float]) -> list[float]:
        carried, before, out = [0.0] * len(elements), 0.0, []
        for q in history:
            for i, (most, presliding) in enumerate(elements):
                carried[i] = min(most, max(-most, carried[i] + most / presliding * (q - before)))
            before = q
            out.append(spring * q + sum(carried))
        return out

    return route


def integrated(rate: Callable[[float, float], float], spring: float, size: float) -> Route:
    """spring q + size z, dz = rate(z, sign of dq) |dq|, by the midpoint rule in fine steps."""

    def route(history: Sequence[float]) -> list[float]:
        z, before, out = 0.0, 0.0, []
        for q in history:
            parts = 4000
            h, sign = abs(q - before) / parts, copysign(1.0, q - before)
            for _ in range(parts):
                middle = z + 0.5 * h * rate(z, sign)
                z += h * rate(middle, sign)
            before = q
            out.append(spring * q + size * z)
        return out

    return route


def crept(history: Sequence[float]) -> list[float]:
    """0.7 q and 0.6 times every jump of q that is left after a third of a step's exponential each."""
    jumps = np.diff([0.0, *history])
    return [
        0.7 * q + 0.6 * sum(jumps[j] * exp(-(n - j + 1) / 3.0) for j in range(n + 1))
        for n, q in enumerate(history)
    ]


def damaged(history: Sequence[float]) -> list[float]:
    """Of the largest |q| so far."""
    peaks = [max(abs(p) for p in history[: n + 1]) for n in range(len(history))]
    return [
        1.2 * q * (1.0 - 0.5 * (1.0 - exp(-max(peak - 0.3, 0.0) / 0.4)))
        for q, peak in zip(history, peaks, strict=True)
    ]


def wedged(history: Sequence[float]) -> list[float]:
    """1 q beside a spring of 5 that slides at 0.6 q, at most at 0.3, and at nothing below zero."""
    place, out = 0.0, []
    for q in history:
        most = min(max(0.6 * q, 0.0), 0.3)
        if 5.0 * (q - place) > most:
            place = q - most / 5.0
        elif 5.0 * (q - place) < -most:
            place = q + most / 5.0
        out.append(q + 5.0 * (q - place))
    return out


def masing(history: Sequence[float]) -> list[float]:
    """The curve q = 0.3 (f + 0.5 f³) to the first turn, then the curve twice as large back from it."""
    turn = int(np.argmax(np.abs(history)))
    first = [_by_load(lambda f: 0.3 * (f + 0.5 * f**3), q) for q in history[: turn + 1]]
    back = [
        first[-1] - 2.0 * _by_load(lambda f: 0.3 * (f + 0.5 * f**3), (history[turn] - q) / 2.0)
        for q in history[turn + 1 :]
    ]
    return first + back


def _by_load(place: Callable[[float], float], q: float) -> float:
    return float(brentq(lambda f: place(f) - q, -200.0, 200.0, xtol=1e-14))


def _stairs(q: float) -> float:
    steps = ((-0.65, 0.30), (-0.2, 0.15), (0.3, 0.25), (0.8, 0.30))
    return 0.2 * q + 0.4 * sum(h * (tanh((q - x) / 0.1) - tanh(-x / 0.1)) for x, h in steps)


def _logistic(q: float) -> float:
    return (
        0.8 * (1 / (1 + exp(-(q - 0.2) / 0.1)) - 1 / (1 + exp(2.0)))
        + 0.1 * q
        + 0.3 * ((q - 0.2) ** 3 + 0.008)
    )


EXAMPLES: dict[str, tuple[Law, Route]] = {
    "Linear": (smooth.Linear(1.3), elastic(lambda q: 1.3 * q)),
    "PreloadedLinear": (smooth.PreloadedLinear(0.2, 1.1), elastic(lambda q: 0.2 + 1.1 * q)),
    "Cubic": (smooth.Cubic(0.9), elastic(lambda q: 0.9 * q * q * q)),
    "LinearAndCubic": (smooth.LinearAndCubic(0.5, 0.8), elastic(lambda q: 0.5 * q + 0.8 * q**3)),
    "OddPolynomial": (smooth.OddPolynomial(1.0, -0.4, 0.3), elastic(lambda q: q - 0.4 * q**3 + 0.3 * q**5)),
    "Progressive": (smooth.Progressive(2.0, 0.7), elastic(lambda q: 0.5 * q + 0.7 * q**3)),
    "EvenPart": (
        smooth.EvenPart(1.0, 0.6),
        # Its slope is 0.05 at q = -0.95 / 1.2.
        elastic(lambda q: q + 0.6 * q * q if q > -0.95 / 1.2 else 0.05 * q - 0.6 * (0.95 / 1.2) ** 2),
    ),
    "Tanh": (smooth.Tanh(0.8, 0.3), elastic(lambda q: 0.8 * tanh(q / 0.3))),
    "Atan": (smooth.Atan(0.8, 0.3), elastic(lambda q: 1.6 / pi * atan(q / 0.3))),
    "Exponential": (smooth.Exponential(0.1, 0.5), elastic(lambda q: copysign(0.1 * expm1(abs(q) / 0.5), q))),
    "Power": (smooth.Power(1.0, 1.6, 1e-3), elastic(lambda q: copysign(abs(q) ** 1.6, q))),
    "Periodic": (
        smooth.Periodic(1.0, 0.1, 0.7, 0.4),
        elastic(lambda q: q + 0.1 * (sin(2 * pi * q / 0.7 + 0.4) - sin(0.4))),
    ),
    "DeadZone": (
        kinked.DeadZone(0.3, 1.5, 0.05),
        elastic(lambda q: 0.05 * q + copysign(1.5 * max(abs(q) - 0.3, 0.0), q)),
    ),
    "TwoSlopes": (kinked.TwoSlopes(1.5, 0.4), elastic(lambda q: (1.5 if q > 0.0 else 0.4) * q)),
    "TwoDeadZones": (
        kinked.TwoDeadZones(0.2, 1.5, 0.5, 0.9, 0.1),
        elastic(lambda q: 0.1 * q + 1.5 * max(q - 0.2, 0.0) - 0.9 * max(-q - 0.5, 0.0)),
    ),
    "Coulomb": (sliders.Coulomb(0.6, 0.2), stops((0.6, 0.2))),
    "CoulombTwoLevels": (
        sliders.CoulombTwoLevels((0.5, 0.3), (0.1, 0.6)),
        stops((0.5, 0.1), (0.3, 0.6)),
    ),
    "Iwan": (sliders.Iwan(0.7, 0.9), stops(*((0.7 * n / 21, 0.9 * n / 6) for n in range(1, 7)))),
    "LinearAndCoulomb": (sliders.LinearAndCoulomb(0.8, 0.4, 0.1), stops((0.4, 0.1), spring=0.8)),
    "RambergOsgood": (sliders.RambergOsgood(1.0, 0.3, 0.5, 3.0, 2.5), masing),
    "Dahl": (
        hysteresis.Dahl(0.5, 0.4, 0.2),
        integrated(lambda z, sign: (sign - z) / 0.2, 0.5, 0.4),
    ),
    "BoucWen": (
        hysteresis.BoucWen(0.5, 0.6, 0.3),
        integrated(
            lambda z, sign: sign * (1 - 0.5 * z * z - 0.5 * copysign(z * z, z * sign)) / 0.3, 0.5, 0.6
        ),
    ),
    "OneSidedHysteresis": (hysteresis.OneSidedHysteresis(1.0, 0.3, 0.6, 5.0), wedged),
    "Creep": (hysteresis.Creep(0.7, 0.6, 3.0), crept),
    "Damage": (hysteresis.Damage(1.2, 0.5, 0.3, 0.4), damaged),
    "Staircase": (uneven.Staircase(0.2, 0.8, 1.0, 0.1), elastic(_stairs)),
    "Jump": (
        uneven.Jump(0.8, 0.3, 0.4, 0.04),
        elastic(lambda q: 0.8 * q + 0.15 * (tanh((q - 0.4) / 0.01) + tanh(40.0))),
    ),
    "Detent": (
        uneven.Detent(1.0, 0.2, 0.4, 0.25),
        elastic(lambda q: q + 0.2 * (exp(-(((q - 0.4) / 0.25) ** 2)) - exp(-2.56))),
    ),
    "LogisticAndCubic": (uneven.LogisticAndCubic(0.8, 0.2, 0.1, 0.1, 0.3), elastic(_logistic)),
    "OverLoad": (
        wrapped.OverLoad(smooth.Power(0.5, 1.7, 1e-3), 20.0),
        elastic(lambda q: _by_load(lambda f: f / 20.0 + copysign(0.5 * abs(f) ** 1.7, f), q)),
    ),
}
"""By the name of the class; forces and coordinates of the order one."""
WITHIN = {"Power": 1e-5, "OverLoad": 1e-5, "RambergOsgood": 0.02, "Dahl": 1e-6, "BoucWen": 1e-6}
"""Relative to one: rounding at zero of powers, a polygon for a curve, the midpoint rule; elsewhere 1e-8."""
CONSERVATIVE = [name for name, (law, _) in EXAMPLES.items() if isinstance(law, Elastic)]
