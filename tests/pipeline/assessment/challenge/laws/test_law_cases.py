"""Cases with hidden laws: what is drawn, that it is measured as drawn, and that a number is one case."""

from __future__ import annotations

import json
from collections import Counter
from dataclasses import replace

import numpy as np
import pytest

from pipeline.assessment.challenge.cases import case
from pipeline.assessment.challenge.dirty.dirt import _noise, true_rig
from pipeline.assessment.challenge.laws.cases import (
    BAR_MOST,
    BEYOND,
    CASES,
    GROUPS,
    MU,
    Hidden,
    LawCase,
    clean_case,
    group_of,
    law_case,
    pair_case,
)
from pipeline.assessment.challenge.laws.measured import Truth, measured
from pipeline.assessment.challenge.laws.outcome import hidden_laws
from pipeline.assessment.challenge.laws.shapes import GRAMMAR, OUTSIDE, SMOOTH_LAWS
from pipeline.assessment.challenge.outcome import campaign_of, shows
from pipeline.assessment.virtual.bench import true_readings
from pipeline.assessment.virtual.plan import GAUGES
from pipeline.campaign import Campaign
from pipeline.campaign.tolerance import usual
from pipeline.discover.evidence import Rest
from pipeline.inference.fit import unfitted
from pipeline.inference.load_cases import load_cases
from pipeline.inference.model import Model
from vjm.effects import catalogue

ONE_ANGLE = 30
"""A case of few tests: friction in hinges, at one angle."""
ALONG = 45
"""A case of a law along the bars."""
LAWS = [law_case(number) for number in range(CASES["law"])]
PAIRS = [pair_case(number) for number in range(CASES["pair"])]


@pytest.fixture(scope="module")
def found() -> tuple[Campaign, Truth]:
    return measured(law_case, ONE_ANGLE)


def test_every_law_of_the_grammar_and_outside_appears_twice() -> None:
    names = Counter(it.laws[0].name for it in LAWS)
    assert names == Counter(dict.fromkeys([*GRAMMAR, *OUTSIDE], 2))
    assert len(GRAMMAR) == 20 and len(OUTSIDE) == 10
    assert all(it.laws[0].name in GRAMMAR for it in LAWS[:40])


def test_every_kind_of_site_comes_first_somewhere_and_sizes_lie_in_their_range() -> None:
    first = Counter(group_of(it.laws[0].sites[0]) for it in LAWS)
    assert set(first) == set(GROUPS) and min(first.values()) >= 6
    assert {it.laws[0].sites[0].partition("@")[2] for it in LAWS} == {"", "base", "tip"}
    sizes = [law.mu for it in (*LAWS, *PAIRS) for law in it.laws]
    assert MU[0] <= min(sizes) and max(sizes) <= MU[1] and max(sizes) / min(sizes) > 5.0


def test_two_of_ten_have_a_poor_plan_and_a_third_has_dirt() -> None:
    for start in range(0, 60, 10):
        assert sum(it.poor for it in LAWS[start : start + 10]) == 2
    assert {it.bench.label for it in LAWS if it.poor} == {"one angle", "axial and swing"}
    dirty = [bool(it.dirt.tails or it.dirt.bad or it.dirt.correlated) for it in LAWS]
    assert sum(dirty) == 20 and all(dirty[::3])
    assert all(np.abs(it.dirt.bar - 1.0).max() < BAR_MOST + 1e-12 for it in LAWS)
    assert all(np.any(it.dirt.bar != 1.0) for it in LAWS)


def test_pairs_are_smooth_laws_at_sites_of_different_kinds() -> None:
    for it in PAIRS:
        one, other = it.laws
        assert {one.name, other.name} < set(SMOOTH_LAWS)
        assert group_of(one.sites[0]) not in {group_of(site) for site in other.sites}


def _told(it: LawCase) -> tuple[object, ...]:
    laws: tuple[Hidden, ...] = it.laws
    numbers = [it.dirt.bar, it.bench.noise.wrench, *(test.values for test in it.bench.plan)]
    return (laws, it.seed, it.poor, it.bench.label, it.bench.rig.length, [n.tobytes() for n in numbers])


def test_a_number_is_the_same_case_whenever_it_is_asked_for() -> None:
    assert [_told(law_case(n)) for n in (41, 7)] == [_told(LAWS[n]) for n in (41, 7)]
    assert _told(pair_case(3)) == _told(PAIRS[3])
    assert _told(LAWS[7]) != _told(LAWS[8])


@pytest.mark.long
def test_a_case_measured_again_is_the_same_to_the_last_bit(found: tuple[Campaign, Truth]) -> None:
    campaign, truth = measured(law_case, ONE_ANGLE)
    for one, other in zip(campaign.tests, found[0].tests, strict=True):
        assert one.data.displacement.tobytes() == other.data.displacement.tobytes()
        assert one.data.wrench.tobytes() == other.data.wrench.tobytes()
    assert [law.words for law in truth.laws] == [law.words for law in found[1].laws]
    assert truth.held_out_mu == found[1].held_out_mu


def test_a_law_shows_by_as_many_sigmas_as_were_drawn(found: tuple[Campaign, Truth]) -> None:
    """Measured again with the measure of the other programmes."""
    _, truth = found
    (law,) = truth.laws
    true, plan = true_rig(truth.case.bench.rig, truth.bar), truth.case.bench.plan
    without, there = (true_readings(true, plan, {}, GAUGES, placed) for placed in ((), [law.placed]))
    mu = float(np.linalg.norm(shows(truth.case, there, without)))
    assert mu == pytest.approx(truth.case.laws[0].mu, rel=0.05)
    assert law.mu == pytest.approx(mu, rel=1e-6)
    assert law.visible


@pytest.mark.long
def test_tolerances_explain_little_of_a_friction_and_much_of_what_is_along_the_bar(
    found: tuple[Campaign, Truth],
) -> None:
    (friction,) = hidden_laws(found[1], found[0])
    assert 0.9 * friction.mu < friction.told <= friction.mu
    campaign, truth = measured(law_case, ALONG)
    (along,) = hidden_laws(truth, campaign)
    # By a closed form without decompositions: abs(s)² less what the tolerances explain, with their price.
    fitted = replace(campaign, tests=tuple(test for test in campaign.tests if test.role == "fit"))
    plain = Model().with_effects([catalogue()["bar_geometric_nonlinearity"]])
    g = Rest.of(unfitted(plain, load_cases(fitted)).residual).tolerance
    s = truth.laws[0].shown
    u = np.linalg.solve(np.eye(g.shape[1]) + g.T @ g, g.T @ s)
    assert along.told == pytest.approx(np.sqrt(np.sum((s - g @ u) ** 2) + u @ u), rel=1e-6)
    assert along.told < 0.3 * along.mu


def test_what_is_written_is_the_truth_with_noise(found: tuple[Campaign, Truth]) -> None:
    campaign, truth = found
    (law,) = truth.laws
    assert campaign.tolerance == usual(campaign.rig.written)
    assert campaign.rig is truth.case.bench.rig
    held = [test for test in campaign.tests if test.role == "holdout"]
    assert [test.id for test in held] == list(truth.held_out) == list(truth.held_out_mu)
    sigma = np.concatenate([campaign.noise.displacement, campaign.noise.wrench])
    for test in held:
        read = np.hstack([test.data.displacement, test.data.wrench])
        off = (read - truth.held_out[test.id][:, :12]) / sigma
        # Half of a normal distribution; some readings are bad.
        assert 0.55 < np.median(np.abs(off)) < 0.8
    assert truth.knocks
    # Held out: further than anything fitted, and seen.
    reach = [max(it) for it in truth.held_out_reach.values()]
    assert BEYOND * 0.95 < max(reach) < BEYOND * 1.05
    assert max(truth.held_out_mu.values()) > 0.5 * law.mu
    words = json.loads(json.dumps(law.words))
    assert words["site"].startswith("hinge_torque") and words["law"] == "Coulomb"
    assert words["parameters"]["presliding"] > 0.0


def test_a_clean_case_hides_nothing() -> None:
    campaign, truth = measured(clean_case, 0)
    it = case(truth.case.number)
    assert it.kind == "clean" and not truth.laws and np.all(truth.bar == 1.0)
    plain = campaign_of(it, true_readings(it.bench.rig, it.bench.plan, {}, GAUGES), it.seed)
    for one, other in zip(campaign.tests, plain.tests, strict=True):
        assert one.data.wrench.tobytes() == other.data.wrench.tobytes()
    assert not campaign.tolerance


def test_clean_cases_are_exact_then_off_then_dirty() -> None:
    off = [float(np.abs(clean_case(n).dirt.bar - 1.0).max()) for n in (0, 99, 100, 199, 200, 299)]
    assert (
        off[:2] == [0.0, 0.0] and all(0.0 < it < BAR_MOST + 1e-12 for it in off[2:4]) and min(off[4:]) > 0.0
    )
    seeds = {clean_case(n).seed for n in range(CASES["clean"])}
    assert len(seeds) == CASES["clean"]
    assert not any(
        clean_case(n).hidden or clean_case(n).fault or clean_case(n).laws for n in range(0, 300, 7)
    )


def test_noise_with_tails_is_a_students_t_of_unit_variance() -> None:
    """Five percent of a t of three degrees lie beyond 3.182 (tables), which is 3.182 / sqrt(3) standard deviations."""
    noise = _noise(np.random.default_rng(1), (20_000, 2), None, 3.0)
    assert np.mean(np.abs(noise) > 3.182 / np.sqrt(3.0)) == pytest.approx(0.05, abs=0.004)


@pytest.mark.long
@pytest.mark.parametrize("number", range(CASES["law"]))
def test_every_case_with_a_law_can_be_measured(number: int) -> None:
    _proved(*measured(law_case, number))


@pytest.mark.long
@pytest.mark.parametrize("number", range(CASES["pair"]))
def test_every_case_with_two_laws_can_be_measured(number: int) -> None:
    _, truth = measured(pair_case, number)
    _proved(_, truth)
    assert len({group_of(law.placed.site) for law in truth.laws}) == 2


def _proved(campaign: Campaign, truth: Truth) -> None:
    for hidden, law in zip(truth.case.laws, truth.laws, strict=True):
        assert law.mu == pytest.approx(hidden.mu, rel=0.05)
        assert law.visible and hidden.name == law.name
    reach = np.array(list(truth.held_out_reach.values()))
    assert reach.max() < BEYOND * 1.06
    assert reach.max(0).min() > 1.1
    assert all(np.isfinite(it).all() for it in truth.held_out.values())
    assert sum(test.role == "fit" for test in campaign.tests) >= 3
