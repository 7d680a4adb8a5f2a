"""The sigmas that a campaign does not say, estimated from its own readings."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from pipeline.campaign import Campaign, Gauge, Test
from pipeline.campaign.control import control_channels
from pipeline.campaign.names import DISPLACEMENTS, TEMPERATURE, WRENCHES, gauge_column
from pipeline.campaign.reading import DESCRIPTION
from pipeline.inference.driving import driving
from pipeline.inference.rounding import EQUAL, ROUNDING
from pipeline.inference.sensor_noise import SigmaEstimate, from_lines, from_repeats, from_roughness
from pipeline.inference.settings import CHOSEN_STEPS, ROUGHNESS

Array = NDArray[np.float64]
Readings = Callable[[Test], Array]
HEAT = -1
"""Stands for the thermometer among the channels."""


def completed(campaign: Campaign) -> Campaign:
    """The campaign with a sigma for everything that it measures and of which one is given or can be told; each estimate
    is said in a remark, and what has none, with the line to write.

    From steps done twice in a row where there are enough of them, else from what no smooth curve explains. Of the
    curves over the step number and over the load the one with the least roughness counts: noise of the load and
    the shape of the curve only add to an estimate. Readings too coarse to show noise have that of their rounding.
    What is only ever prescribed counts as exact where its readings are steps that somebody chose, or too few to tell.
    """
    noise = campaign.noise
    sigmas = np.concatenate([noise.displacement, noise.wrench, noise.gauges, [noise.temperature]])
    names = [*DISPLACEMENTS, *WRENCHES, *(gauge_column(g.name) for g in campaign.gauges), TEMPERATURE]
    remarks: list[str] = []
    for k, name in enumerate(names):
        channel = HEAT if name == TEMPERATURE else k
        if np.isfinite(sigmas[k]) or not any(_measured(t, channel).any() for t in campaign.tests):
            continue
        try:
            sigmas[k], how = _sigma(campaign, channel)
            remarks.append(f"{name}: sigma {sigmas[k]:.3g} {how}")
        except ValueError as error:
            remarks.append(f"{name}: no sigma is given and none can be told: {error}; {to_write(name)}")
    last = 12 + len(campaign.gauges)
    known = replace(noise.of(sigmas[:last]), temperature=float(sigmas[last]))
    return replace(campaign, noise=known, remarks=(*campaign.remarks, *remarks))


def to_write(column: str) -> str:
    """The line that gives a sigma."""
    unit = "K" if column == TEMPERATURE else column.rpartition("_")[2]
    return f"write under [noise] in {DESCRIPTION}: {column} = ...  (one standard deviation, {unit})"


def _sigma(campaign: Campaign, channel: int) -> tuple[float, str]:
    """Estimate and how it was found. ValueError, with the reason, where there is none."""
    given = channel == HEAT or _prescribed(campaign, channel)
    if given and _chosen(list(map(_known, _columns(campaign, channel)))):
        return 0.0, ": it is prescribed in steps that were chosen, so it counts as exact"
    repeats = _from_repeats(campaign, channel)
    if repeats.value and repeats.differences >= ROUGHNESS.fewest:
        return repeats.value, f"± {repeats.std:.1g}, from {repeats.differences} repeated steps"
    rough = [from_roughness(_paths_over(campaign, channel, over)) for over in (_step, _load)]
    lines = from_lines(_paths_over(campaign, channel, _load))
    largest = max(float(np.abs(known).max(initial=0.0)) for known in map(_known, _columns(campaign, channel)))
    # Differences of equal readings are zero but for rounding.
    real = [each for each in rough if each.value is not None and each.value > ROUNDING * largest]
    rounded = not real and rough[0].differences >= ROUGHNESS.fewest
    found = real if rounded or lines.value is None else [*real, lines]
    if found:
        best = min(found, key=lambda each: each.value or 0.0)
        how = "scatter about straight lines over the load" if best is lines else "roughness"
        number = "degrees of freedom" if best is lines else "differences"
        return float(best.value or 0.0), f"± {best.std:.1g}, from the {how}, {best.differences} {number}"
    steps = np.concatenate([_steps_of(readings) for readings in _columns(campaign, channel)])
    # So many differences without any noise in them: the readings are rounded.
    if steps.size and rough[0].differences >= ROUGHNESS.fewest:
        return float(steps.min() / np.sqrt(12.0)), f"of readings rounded to {steps.min():.3g}"
    if given:
        return 0.0, ": it is prescribed and its readings do not tell its noise, so it counts as exact"
    raise ValueError(rough[0].reason)


def _prescribed(campaign: Campaign, channel: int) -> bool:
    """Whether a channel controls its coordinate in every test that measures it."""
    return all(
        channel in control_channels(test, campaign.gauges)
        for test in campaign.tests
        if _measured(test, channel).any()
    )


def _chosen(columns: Sequence[Array]) -> bool:
    """Whether readings (n,) of each test are steps that somebody chose: whole multiples of the smallest, not many of
    them, and gone through in few turns.

    What a display rounds lies on multiples too, of a step that is far smaller than those of the load, and noise turns
    at two of three readings.
    """
    values = np.unique(np.concatenate(columns))
    steps = _steps_of(values)
    if not steps.size:
        return True
    counts = (values - values[0]) / steps.min()
    few = counts[-1] <= CHOSEN_STEPS.cells * values.size
    even = bool(few and np.all(np.abs(counts - np.round(counts)) < CHOSEN_STEPS.even))
    ways = [np.sign(np.diff(column)) for column in columns]
    turns = sum(int(np.sum(way[1:] * way[:-1] < 0.0)) for way in ways)
    return even and turns <= CHOSEN_STEPS.turns * sum(way.size for way in ways)


def _from_repeats(campaign: Campaign, channel: int) -> SigmaEstimate:
    """From runs of steps at exactly the same prescribed values."""
    readings, groups, last = [], [], 0
    for test in campaign.tests:
        if channel != HEAT and channel in control_channels(test, campaign.gauges):
            continue
        inputs, there = test.inputs(campaign.gauges), _measured(test, channel)
        run = last + np.concatenate([[0], np.cumsum(np.any(np.diff(inputs, axis=0) != 0.0, axis=1))])
        last = int(run[-1]) + 1
        readings.append(_column(test, channel)[there])
        groups.append(run[there].astype(np.int64))
    if not readings:
        return SigmaEstimate(None, None, 0, "no step was repeated")
    return from_repeats(np.concatenate(readings), np.concatenate(groups))


def _paths_over(
    campaign: Campaign, channel: int, over: Callable[[Test, tuple[Gauge, ...], int], Array]
) -> list[tuple[Array, Array]]:
    """Loads and readings (n,) of each test."""
    paths = []
    for test in campaign.tests:
        load, readings = over(test, campaign.gauges, channel), _column(test, channel)
        there = np.isfinite(load) & np.isfinite(readings)
        paths.append((load[there], readings[there]))
    return paths


def _step(test: Test, gauges: tuple[Gauge, ...], channel: int) -> Array:
    return test.data.steps.astype(float)


def _load(test: Test, gauges: tuple[Gauge, ...], channel: int) -> Array:
    """What drives the test; where that is the channel itself, what answers it along the same coordinate."""
    drive, values = driving(test, gauges)
    if drive != channel:
        return values
    if channel >= 12:
        return test.data.wrench[:, control_channels(test, gauges).index(channel)]
    return _column(test, channel + 6 if channel < 6 else channel - 6)


def _column(test: Test, channel: int) -> Array:
    if channel == HEAT:
        heat = test.data.temperature
        return np.full(test.data.steps.size, np.nan) if heat is None else heat
    return np.hstack([test.data.displacement, test.data.wrench, test.data.gauges])[:, channel]


def _columns(campaign: Campaign, channel: int) -> list[Array]:
    return [_column(test, channel) for test in campaign.tests]


def _known(readings: Array) -> Array:
    return readings[np.isfinite(readings)]


def _measured(test: Test, channel: int) -> NDArray[np.bool_]:
    return np.isfinite(_column(test, channel))


def _steps_of(readings: Array) -> Array:
    """Differences between the values that occur, beyond those of arithmetic."""
    known = _known(readings)
    steps = np.diff(np.unique(known))
    return np.asarray(steps[steps > EQUAL * np.abs(known).max(initial=0.0)])
