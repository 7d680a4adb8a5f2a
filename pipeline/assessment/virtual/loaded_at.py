"""Benches by finite elements whose bars may be loaded before their tips: there the frame ends."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from fem.frame import bench
from fem.frame.errors import Errors
from fem.frame.linkages import ELEMENTS
from fem.frame.placed import Placed
from fem.frame.rig import Gauge as FrameGauge
from pipeline.campaign import Gauge, RigOfBars
from pipeline.campaign.names import DISPLACEMENT

TIP = ("tip of the bar, x", "tip of the bar, y", "tip of the bar, z")
"""Names of the dials that read the tip of a bar from where it is loaded."""


def run(
    rigs: Sequence[RigOfBars],
    trials: Sequence[bench.Trial],
    gauges: Sequence[Gauge],
    errors: Errors,
    elements: int = ELEMENTS,
    placed: Sequence[Placed] = (),
) -> list[bench.Readings]:
    """Readings of every trial in its own rig, see `fem.frame.bench.run`; displacements are those of the tips.

    rigs: as many as trials. ValueError for what the frame refuses.
    """
    found: dict[int, bench.Readings] = {}
    views = [_sights(rig, gauges) for rig in rigs]
    for sights in dict.fromkeys(views):
        numbers = [k for k, view in enumerate(views) if view == sights]
        beyond = sights[len(gauges) :] != ()
        them = [_at_tip(trials[k]) if beyond else trials[k] for k in numbers]
        first = them[0].rig
        assert first is not None
        readings = bench.run(first, errors, them, sights, elements, placed)
        found |= zip(numbers, map(_of_tip, readings) if beyond else readings, strict=True)
    return [found[k] for k in range(len(trials))]


def _sights(rig: RigOfBars, gauges: Sequence[Gauge]) -> tuple[FrameGauge, ...]:
    """The gauges as the frame has them, and those of the tip where the bar goes on beyond its load."""
    places = [(gauge.name, rig.seen(gauge)) for gauge in gauges]
    out = [FrameGauge(name, at.bar, at.station, at.direction, at.offset) for name, at in places]
    if rig.overhang:
        arm = (rig.overhang, 0.0, 0.0)
        axes = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
        out += [FrameGauge(name, 1, 1.0, axis, arm) for name, axis in zip(TIP, axes, strict=True)]
    return tuple(out)


def _at_tip(trial: bench.Trial) -> bench.Trial:
    """What is prescribed of the platform point is that of the tip."""
    control = tuple(
        TIP[k] if k < len(TIP) and by == DISPLACEMENT else by for k, by in enumerate(trial.control)
    )
    return replace(trial, control=control)


def _of_tip(readings: bench.Readings) -> bench.Readings:
    seen = len(TIP)
    moved = np.hstack([readings.gauges[:, -seen:], readings.displacement[:, seen:]])
    return replace(readings, displacement=moved, gauges=readings.gauges[:, :-seen])
