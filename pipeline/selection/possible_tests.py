"""Tests that could be done next on a rig: directions, what is held, angles, as far as the bench has gone."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pipeline.campaign import Campaign, Data, Rig, Test
from pipeline.campaign.names import DISPLACEMENT, FORCE
from pipeline.campaign.usual_tests import MODEST, MODEST_LOAD, STEPS, WARMER_K, UsualTest
from pipeline.inference.settings import LOOK

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Choice:
    """A test that could be done: readings are zero where they are to come. limit: largest prescribed value."""

    shape: UsualTest
    test: Test
    limit: float
    warmer: bool = False


def menu(campaign: Campaign) -> list[Choice]:
    """Every shape at the campaign's angles and at 0, 15, 30 and -30 degrees, as far as it went; some also warmer.

    None for a rig whose tests are no choice from a list, as the postures of a manipulator.
    """
    there = sensors(campaign)
    heat = any(t.data.temperature is not None for t in campaign.tests)
    out: list[Choice] = []
    for angle in _angles(campaign):
        for shape in campaign.rig.usual_tests(campaign.tests[0].control) or ():
            if there[shape.coordinate + (6 if shape.control[shape.coordinate] == FORCE else 0)]:
                out.append(_choice(campaign, shape, angle, len(out), 0.0))
    if heat:
        out += [
            _choice(campaign, c.shape, c.test.q_deg, len(out) + k, WARMER_K) for k, c in enumerate(out[:2])
        ]
    return out


def sensors(campaign: Campaign) -> NDArray[np.bool_]:
    """(12 + gauges,) channels that some test of the campaign reads."""
    read = [np.hstack([t.data.displacement, t.data.wrench, t.data.gauges]) for t in campaign.tests]
    return np.asarray(np.isfinite(np.concatenate(read)).any(axis=0))


def _angles(campaign: Campaign) -> list[float]:
    mine = {t.q_deg for t in campaign.tests}
    return sorted(mine | set(campaign.rig.usual_angles), key=lambda q: (abs(q), -q))


def _choice(campaign: Campaign, shape: UsualTest, angle: float, number: int, warmer: float) -> Choice:
    rig = campaign.rig
    values = np.zeros((STEPS, 6))
    limit = limits(campaign)[shape.coordinate]
    values[:, shape.coordinate] = limit * _there_and_back(STEPS)
    if shape.push:
        values[:, 0] = shape.push * limits(campaign)[0] * np.minimum(1.0, np.arange(STEPS) / 3.0)
    test = planned(campaign, f"next_{number}", angle, shape.control, values, rig, warmer)
    return Choice(shape, test, float(limit), bool(warmer))


def planned(
    campaign: Campaign,
    name: str,
    angle: float,
    control: tuple[str, ...],
    values: Array,
    rig: Rig,
    warmer: float = 0.0,
) -> Test:
    """A test in which every sensor of the campaign reads, with zeros for what is to come.

    values: (S, 6) of what `control` prescribes, which a clamp may hold without a sensor.
    """
    there = np.where(sensors(campaign), 0.0, np.nan)
    forced = np.array([by == FORCE for by in control])
    steps = len(values)
    heat = None
    if any(t.data.temperature is not None for t in campaign.tests):
        heat = np.full(
            steps, (0.0 if rig.reference_temperature is None else rig.reference_temperature) + warmer
        )
    data = Data(
        np.arange(steps),
        np.where(forced, there[:6], values),
        np.where(forced, values, there[6:12]),
        np.tile(there[12:], (steps, 1)),
        heat,
        np.zeros(steps, dtype=np.int64),
    )
    return Test(name, angle, "fit", control, "nominal", rig, data)


def limits(campaign: Campaign) -> Array:
    """(6,) largest force along x and travel along the others that the campaign has done; modest where it has none."""
    rig = campaign.rig
    out = np.array(MODEST) * np.array([0.0, rig.length, rig.length, 1.0, 1.0, 1.0])
    out[0] = MODEST_LOAD * rig.euler_load
    sigma = np.append(campaign.noise.wrench[:1], campaign.noise.displacement[1:])
    for k in range(6):
        done = max((_largest(t, k) for t in campaign.tests), default=0.0)
        out[k] = done if done > LOOK.moves * np.nan_to_num(sigma[k]) else out[k]
    return out


def _largest(test: Test, coordinate: int) -> float:
    """Largest prescribed force along x, or travel along another coordinate."""
    if test.control[coordinate] != (FORCE if coordinate == 0 else DISPLACEMENT):
        return 0.0
    readings = test.data.wrench[:, 0] if coordinate == 0 else test.data.displacement[:, coordinate]
    return float(np.nanmax(np.abs(readings), initial=0.0))


def _there_and_back(steps: int) -> Array:
    """(steps,) from zero to 1, -1 and back to zero."""
    return np.interp(np.linspace(0.0, 4.0, steps), [0.0, 1.0, 3.0, 4.0], [0.0, 1.0, -1.0, 0.0])
