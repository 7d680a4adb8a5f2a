"""Sets of effects against laws that explain as much."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from pipeline.discover import by_name, competition, looking
from pipeline.discover.beyond_catalogue import looked, with_laws
from pipeline.discover.effect_file import effect_text, write_effect
from pipeline.discover.recording import recorded
from pipeline.discover.search import Discovery
from pipeline.discover.words import law_sentences
from pipeline.inference.fit import Fit, fit
from pipeline.inference.model import Model
from pipeline.selection.diagnosis import Diagnosis, diagnose, suitable
from tests.pipeline.bench import bench
from tests.pipeline.discover.fits import GEOMETRY, effects_for, fitted_tests, friction_found
from vjm.effects import catalogue, from_file
from vjm.effects.base import Effect, Parameter
from vjm.forms import forms
from vjm.forms.coulomb import Coulomb
from vjm.site_law import SiteLaw

SPRING, BASE = "joint_torsional_stiffness", "base_compliance"
OWN = frozenset({BASE})


def named(unknown: Diagnosis, *sets: tuple[str, ...]) -> Diagnosis:
    """As if what was left by these sets had passed for noise."""
    names = tuple(frozenset((GEOMETRY.name, *each)) for each in sets)
    verdict = "identified" if len(sets) == 1 else "ambiguous"
    decision = replace(unknown.decision, verdict=verdict, sets=names, law="")
    return replace(unknown, decision=decision, judgement=replace(unknown.judgement, checks=()))


def costing(
    it: Diagnosis, found: Discovery, off: float, monkeypatch: pytest.MonkeyPatch, several: bool = False
) -> Diagnosis:
    """The diagnosis after a competition in which the law costs so much less than the set."""
    law = competition._standing(it, found, frozenset(it.sets[0]))
    assert law is not None
    monkeypatch.setattr(looking, "discover", lambda *_: found)
    monkeypatch.setattr(competition, "_leaves_a_pattern", lambda *_: several)
    monkeypatch.setattr(competition, "_may_compete", lambda *_: True)
    monkeypatch.setattr(competition, "_cost_of_set", lambda *_: law.cost + off)
    return with_laws(it)


@pytest.mark.parametrize(
    ("several", "off", "verdict"),
    [
        (False, -7.0, "identified"),
        (False, -5.0, "ambiguous"),
        (False, 1.0, "ambiguous"),
        (False, 20.0, "unknown"),
        (True, -20.0, "identified"),
        (True, -1.0, "ambiguous"),
        (True, 20.0, "unknown"),
    ],
)
def test_one_effect_keeps_its_name_where_it_is_better_than_a_law_by_strong_evidence(
    unknown: Diagnosis, monkeypatch: pytest.MonkeyPatch, several: bool, off: float, verdict: str
) -> None:
    """off: by how much the law costs less than the set; above ten chi-squares it is better beyond doubt."""
    it = named(unknown, (SPRING, BASE) if several else (SPRING,))
    assert costing(it, friction_found(), off, monkeypatch, several).verdict == verdict


@pytest.mark.parametrize("form", ["linear+coulomb", "two_slopes", "power"])
def test_no_strong_evidence_is_asked_of_a_name_that_is_a_part_of_the_law(
    unknown: Diagnosis, monkeypatch: pytest.MonkeyPatch, form: str
) -> None:
    """A slope and a friction in the hinges, or two slopes, and the name of a spring: the law has to be better by what
    it has more."""
    found = friction_found()
    (law,) = found.laws
    way = replace(law.ways[0], formed=replace(law.ways[0].formed, form=forms()[form]))
    both = replace(found, steps=(replace(law, ways=(way,)),))
    it = named(unknown, (SPRING,))
    assert costing(it, both, -5.0, monkeypatch).verdict == "identified"
    assert costing(it, both, 1.0, monkeypatch).verdict == "ambiguous"


class Sided(Coulomb):
    """As if each row chose its side of it."""

    kinked = True


def test_a_choice_of_sides_is_no_reason_to_hear_no_law(
    unknown: Diagnosis, monkeypatch: pytest.MonkeyPatch
) -> None:
    """One with sides is the cheapest form, and another one that is as good has none."""
    found = friction_found()
    (law,) = found.laws
    sided = replace(law.ways[0], formed=replace(law.ways[0].formed, form=Sided()))
    both = replace(found, steps=(replace(law, ways=(sided, law.ways[0])),))
    assert costing(named(unknown, (SPRING,)), both, -1.0, monkeypatch).verdict == "ambiguous"
    assert costing(named(unknown, ("joint_friction",)), both, 1.0, monkeypatch).verdict == "identified"
    alone = replace(found, steps=(replace(law, ways=(sided,)),))
    assert costing(named(unknown, (SPRING,)), alone, -1.0, monkeypatch).verdict == "identified"


@pytest.mark.parametrize(("off", "verdict"), [(9.0, "identified"), (20.0, "ambiguous")])
def test_a_law_that_leaves_more_than_noise_takes_a_name_only_where_it_is_far_better(
    unknown: Diagnosis, monkeypatch: pytest.MonkeyPatch, off: float, verdict: str
) -> None:
    """A law that was found in part still says that the set is not all, and is no proof of itself."""
    monkeypatch.setattr(competition, "explains", lambda *_: False)
    assert costing(named(unknown, (SPRING,)), friction_found(), off, monkeypatch).verdict == verdict


def test_a_law_that_is_the_effect_by_other_words_takes_no_name(
    unknown: Diagnosis, monkeypatch: pytest.MonkeyPatch
) -> None:
    whole = friction_found()
    assert by_name.effects_of(whole, catalogue()) == {"joint_friction"}
    monkeypatch.setattr(competition, "effects_of", lambda *_: frozenset({SPRING}))
    assert costing(named(unknown, (SPRING,)), whole, 20.0, monkeypatch).verdict == "identified"


def as_a_user_has_it(form: str, site: str) -> Effect:
    numbers = (Parameter("level_Nmm", "N·mm", 0.0, 300.0, 0.0, 1e5, "torque that slips"),)
    return SiteLaw.of(name="ours", title="ours", form=form, site=site, parameters=numbers)


def test_a_law_of_a_users_file_is_that_law_by_another_name() -> None:
    """The file that a search has written is the effect when the campaign is diagnosed again: of that form, at a site
    that is not told apart from it."""
    found = friction_found()
    (law,) = found.laws
    assert law.ways[0].formed.form.name == "coulomb"
    other = law.group[1].site.name
    assert other != law.site.name
    for site, form, there in [
        (law.site.name, "coulomb", True),
        (other, "coulomb", True),
        ("base_x", "slip", False),
        (law.site.name, "creep", False),
    ]:
        known = {"ours": as_a_user_has_it(form, site)}
        assert ("ours" in by_name.effects_of(found, known)) == there
    both = replace(law.ways[0], formed=replace(law.ways[0].formed, form=forms()["linear+coulomb"]))
    more = replace(found, steps=(replace(law, ways=(both,)),))
    ours = {"ours": as_a_user_has_it("coulomb", law.site.name)}
    assert "ours" not in by_name.effects_of(more, ours)
    assert "ours" in by_name.held_by(more, ours)


def test_an_effect_that_a_users_law_is_number_for_number_is_looked_for_as_that_law() -> None:
    """Else the two names of one law would be a tie that no test can tell."""
    campaign = bench("joint_friction.torque_Nmm", 600.0)
    friction = catalogue()["joint_friction"].parameters

    def left(site: str, form: str, count: int) -> tuple[bool, bool]:
        law = SiteLaw.of(name="ours", title="", form=form, site=site, parameters=friction[:count])
        can, cannot = suitable(campaign, Model(), {**catalogue(), "ours": law})
        held = {**can, **suitable(campaign, Model().with_effects([law]), catalogue())[0]}
        assert all("ours is the same law" in cannot[name] for name in set(cannot) & {"joint_friction"})
        return "joint_friction" in can, {"joint_friction", BASE} <= set(held)

    assert left("hinge_torque", "coulomb", 2) == (False, False)
    assert left("hinge_torque@tip", "coulomb", 2) == (True, True)
    # One of its six directions.
    assert left("base_x", "linear", 1) == (True, True)


@pytest.mark.long
def test_what_was_found_and_written_is_named_when_the_campaign_is_diagnosed_again(tmp_path: Path) -> None:
    campaign = bench("joint_friction.torque_Nmm", 600.0)
    first = looked(
        diagnose(campaign, Model(), {n: it for n, it in catalogue().items() if n != "joint_friction"})
    )
    assert first[0].verdict == "unknown" and first[1] is not None
    path = tmp_path / "found.py"
    write_effect(path, effect_text(first[1], recorded(first[1], campaign, 0.0)))
    (ours,) = from_file(path)
    assert "In the catalogue that is joint_friction" in " ".join(
        law_sentences(recorded(first[1], campaign, 0.0))
    )
    again = with_laws(diagnose(campaign, Model(), {**catalogue(), **from_file(path)}))
    assert (again.verdict, again.sets) == ("identified", ((GEOMETRY.name, ours),))


def test_an_effect_that_entered_beside_a_law_is_priced_and_one_of_the_model_is_not(
    unknown: Diagnosis,
) -> None:
    whole, it = friction_found(), named(unknown, (SPRING,))
    plain = competition._standing(it, whole, frozenset(it.sets[0]))
    assert plain is not None and plain.things == 1 and not plain.beside

    def having(name: str) -> competition._Rival:
        model = whole.end.model.with_effects([catalogue()[name]])
        found = replace(whole, end=replace(whole.end, model=model))
        rival = competition._standing(it, found, frozenset(it.sets[0]))
        assert rival is not None
        return rival

    assert having(BASE).beside == {BASE} and having(BASE).cost > plain.cost
    assert BASE in it.cache.candidates and "bar_initial_bow" not in it.cache.candidates
    assert having("bar_initial_bow").cost == plain.cost


def test_laws_are_looked_for_without_the_effect_and_beside_what_sets_have_in_common(
    unknown: Diagnosis,
) -> None:
    one = [*competition._starts(named(unknown, (SPRING,)), frozenset({SPRING}), several=False)]
    assert [(model.names, but) for model, but in one] == [(unknown.cache.base.names, frozenset({SPRING}))]
    two = [*competition._starts(named(unknown, (SPRING, BASE), (SPRING,)), frozenset({SPRING, BASE}), True)]
    assert [but for _, but in two] == [frozenset(), frozenset()]
    assert SPRING in two[1][0].names and BASE not in two[1][0].names


@pytest.fixture(scope="module")
def base_fit() -> Fit:
    """A base that gives in x alone, fitted with all six of its compliances."""
    campaign = bench("base_compliance.x_mm_per_N", 6e-6)
    effects: dict[str, Effect] = effects_for(campaign)
    return fit(Model().with_effects([GEOMETRY, effects[BASE]]), fitted_tests(campaign))


def test_an_effect_costs_the_numbers_that_it_needs(base_fit: Fit) -> None:
    one = float(np.log(base_fit.whitened.size))
    cost = competition._needed(base_fit, OWN, one)
    assert one < cost < 3.0 * one < 6.0 * one
    # Numbers of other effects are those of the model, whatever competes.
    assert competition._needed(base_fit, frozenset(), one) == 0.0
    # A number that costs nothing is never taken out.
    assert competition._needed(base_fit, OWN, 0.0) == pytest.approx(0.0, abs=1e-9)


def test_what_a_number_is_needed_for_is_what_is_left_more_without_it(base_fit: Fit) -> None:
    """With all numbers taken out the cost is the rise of chi-square to first order, of which the tangent is exact for a
    base that gives little."""
    without = fit(Model().with_effects([GEOMETRY]), fitted_tests(bench("base_compliance.x_mm_per_N", 6e-6)))
    rise = without.chi_square - base_fit.chi_square
    assert competition._needed(base_fit, OWN, 1e12) == pytest.approx(rise, rel=0.05)
