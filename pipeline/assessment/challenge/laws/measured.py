"""A case with hidden laws, measured: the campaign that a bench writes, and the sealed truth beside it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import asdict, dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fem.frame.bench import Readings
from fem.frame.placed import Placed
from pipeline.assessment.challenge.dirty.dirt import Knock, read_dirty, true_rig
from pipeline.assessment.challenge.laws.cases import BEYOND, Hidden, LawCase, further, group_of
from pipeline.assessment.challenge.laws.size import (
    OutOfSight,
    Scale,
    placed_at,
    reach_of,
    scale_of,
    sized,
    unit_of,
)
from pipeline.assessment.challenge.outcome import SHARES, campaign_of
from pipeline.assessment.virtual.bench import true_readings
from pipeline.assessment.virtual.plan import GAUGES, PlannedTest
from pipeline.campaign import Campaign, ParallelogramRig

Array = NDArray[np.float64]
AWAY = {0.0: (15.0, -15.0), 30.0: (25.0, 20.0), -30.0: (-25.0, -20.0)}
"""Degrees at which a test of an angle is done again, held out: the first that the plan has not; near enough for a site
to meet as much."""
REDUCTIONS, NEAR = 4, 0.97
"""How often the loads of held-out tests are reduced in proportion, and the share that is near enough: the load that
passes a site is not proportional to that of the test."""
SEEN = 5.0
"""Sigmas from which a site counts as visible."""


@dataclass(frozen=True, eq=False)
class LawTruth:
    """A law as it was: name of its class, the law placed, what it alone does to the fitted tests, (N,) in sigmas, and
    the largest coordinate and force that it met there."""

    name: str
    placed: Placed
    shown: Array
    coordinate: float
    force: float

    @property
    def mu(self) -> float:
        """Sigmas by which it alone shows in the fitted tests."""
        return float(np.linalg.norm(self.shown))

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
    laws show in each; held_out_reach: what the site of each law meets there over what it meets in the fitted
    tests, the turn of a hinge or the load through a series site. knocks: bad readings."""

    case: LawCase
    laws: tuple[LawTruth, ...]
    share: float
    bar: Array
    held_out: dict[str, Array]
    held_out_mu: dict[str, float]
    held_out_reach: dict[str, tuple[float, ...]]
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
        return _written(it, (), share, true_readings(true, it.bench.plan, {}, GAUGES), _Held((), [], {}, {}))
    fitted = replace(it.bench, plan=tuple(t for t in it.bench.plan if not t.holdout))
    scale = scale_of(fitted, true)
    found = scale.without
    laws: list[LawTruth] = []
    for hidden in it.laws:
        law, found = _brought(hidden, scale, true, {group_of(one.placed.site) for one in laws})
        laws.append(law)
    if len(laws) > 1:
        found = true_readings(true, fitted.plan, {}, GAUGES, [law.placed for law in laws])
    held = _held(it, scale, found, laws, share)
    whole = replace(it, bench=replace(it.bench, plan=(*fitted.plan, *held.plan)))
    return _written(whole, tuple(laws), share, [*found, *held.found], held)


def _brought(
    hidden: Hidden, scale: Scale, true: ParallelogramRig, taken: set[str]
) -> tuple[LawTruth, list[Readings]]:
    """A law at the first of its sites where it shows by as much as it should, and exact readings with it alone.

    taken: kinds of sites (`GROUPS`) where another law is.
    """
    last: RuntimeError = OutOfSight("no site")
    for site in (s for s in hidden.sites if group_of(s) not in taken):
        try:
            reach = reach_of(site, scale.bench, true)

            def make(size: float, site: str = site, reach: float = reach) -> Placed:
                return placed_at(hidden, site, reach, size)

            placed, found, shown = sized(make, hidden.mu, scale, true, unit_of(site))
        except OutOfSight as error:
            last = error
            continue
        met = [it.followed[0] for it in found]
        coordinate, force = (
            max(float(np.abs(getattr(it, what)).max()) for it in met) for what in ("coordinate", "force")
        )
        return LawTruth(hidden.name, placed, shown, coordinate, force), found
    raise last


@dataclass(frozen=True, eq=False)
class _Held:
    """Tests that are held out, their exact readings, and by their ids what `Truth` tells of them."""

    plan: tuple[PlannedTest, ...]
    found: list[Readings]
    mu: dict[str, float]
    reach: dict[str, tuple[float, ...]]


def _held(it: LawCase, scale: Scale, found: list[Readings], laws: list[LawTruth], share: float) -> _Held:
    """Tests that are held out: those of the plan, and by law the fitted one in which its site meets most, at another
    angle."""
    true, placed = true_rig(it.bench.rig, it.dirt.bar), [law.placed for law in laws]
    held = {t.id: t for t in it.bench.plan if t.holdout}
    for name in dict.fromkeys(_most(scale.bench.plan, found, k, law) for k, law in enumerate(laws)):
        (best,) = [t for t in scale.bench.plan if t.id == name]
        more = [further(best, angle, it.bench.rig, share) for angle in AWAY[best.q_deg]]
        held |= {t.id: t for t in [next(t for t in more if t.id not in held)]}
    reached = [_met(found, k, law) for k, law in enumerate(laws)]
    plan = _within(tuple(held.values()), reached, laws, true)
    # Taken as fitted, so that they are measured by the same scale.
    bench = replace(it.bench, plan=tuple(replace(t, holdout=False) for t in plan))
    beyond = scale_of(bench, true)
    there = true_readings(true, bench.plan, {}, GAUGES, placed)
    shown = beyond.signature(there)
    return _Held(
        plan,
        there,
        {t.id: float(np.linalg.norm(shown[beyond.tests == k])) for k, t in enumerate(plan)},
        {
            t.id: tuple(_met([one], k, law) / reached[k] for k, law in enumerate(laws))
            for t, one in zip(plan, there, strict=True)
        },
    )


def _within(
    plan: tuple[PlannedTest, ...], reached: list[float], laws: list[LawTruth], true: ParallelogramRig
) -> tuple[PlannedTest, ...]:
    """The held-out tests, weaker where a site would meet more than `BEYOND` times what it met in the fitted tests."""
    placed = [law.placed for law in laws]
    for _ in range(REDUCTIONS):
        found = true_readings(true, plan, {}, GAUGES, placed)
        shares = []
        for one in found:
            met = [_met([one], k, law) for k, law in enumerate(laws)]
            parts = [BEYOND * own / more for own, more in zip(reached, met, strict=True) if more > 0.0]
            shares.append(min([1.0, *parts]))
        plan = tuple(replace(t, values=share * t.values) for t, share in zip(plan, shares, strict=True))
        if min(shares) > NEAR:
            break
    return plan


def _most(plan: tuple[PlannedTest, ...], found: list[Readings], number: int, law: LawTruth) -> str:
    """The id of the test in which the site of a law meets most."""
    met = [_met([one], number, law) for one in found]
    return plan[int(np.argmax(met))].id


def _met(found: list[Readings], number: int, law: LawTruth) -> float:
    """Largest coordinate of a hinge, or load through a series site."""
    every, unit = [it.followed[number] for it in found], unit_of(law.placed.site)
    return max(float(np.abs(it.coordinate if unit == "torque" else it.force).max()) for it in every)


def _written(
    it: LawCase, laws: tuple[LawTruth, ...], share: float, found: list[Readings], held: _Held
) -> tuple[Campaign, Truth]:
    """The campaign of exact readings, with the dirt of the bench; and the truth."""
    bench, knocks = it.bench, tuple[Knock, ...]()
    if it.exact:
        campaign = campaign_of(it, found, it.seed)
    else:
        campaign, knocks = read_dirty(f"{it.kind} {it.number}", bench, it.dirt, found, it.seed)
    exact = {
        test.id: np.hstack([one.displacement, one.wrench, one.gauges])
        for test, one in zip(bench.plan, found, strict=True)
        if test.holdout
    }
    return campaign, Truth(it, laws, share, it.dirt.bar, exact, held.mu, held.reach, knocks)
