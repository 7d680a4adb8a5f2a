"""Where the search looks on, and where it does not."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from pipeline.assessment.coverage.cases import BASE
from pipeline.assessment.virtual.bench import measure
from pipeline.assessment.virtual.plan import GAUGES, SENSORS, PlannedTest, bench_plan
from pipeline.campaign import Campaign, read
from pipeline.inference.load_cases import load_cases
from pipeline.inference.model import Model
from pipeline.selection import search
from pipeline.selection.criteria import CRITERIA
from pipeline.selection.diagnosis import Diagnosis, diagnose
from pipeline.selection.first_order_costs import Estimate
from pipeline.selection.fit_cache import FitCache
from pipeline.selection.search import _unforeseen
from pipeline.simulate import bench_rig, scaled, simulate
from tests.pipeline.selection.bench import AXIAL, COARSE, bench
from vjm.effects import catalogue
from vjm.work import elsewhere, spent

PLAY = "joint_clearance"


def found(campaign: Campaign, without: tuple[str, ...] = ()) -> Diagnosis:
    return diagnose(campaign, Model(), {k: v for k, v in catalogue().items() if k not in without})


@pytest.mark.parametrize(
    ("play", "bar", "there"), [(0.03, 0.02, True), (0.03, 0.0, False), (0.0, 0.02, False)]
)
def test_far_from_an_explanation_a_play_is_fitted_whatever_a_look_promises(
    play: float, bar: float, there: bool
) -> None:
    """Where the bar is known to a tolerance, which may take up what a look sees of it."""
    root = frozenset({BASE})
    effects = {name: catalogue()[name] for name in (BASE, "modulus_error", PLAY)}
    campaign = replace(bench(f"{PLAY}.play_mm", play, AXIAL), tolerance={"EA": bar})
    cache = FitCache(load_cases(campaign), Model(), effects, lambda _: None)
    assert (cache.fit(root).rms > cache.criteria.far) == bool(play)
    assert _unforeseen(cache, root) == ([root | {PLAY}] if there else [])
    assert (root | {PLAY} in cache.fits) == there


@pytest.mark.long
def test_beside_a_play_friction_is_seen_about_the_fit_of_the_play_alone() -> None:
    """About the model as it is every pair with the play looks as good, and the four that are fitted leave friction out;
    what is best of them, a contact with friction, leads nowhere."""
    hidden = {
        "joint_friction.torque_Nmm": 309.0,
        "joint_friction.presliding_rad": 2.06e-3,
        "joint_clearance.play_mm": 1.03e-2,
    }
    it = found(measure("pair", bench_rig(), bench_plan(), SENSORS, hidden, 5, GAUGES))
    assert it.verdict == "identified"
    assert set(it.sets[0]) == {BASE, PLAY, "joint_friction"}
    values = dict(zip((each.name for each in it.fit.model.free), it.fit.model.values, strict=True))
    errors = dict(zip(values, it.fit.std, strict=True))
    assert all(abs(values[name] - true) < 3.0 * errors[name] for name, true in hidden.items())


@pytest.mark.long
def test_near_an_explanation_a_play_that_alone_finds_nothing_is_in_no_pair() -> None:
    """Unknown, for bars that bend under the load are left out of the candidates and a third of the loads shows them: a
    tenth does not, where gauges between the ends of a lumped bar read its bent axis. Fits with a play take longest."""
    plan: tuple[PlannedTest, ...] = scaled(bench_plan(), bench_rig(), 0.3)
    campaign = measure("plain", bench_rig(), plan, COARSE, {"load_offset.y_mm": 9.0}, 5, GAUGES)
    it = found(campaign, (BASE, "material_yield"))
    assert it.verdict == "unknown" and it.fit.rms < 1.3
    assert PLAY not in it.sets[0]
    more = [names for names in it.cache.fits if PLAY in names and names - {PLAY} >= set(it.sets[0])]
    assert [len(names) for names in more] == [len(it.sets[0]) + 1]


def test_an_effect_that_hid_others_is_exchanged(monkeypatch: pytest.MonkeyPatch) -> None:
    """The best single one may look most like two others together: beside one of these the other takes its place."""
    costs = {"": 90.0, "m": 50.0, "a": 70.0, "b": 80.0, "ma": 40.0, "mb": 49.0, "ab": 10.0}
    known = {frozenset(names): value for names, value in costs.items()}

    def competing(_: object, start: frozenset[str], count: int) -> list[Estimate]:
        return [
            Estimate(names, value, {})
            for names, value in known.items()
            if names > start and len(names - start) == count
        ]

    monkeypatch.setattr(search, "cost", lambda _, names: known.get(names, 95.0))
    monkeypatch.setattr(search, "is_noise", lambda _, names: known[names] < 20.0)
    monkeypatch.setattr(search, "root_of", lambda *_: frozenset())
    monkeypatch.setattr(search, "_competing", competing)
    monkeypatch.setattr(search, "_sided", lambda *_: [])
    monkeypatch.setattr(search, "_built", lambda _, names: names)
    effect = SimpleNamespace(includes=())
    cache: Any = SimpleNamespace(
        fits={}, criteria=CRITERIA, candidates=dict.fromkeys("mab", effect), work=1e9, since=spent()
    )
    assert search._exchanged(cache, frozenset("ma")) == frozenset("ab")
    # One alone is what singles were looked at for, and what leaves noise stays.
    assert search._exchanged(cache, frozenset("m")) == frozenset("m")
    assert search._exchanged(cache, frozenset("ab")) == frozenset("ab")
    cache.fits = dict.fromkeys(range(CRITERIA.most_fits))
    assert search._exchanged(cache, frozenset("ma")) == frozenset("ma")


def test_what_an_exchange_may_take_leaves_some_for_what_comes_after(monkeypatch: pytest.MonkeyPatch) -> None:
    """Beyond half of what is left of a search it ends with what was found, not with the search."""
    names = frozenset("ma")
    monkeypatch.setattr(search, "cost", lambda *_: 40.0)
    monkeypatch.setattr(search, "is_noise", lambda *_: False)
    monkeypatch.setattr(search, "root_of", lambda *_: frozenset())
    monkeypatch.setattr(search, "_sided", lambda *_: [])
    asked = list[frozenset[str]]()

    def competing(_: object, start: frozenset[str], __: int) -> list[Estimate]:
        asked.append(start)
        elsewhere(60.0)
        return []

    monkeypatch.setattr(search, "_competing", competing)
    effect = SimpleNamespace(includes=())
    cache: Any = SimpleNamespace(
        fits={}, criteria=CRITERIA, candidates=dict.fromkeys("ma", effect), work=200.0, since=spent()
    )
    assert search._exchanged(cache, names) == names and len(asked) == 2
    assert spent() - cache.since < cache.work
    assert search._exchanged(cache, names) == names and len(asked) == 3


@pytest.mark.long
def test_a_play_and_a_friction_are_found_where_a_contact_looks_most_like_them(tmp_path: Path) -> None:
    simulate(tmp_path / "it", ["joint_friction=400", "joint_clearance"], 8, quiet=True)
    found = diagnose(read(tmp_path / "it"), Model(), catalogue())
    assert found.verdict == "identified"
    assert set(found.possible[0]) == {"bar_geometric_nonlinearity", "joint_clearance", "joint_friction"}
