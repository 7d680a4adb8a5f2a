"""The bench of a number with an effect that shows by so many sigmas, the bar up to 2 % beside its drawing."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from fem.frame.bench import Readings
from pipeline.assessment.challenge.benches import FAIR, RICH, Bench, drawn_noise, drawn_plan, drawn_rig
from pipeline.assessment.challenge.cases import STEPS
from pipeline.assessment.challenge.dirty.dirt import Dirt, read_dirty, true_rig
from pipeline.assessment.challenge.laws.cases import bar_off
from pipeline.assessment.challenge.laws.measured import SEEN
from pipeline.assessment.challenge.laws.size import WITHIN, OutOfSight, Scale, scale_of
from pipeline.assessment.challenge.outcome import SHARES
from pipeline.assessment.coverage.cases import is_size
from pipeline.assessment.left_out.entries import ENTRIES, Entry
from pipeline.assessment.virtual.bench import true_readings
from pipeline.assessment.virtual.plan import GAUGES
from pipeline.campaign import Campaign, ParallelogramRig
from pipeline.parameter_names import path_of
from pipeline.simulate import scaled
from vjm.effects import catalogue

Array = NDArray[np.float64]
SEED = 20_261_201
MU = (15.0, 50.0, 200.0)
"""Sigmas by which the effect shows in the fitted tests."""
SMALL, LARGE, HALVINGS = 1e-4, 1e3, 16
"""Sizes between which the effect is brought to its mu, in typical ones; halvings of the logarithm of their ratio at
most: it is known to 3e-4 then."""


@dataclass(frozen=True, eq=False)
class LeftOut:
    """name: of the entry. hidden: "effect.parameter" to value. shown: (N,) what it does to the fitted readings, in
    sigmas. seen: ids of the tests held out that see it."""

    number: int
    name: str
    hidden: Mapping[str, float]
    shown: Array
    seen: tuple[str, ...]

    @property
    def mu(self) -> float:
        """Sigmas by which it shows in the fitted tests."""
        return float(np.linalg.norm(self.shown))

    @property
    def entry(self) -> Entry:
        """What is hidden."""
        return ENTRIES[self.name]


def measured(number: int) -> tuple[LeftOut, Campaign]:
    """The case of a number and the campaign that is written of it. RuntimeError where the bench does not bear it, or
    where no size shows by as much."""
    for share in SHARES:
        try:
            return _measured(number, share)
        except OutOfSight:
            raise
        except RuntimeError as error:
            last = error
    raise RuntimeError(f"bench {number} at {SHARES[-1]:g} of its loads: {last}")


def _measured(number: int, share: float) -> tuple[LeftOut, Campaign]:
    name = list(ENTRIES)[number % len(ENTRIES)]
    mu = MU[number // len(ENTRIES) % len(MU)]
    generator = np.random.default_rng([SEED, number])
    rig, noise, steps = drawn_rig(generator), drawn_noise(generator), int(generator.choice(STEPS))
    label, seed = str(generator.choice((RICH, FAIR))), int(generator.integers(2**62))
    plan = scaled(drawn_plan(generator, label, steps), rig, share)
    dirt = Dirt.of_bar(bar_off(generator))
    bench, true = Bench(rig, noise, plan, label), true_rig(rig, dirt.bar)
    way = _way(ENTRIES[name], generator)
    fitted = replace(bench, plan=tuple(test for test in plan if not test.holdout))
    hidden, shown = sized(way, mu, scale_of(fitted, true), true)
    found = true_readings(true, plan, hidden, GAUGES)
    campaign, _ = read_dirty(f"left out {number}", bench, dirt, found, seed)
    return LeftOut(number, name, hidden, shown, tuple(_seen(bench, true, hidden))), campaign


@dataclass(frozen=True)
class Way:
    """The numbers of an effect by their paths: null, and what a size of one moves each by, within low and high."""

    null: Mapping[str, float]
    move: Mapping[str, float]
    low: Mapping[str, float]
    high: Mapping[str, float]

    def at(self, size: float) -> dict[str, float]:
        """The numbers at a size, within their bounds."""
        return {
            path: float(np.clip(null + size * self.move.get(path, 0.0), self.low[path], self.high[path]))
            for path, null in self.null.items()
        }


def _way(entry: Entry, generator: np.random.Generator) -> Way:
    """Every number that makes the effect present moves by a share of its typical size, of either sign where both mean
    something."""
    move = {}
    for p in catalogue()[entry.effect].parameters:
        if is_size(entry.effect, p.name) and (not entry.parameters or p.name in entry.parameters):
            sign = 1.0 if p.one_sided else float(generator.choice((-1.0, 1.0)))
            move[path_of(entry.effect, p.name)] = sign * float(generator.uniform(0.3, 1.0)) * p.typical
    every = {path_of(entry.effect, p.name): p for p in catalogue()[entry.effect].parameters}
    return Way(
        {path: p.null for path, p in every.items()},
        move,
        {path: p.null + 0.99 * (p.low - p.null) for path, p in every.items()},
        {path: p.null + 0.99 * (p.high - p.null) for path, p in every.items()},
    )


def sized(way: Way, mu: float, scale: Scale, true: ParallelogramRig) -> tuple[dict[str, float], Array]:
    """The numbers at the size where the effect shows by mu sigmas, and (N,) what it does to the fitted readings, in
    sigmas. It grows with the size: by halving, in the logarithm. OutOfSight where no size shows by as much."""
    low, high = float(np.log(SMALL)), float(np.log(LARGE))
    for _ in range(HALVINGS):
        size = 0.5 * (low + high)
        hidden = way.at(float(np.exp(size)))
        shown = _shown(hidden, scale, true)
        sigmas = np.inf if shown is None else float(np.linalg.norm(shown))
        if shown is not None and abs(sigmas / mu - 1.0) < WITHIN:
            return hidden, shown
        if sigmas > mu:
            high = size
        else:
            low = size
    raise OutOfSight(f"no size of {', '.join(way.move)} shows by {mu:.3g} sigmas")


def _shown(hidden: Mapping[str, float], scale: Scale, true: ParallelogramRig) -> Array | None:
    """What it does to the tests of a scale; None where the bench does not bear it."""
    try:
        found = true_readings(true, scale.bench.plan, hidden, GAUGES)
    except RuntimeError:
        return None
    return scale.signature(found)


def _seen(bench: Bench, true: ParallelogramRig, hidden: Mapping[str, float]) -> Sequence[str]:
    """Ids of the tests held out in which the effect shows."""
    held = tuple(replace(test, holdout=False) for test in bench.plan if test.holdout)
    if not held:
        return ()
    scale = scale_of(replace(bench, plan=held), true)
    found: list[Readings] = true_readings(true, held, hidden, GAUGES)
    signature = scale.signature(found)
    sizes = [float(np.linalg.norm(signature[scale.tests == k])) for k in range(len(held))]
    return [test.id for test, size in zip(held, sizes, strict=True) if size >= SEEN]
