"""What a careful bench would measure on a parallelogram: tests in all directions at three angles, some held out."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pipeline.campaign.model import Noise

Array = NDArray[np.float64]
STEPS = 24
ANGLES = (0.0, 30.0, -30.0)
AXIAL_N = 4000.0
SENSORS = Noise(
    displacement=np.array([1e-3, 1e-3, 1e-3, 2e-5, 2e-5, 2e-5]),
    wrench=np.array([1.0, 0.5, 0.5, 50.0, 50.0, 50.0]),
    gauges=np.zeros(0),
    temperature=0.1,
)
"""Sensors of a good bench: 1 µm, 20 µrad, 1 N along x and 0.5 N across, 50 N·mm, 0.1 K."""

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
    """Six tests at each angle and one at another angle; the last of each direction's three is not held out."""
    tests = []
    for angle in ANGLES:
        for name, (control, shape) in _TESTS.items():
            tests.append(_planned(f"{name}_q{angle:+.0f}", angle, control, shape(steps)))
    for name, angle in (("axial_held", 15.0), ("lateral", -15.0)):
        control, shape = _TESTS[name]
        tests.append(_planned(f"{name}_q{angle:+.0f}", angle, control, 0.9 * shape(steps), holdout=True))
    return tuple(tests)


def _planned(
    name: str, angle: float, control: tuple[str, ...], values: Array, holdout: bool = False
) -> PlannedTest:
    # The hall warms up by 2 K during a test and differs from test to test.
    start = 20.0 + 3.0 * np.sin(1.7 * len(name) + angle)
    return PlannedTest(name, angle, control, values, start + np.linspace(0.0, 2.0, len(values)), holdout)


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


def _pushed(turns: tuple[float, ...], axial: float) -> Callable[[int], Array]:
    def values(steps: int) -> Array:
        out = _along(1, *turns)(steps)
        out[:, 0] = axial * np.minimum(1.0, np.arange(steps) / 4.0)
        return out

    return values


_TESTS: dict[str, tuple[tuple[str, ...], Callable[[int], Array]]] = {
    "axial_held": ((_F, _D, _D, _D, _D, _D), _along(0, AXIAL_N, -AXIAL_N, 0.0)),
    "axial_guided": ((_F, _F, _D, _D, _D, _D), _along(0, AXIAL_N, -AXIAL_N, 0.0)),
    "lateral": ((_F, _D, _D, _D, _D, _D), _along(1, 6.0, -6.0, 0.0)),
    "lateral_pushed": ((_F, _D, _D, _F, _F, _F), _pushed((5.0, -5.0), -0.3 * AXIAL_N)),
    "swing": ((_F, _F, _D, _D, _D, _D), _along(2, 15.0, -15.0, 0.0)),
    "turns": ((_F, _D, _D, _D, _F, _D), _along(5, 0.04, -0.04, 0.0)),
}
