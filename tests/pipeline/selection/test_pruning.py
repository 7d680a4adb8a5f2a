"""Sets without one of their effects: what ended higher than the larger set's own numbers say is fitted again."""

from __future__ import annotations

from dataclasses import replace

import pytest

from pipeline.assessment.coverage.cases import BASE
from pipeline.assessment.virtual.bench import measure
from pipeline.assessment.virtual.plan import GAUGES, SENSORS, bench_plan
from pipeline.inference.fit import Fit, fit
from pipeline.inference.load_cases import load_cases
from pipeline.inference.model import Model
from pipeline.selection.cost import cost
from pipeline.selection.criteria import CRITERIA
from pipeline.selection.diagnosis import diagnose
from pipeline.selection.fit_cache import FitCache, Names
from pipeline.selection.pruning import fit_from, pruned
from pipeline.simulate import bench_rig, scaled
from tests.pipeline.selection.bench import AXIAL, bench
from vjm.effects import catalogue

SMALL, LARGE = frozenset({"modulus_error"}), frozenset({"modulus_error", "load_offset"})
AWAY = 6.0
"""Standard errors."""


def shelf_of(effect: str, value: float) -> FitCache:
    cases = load_cases(bench(effect, value, AXIAL))
    cache = FitCache(cases, Model(), {name: catalogue()[name] for name in sorted(LARGE)}, lambda _: None)
    cache.fit(SMALL)
    cache.fit(LARGE)
    return cache


def stuck(cache: FitCache, names: Names) -> Fit:
    """A fit that ended some standard errors away."""
    found = cache.fit(names)
    model = found.model.at(found.model.values + AWAY * found.std)
    held = replace(model, fixed=model.fixed | {each.name for each in model.free})
    there = fit(held, cache.whole, found.prediction)
    return replace(found, model=model, prediction=there.prediction, residual=there.residual)


def test_what_ended_too_high_is_fitted_again_from_the_set_that_holds_it() -> None:
    cache = shelf_of("modulus_error.scale", 0.97)
    best = cache.fit(SMALL).chi_square
    cache.fits[SMALL] = stuck(cache, SMALL)
    assert cache.fit(SMALL).chi_square > best + 0.5 * AWAY**2
    fit_from(cache, LARGE)
    assert cache.fit(SMALL).chi_square == pytest.approx(best, abs=0.01)
    # Once from each set.
    again = cache.fits[SMALL] = stuck(cache, SMALL)
    fit_from(cache, LARGE)
    assert cache.fit(SMALL) is again


def test_what_needs_the_effect_is_not_fitted_again() -> None:
    cache = shelf_of("load_offset.y_mm", 5.0)
    before = dict(cache.fits)
    assert before[SMALL].chi_square > before[LARGE].chi_square + 100.0
    fit_from(cache, LARGE)
    assert cache.fits == before


def test_what_is_there_or_not_is_needed_where_little_is_explained_without_it() -> None:
    """Geometric stiffness on a good bench: without it a linear step in the load offset leaves many times as much, and
    no fit of that is made."""
    cases = load_cases(bench("load_offset.y_mm", 5.0))
    candidates = {name: catalogue()[name] for name in (BASE, "load_offset", "modulus_error")}
    cache = FitCache(cases, Model(), candidates, lambda _: None)
    names = frozenset({BASE, "load_offset"})
    fit_without = fit(cache.fit(names).model.without(BASE), cases).chi_square
    # The step is linear, so a fit may leave less.
    assert fit_without == pytest.approx(cache.left_without(names, BASE) * cache.least(names), rel=0.05)
    assert fit_without > 2.0 * CRITERIA.far_off * cache.least(names)
    assert pruned(cache, names) == names
    assert names - {BASE} not in cache.fits


def test_a_set_that_lost_an_effect_is_fitted_from_where_it_stood(monkeypatch: pytest.MonkeyPatch) -> None:
    """A modulus that is not needed: one fit without it, from there, and none as if the set had not been."""
    begun: list[Names] = []
    whole = FitCache._fitted
    monkeypatch.setattr(
        FitCache, "_fitted", lambda it, names, begin: (begun.append(names), whole(it, names, begin))[1]
    )
    cases = load_cases(bench("load_offset.y_mm", 5.0, AXIAL))
    cache = FitCache(cases, Model(), {name: catalogue()[name] for name in sorted(LARGE)}, lambda _: None)
    cache.fit(LARGE)
    begun.clear()
    assert pruned(cache, LARGE) == {"load_offset"}
    assert frozenset({"load_offset"}) not in begun
    assert cache.fits[frozenset({"load_offset"})].evaluations < 4


def test_a_fit_from_there_that_shows_nothing_is_made_anew(monkeypatch: pytest.MonkeyPatch) -> None:
    """One that ended six standard errors away, where the set without the offset is good."""
    cache = shelf_of("modulus_error.scale", 0.97)
    away = stuck(cache, SMALL)
    best = cache.fits.pop(SMALL).chi_square
    monkeypatch.setattr(
        FitCache, "fit_again", lambda it, wanted, _: it.fits.update(dict.fromkeys(wanted, away))
    )
    assert best + 30.0 < away.chi_square < CRITERIA.refit_near * cache.least(LARGE)
    assert pruned(cache, LARGE) == SMALL
    assert cache.fit(SMALL).chi_square == pytest.approx(best, abs=0.01)


@pytest.mark.long
def test_a_play_that_is_certain_is_not_left_out_to_see() -> None:
    """Of a hundred times the noise; one of a fifth of it may be needless, and a set without it is fitted."""
    tried = {}
    for play in (0.1, 2e-4):
        cases = load_cases(bench("joint_clearance.play_mm", play, ("axial_held_q+0",)))
        cache = FitCache(
            cases, Model(), {n: catalogue()[n] for n in ("joint_clearance", "load_offset")}, lambda _: None
        )
        names = frozenset(cache.candidates)
        cache.fit(names, {"joint_clearance": play})
        pruned(cache, names)
        tried[play] = names - {"joint_clearance"} in cache.fits
    assert tried == {0.1: False, 2e-4: True}


def test_what_leaves_less_than_noise_needs_nothing_by_far() -> None:
    """Sensors called twenty times worse than they are: five times of next to nothing is next to nothing."""
    campaign = bench("bar_initial_bow.bow_y_mm", 0.12, AXIAL)
    worse = {name: 20.0 * getattr(campaign.noise, name) for name in ("displacement", "wrench", "gauges")}
    cases = load_cases(replace(campaign, noise=replace(campaign.noise, **worse)))
    candidates = {name: catalogue()[name] for name in (BASE, "bar_initial_bow")}
    cache = FitCache(cases, Model(), candidates, lambda _: None)
    names = frozenset(candidates)
    without = names - {BASE}
    cache.fit(names)
    assert cache.left_without(names, BASE) < 1.0
    assert pruned(cache, names) != names
    assert cost(cache, without) < cost(cache, names)


@pytest.mark.long
def test_friction_and_play_under_coarse_sensors_name_nothing_else() -> None:
    """Loads of a tenth, sensors ten times coarser: fits of friction and play end up to 60 of chi-square apart, by the
    sides that rows chose, and one with a stiffening contact of no size ended below those without it. The geometric
    stiffness of the bars is not seen at such loads, and gauges read their bent axes without it."""
    rig = bench_rig()
    coarse = {name: 10.0 * getattr(SENSORS, name) for name in ("displacement", "wrench", "gauges")}
    hidden = {
        "joint_friction.torque_Nmm": 2000.0,
        "joint_friction.presliding_rad": 2e-3,
        "joint_clearance.play_mm": 0.05,
    }
    plan = scaled(bench_plan(), rig, 0.1)
    campaign = measure("coarse", rig, plan, replace(SENSORS, **coarse), hidden, 5, GAUGES)
    found = diagnose(campaign, Model(), catalogue())
    assert found.verdict == "identified"
    assert set(found.sets[0]) == {"joint_clearance", "joint_friction"}
