"""A case with hidden laws, measured: the campaign that a bench writes, and the sealed truth beside it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import asdict, dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fem.frame.bench import Readings
from fem.frame.placed import Placed
from pipeline.campaign import Campaign, ParallelogramRig
from pipeline.challenge.benches import Bench
from pipeline.challenge.dirty.dirt import Knock, read_dirty, true_rig
from pipeline.challenge.laws.cases import Hidden, LawCase, further
from pipeline.challenge.laws.size import OutOfSight, Scale, placed_at, reach_of, scale_of, sized, unit_of
from pipeline.challenge.outcome import SHARES
from pipeline.virtual.bench import true_readings
from pipeline.virtual.plan import GAUGES, PlannedTest

Array = NDArray[np.float64]
AWAY = (15.0, -15.0)
"""Degrees at which the test that sees the site best is done again, held out."""
SEEN = 5.0
"""Sigmas from which a site counts as visible."""


@dataclass(frozen=True, eq=False)
class LawTruth:
    """A law as it was: name of its class, the law placed, sigmas by which it alone shows in the fitted tests, and the
    largest coordinate and force that it met there."""

    name: str
    placed: Placed
    mu: float
    coordinate: float
    force: float

    @property
    def visible(self) -> bool:
        """Whether the fitted tests see its site."""
        return self.mu >= SEEN

    @property
    def words(self) -> dict[str, Any]:
        """For a record: site, class, parameters in its own units, and what these are."""
        return {
            "site": self.placed.site,
            "law": self.name,
            "over_load": type(self.placed.law).__name__ == "OverLoad",
            "parameters": asdict(self.placed.law),  # type: ignore[call-overload]
            "force": self.placed.force,
            "length": self.placed.length,
            "mu": self.mu,
            "visible": self.visible,
            "reached": [self.coordinate, self.force],
        }


@dataclass(frozen=True, eq=False)
class Truth:
    """case: with the plan as it was done. laws: what was hidden. share: of the loads. bar (4,): true over nominal EA,
    EIy, EIz, GJ. held_out: exact readings (S, 13) of each held-out test by its id. held_out_mu: sigmas by which the
    laws show in each. knocks: bad readings."""

    case: LawCase
    laws: tuple[LawTruth, ...]
    share: float
    bar: Array
    held_out: dict[str, Array]
    held_out_mu: dict[str, float]
    knocks: tuple[Knock, ...]


def measured(make: Callable[[int, float], LawCase], number: int) -> tuple[Campaign, Truth]:
    """The campaign of the case of that number and its truth, at the largest share of its loads that the bench bears.

    make: `law_case`, `pair_case` or `clean_case`. RuntimeError where the bench bears none.
    """
    for share in SHARES:
        try:
            return _measured(make(number, share), share)
        except RuntimeError as error:
            last = error
    raise RuntimeError(f"case {number} at {SHARES[-1]:g} of its loads: {last}")


def _measured(it: LawCase, share: float) -> tuple[Campaign, Truth]:
    true = true_rig(it.bench.rig, it.dirt.bar)
    if not it.laws:
        return _written(it, (), share, true_readings(true, it.bench.plan, {}, GAUGES), {})
    fitted = replace(it.bench, plan=tuple(t for t in it.bench.plan if not t.holdout))
    scale = scale_of(fitted, true)
    laws, found = [], scale.without
    for hidden in it.laws:
        law, found = _brought(hidden, scale, true)
        laws.append(law)
    placed = [law.placed for law in laws]
    if len(laws) > 1:
        found = true_readings(true, fitted.plan, {}, GAUGES, placed)
    plan = _held(it, scale, found, share)
    held = replace(it.bench, plan=tuple(replace(t, holdout=False) for t in plan))
    beyond = scale_of(held, true)
    there = true_readings(true, held.plan, {}, GAUGES, placed)
    shown = beyond.signature(there)
    sizes = {t.id: float(np.linalg.norm(shown[beyond.tests == k])) for k, t in enumerate(plan)}
    whole = replace(it, bench=replace(it.bench, plan=(*fitted.plan, *plan)))
    return _written(whole, tuple(laws), share, [*found, *there], sizes)


def _brought(hidden: Hidden, scale: Scale, true: ParallelogramRig) -> tuple[LawTruth, list[Readings]]:
    """A law at the first of its sites where it shows by as much as it should, and exact readings with it alone."""
    last: RuntimeError = OutOfSight("no site")
    for site in hidden.sites:
        try:
            reach = reach_of(site, scale.bench, true)

            def make(size: float, site: str = site, reach: float = reach) -> Placed:
                return placed_at(hidden, site, reach, size)

            placed, found, mu = sized(make, hidden.mu, scale, true, unit_of(site))
        except OutOfSight as error:
            last = error
            continue
        met = [it.followed[0] for it in found]
        coordinate, force = (
            max(float(np.abs(getattr(it, what)).max()) for it in met) for what in ("coordinate", "force")
        )
        return LawTruth(hidden.name, placed, mu, coordinate, force), found
    raise last


def _held(it: LawCase, scale: Scale, found: list[Readings], share: float) -> tuple[PlannedTest, ...]:
    """Tests that are held out: those of the plan, and the fitted one that sees the laws best at another angle."""
    plan = tuple(t for t in it.bench.plan if t.holdout)
    shown = scale.signature(found)
    fitted = scale.bench.plan
    best = max(range(len(fitted)), key=lambda k: float(np.linalg.norm(shown[scale.tests == k])))
    names = {t.id for t in plan}
    more = [further(fitted[best], angle, it.bench.rig, share) for angle in AWAY]
    return (*plan, next(t for t in more if t.id not in names))


def _written(
    it: LawCase, laws: tuple[LawTruth, ...], share: float, found: list[Readings], sizes: dict[str, float]
) -> tuple[Campaign, Truth]:
    """The campaign of exact readings, with the dirt of the bench; and the truth."""
    bench: Bench = it.bench
    campaign, knocks = read_dirty(f"{it.kind} {it.number}", bench, it.dirt, found, it.seed)
    exact = {
        test.id: np.hstack([one.displacement, one.wrench, one.gauges])
        for test, one in zip(bench.plan, found, strict=True)
        if test.holdout
    }
    return campaign, Truth(it, laws, share, it.dirt.bar, exact, sizes, knocks)
