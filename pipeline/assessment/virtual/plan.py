"""What a careful bench would measure on a parallelogram: tests in all directions at three angles, some held out."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pipeline.campaign.model import Gauge, Noise

Array = NDArray[np.float64]
STEPS = 24
AXIAL_N = 4000.0
SENSORS = Noise(
    displacement=np.array([1e-3, 1e-3, 1e-3, 2e-5, 2e-5, 2e-5]),
    wrench=np.array([1.0, 0.5, 0.5, 50.0, 50.0, 50.0]),
    gauges=np.array([1e-3]),
    temperature=0.1,
)
"""Sensors of a good bench: 1 µm, 20 µrad, 1 N along x and 0.5 N across, 50 N·mm, 0.1 K."""
GAUGES = (Gauge("mid", 0.5, "y", 1),)
"""A gauge across the middle of bar 1: it sees the bar bend where the platform does not move."""

_D, _F = "displacement", "force"


@dataclass(frozen=True, eq=False)
class PlannedTest:
    """One load history: values (steps, 6) of what `control` prescribes; temperature (steps,) in °C."""

    id: str
    q_deg: float
    control: tuple[str, ...]
    values: Array
    temperature: Array
    holdout: bool = False


def bench_plan(steps: int = STEPS) -> tuple[PlannedTest, ...]:
    """Tests at the angles 0, 30 and -30 degrees and two between them that are held out.

    Every history passes zero in both directions: friction shows as a loop, play as a jump, a difference between
    tension and compression as a kink. The platform is turned about each axis, and moved sideways without axial
    load, in compression and in tension, held and free to turn. What tells most about the angle (along the bars,
    sideways in compression, the swing of the bars) is done at all three, the rest at one or two.
    """
    names = [(name, angle) for angle, at in _ANGLES.items() for name in at]
    names += [("axial_held", 15.0), ("lateral", -15.0)]
    tests = []
    for number, (name, angle) in enumerate(names):
        control, shape = _TESTS[name]
        held_out = angle not in _ANGLES
        values = (0.9 if held_out else 1.0) * shape(steps)
        heat = hall_temperature(number, steps)
        tests.append(PlannedTest(f"{name}_q{angle:+.0f}", angle, control, values, heat, held_out))
    return tuple(tests)


def hall_temperature(number: int, steps: int) -> Array:
    """(steps,) °C during the test of that number: another level each, and a wave that no load follows.

    Level and phase go through their ranges in steps of irrational length, so that over the tests neither follows
    the load, the angle or the time.
    """
    golden, silver = (np.sqrt(5.0) - 1.0) / 2.0, np.sqrt(2.0) - 1.0
    level = 20.5 + 4.0 * ((number + 1) * golden % 1.0 - 0.5)
    way = np.linspace(0.0, 1.7, steps) + (number + 1) * silver
    return np.asarray(level + 0.8 * np.sin(2.0 * np.pi * way))


def there_and_back(steps: int, turns: tuple[float, ...]) -> Array:
    """(steps,) from zero along straight lines through the turning points, equally spaced on the way."""
    points = np.array([0.0, *turns])
    way = np.concatenate([[0.0], np.cumsum(np.abs(np.diff(points)))])
    return np.interp(np.linspace(0.0, way[-1], steps), way, points)


def _along(coordinate: int, *turns: float) -> Callable[[int], Array]:
    def values(steps: int) -> Array:
        out = np.zeros((steps, 6))
        out[:, coordinate] = there_and_back(steps, turns)
        return out

    return values


def _loaded(turns: tuple[float, ...], axial: float) -> Callable[[int], Array]:
    def values(steps: int) -> Array:
        out = _along(1, *turns)(steps)
        out[:, 0] = axial * np.minimum(1.0, np.arange(steps) / 4.0)
        return out

    return values


_TESTS: dict[str, tuple[tuple[str, ...], Callable[[int], Array]]] = {
    "axial_held": ((_F, _D, _D, _D, _D, _D), _along(0, AXIAL_N, -AXIAL_N, 0.0)),
    "axial_guided": ((_F, _F, _D, _D, _D, _D), _along(0, AXIAL_N, -AXIAL_N, 0.0)),
    "lateral": ((_F, _D, _D, _D, _D, _D), _along(1, 6.0, -6.0, 0.0)),
    "lateral_pushed": ((_F, _D, _D, _F, _F, _F), _loaded((5.0, -5.0, 0.0), -0.3 * AXIAL_N)),
    "lateral_pulled": ((_F, _D, _D, _F, _F, _F), _loaded((5.0, -5.0, 0.0), 0.5 * AXIAL_N)),
    "swing": ((_F, _F, _D, _D, _D, _D), _along(2, 15.0, -15.0, 0.0)),
    "turn_x": ((_F, _D, _D, _D, _F, _F), _along(3, 0.03, -0.03, 0.0)),
    "turn_y": ((_F, _D, _D, _F, _F, _F), _along(4, 1e5, -1e5, 0.0)),
    "turn_z": ((_F, _D, _D, _D, _F, _D), _along(5, 0.04, -0.04, 0.0)),
}
_ANGLES = {
    0.0: ("axial_held", "axial_guided", "lateral", "lateral_pushed", "lateral_pulled", "swing", "turn_z"),
    30.0: ("axial_held", "axial_guided", "lateral", "lateral_pushed", "swing", "turn_x"),
    -30.0: ("axial_held", "lateral_pushed", "swing", "turn_y"),
}
