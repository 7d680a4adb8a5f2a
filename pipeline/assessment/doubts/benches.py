"""A bench of a number, what is hidden on it, and the one thing that it has besides."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np
from numpy.typing import NDArray

from pipeline.assessment.challenge.benches import FAIR, RICH, Bench, drawn_noise, drawn_plan, drawn_rig
from pipeline.assessment.challenge.cases import STEPS, drawn
from pipeline.assessment.challenge.dirty.cases import DirtyCase
from pipeline.assessment.challenge.dirty.dirt import BAD_SIZES, Dirt, Knock, read_dirty
from pipeline.assessment.challenge.outcome import borne
from pipeline.assessment.virtual.plan import GAUGES
from pipeline.campaign import Campaign, Data, ParallelogramRig
from pipeline.simulate import scaled

Array = NDArray[np.float64]
SEED = 20_261_130
KNOCKED = 6
"""Readings that are knocked on a bench."""


@dataclass(frozen=True)
class Drawn:
    """What a kind of doubt makes of a bench. true: the rig as it is, of which `Case.bench.rig` is what is written.
    hidden: names of effects that may be hidden, one of them is; none for nothing. knocked: how many readings are."""

    written: ParallelogramRig
    true: ParallelogramRig
    dirt: Dirt
    hidden: Sequence[str] = ()
    knocked: int = 0


@dataclass(frozen=True, eq=False)
class DoubtCase(DirtyCase):
    """A bench; true: its rig as it is. knocked: readings that are off, in the tests that are fitted."""

    true: ParallelogramRig
    knocked: int


def rig_of(number: int) -> ParallelogramRig:
    """The rig of a bench as it is drawn: the same for every kind of doubt."""
    return drawn_rig(_generator(number))


def doubt_case(number: int, of: Drawn, share: float = 1.0) -> DoubtCase:
    """The bench of a number with what was drawn for it; share: of the loads."""
    generator = _generator(number)
    drawn_rig(generator)
    noise, steps = drawn_noise(generator), int(generator.choice(STEPS))
    label, seed = str(generator.choice((RICH, FAIR))), int(generator.integers(2**62))
    plan = scaled(drawn_plan(generator, label, steps), of.written, share)
    hidden = drawn(str(generator.choice(list(of.hidden))), generator) if of.hidden else {}
    bench, kind = Bench(of.written, noise, plan, label), "single" if hidden else "clean"
    return DoubtCase(number, kind, bench, hidden, None, seed, of.dirt, of.true, of.knocked)


def table(number: int, of: Drawn, name: str) -> tuple[DoubtCase, Campaign, tuple[Knock, ...]]:
    """The bench, the campaign that is written of it, and the readings that were knocked. RuntimeError where it bears
    no loads."""
    it, found, _ = borne(partial(doubt_case, number, of), lambda case: case.true)
    campaign, _ = read_dirty(name, it.bench, it.dirt, found, it.seed)
    knocks = tuple(_knocks(it, campaign))
    return it, knocked(campaign, it, knocks), knocks


def knocked(campaign: Campaign, it: DoubtCase, knocks: Sequence[Knock]) -> Campaign:
    """The campaign with these readings off."""
    noise = it.bench.noise
    sigma = np.concatenate([noise.displacement, noise.wrench, noise.gauges[: len(GAUGES)]])
    tests = []
    for number, test in enumerate(campaign.tests):
        read = test.data.readings.copy()
        for each in knocks:
            if each.test == number:
                read[each.row, each.channel] += each.sigmas * sigma[each.channel]
        tests.append(replace(test, data=_with(test.data, read)))
    return replace(campaign, tests=tuple(tests))


def _knocks(it: DoubtCase, campaign: Campaign) -> list[Knock]:
    """So many readings of different rows, among the fitted tests."""
    generator = np.random.default_rng([SEED, it.number, 1])
    rows = [
        (k, row)
        for k, test in enumerate(campaign.tests)
        if test.role == "fit"
        for row in range(test.data.steps.size)
    ]
    places = generator.choice(len(rows), it.knocked, replace=False)
    found = []
    for k in places.tolist():
        size = generator.uniform(*BAD_SIZES) * generator.choice((-1.0, 1.0))
        test, row = rows[k]
        found.append(Knock(test, row, int(generator.integers(12 + len(GAUGES))), float(size)))
    return found


def _with(data: Data, read: Array) -> Data:
    return replace(data, displacement=read[:, :6], wrench=read[:, 6:12], gauges=read[:, 12:])


def _generator(number: int) -> np.random.Generator:
    return np.random.default_rng([SEED, number, 0])
