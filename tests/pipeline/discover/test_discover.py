"""Laws that frame elements made, found again: the place, the form, the file that says so."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from pipeline.answer.of_diagnosis import answered
from pipeline.assessment.challenge.laws.cases import law_case
from pipeline.assessment.challenge.laws.measured import measured
from pipeline.assessment.challenge.laws.outcome import discovered
from pipeline.discover import looking, search
from pipeline.discover.beyond_catalogue import with_laws
from pipeline.discover.effect_file import effect_text, name_of, write_effect
from pipeline.discover.evidence import Array, Evidence
from pipeline.discover.forming import fitted_form, formed
from pipeline.discover.locating import Located, Map, mapped
from pipeline.discover.recording import recorded
from pipeline.discover.search import Discovery, discover, fitted_to
from pipeline.discover.words import law_sentences, sentences
from pipeline.errors import InputError
from pipeline.inference.fit import unfitted
from pipeline.inference.model import Model, Term
from pipeline.selection.criteria import CRITERIA
from pipeline.selection.diagnosis import Diagnosis
from tests.pipeline.bench import bench
from tests.pipeline.discover.fits import (
    GEOMETRY,
    diagnosed,
    effects_for,
    fitted_tests,
    friction_found,
    map_of,
)
from vjm.effects import catalogue, from_file
from vjm.effects.base import Effect

HIDDEN = {
    "joint_torsional_stiffness.stiffness_Nmm_per_rad": (30000.0, "hinge_torque", "linear"),
    "joint_friction.torque_Nmm": (600.0, "hinge_torque", "coulomb"),
    "base_compliance.x_mm_per_N": (6e-6, "base_x", "linear"),
    "contact_stiffening.c_mm_per_N23": (1e-4, "along", "power"),
    "joint_clearance.play_mm": (0.02, "along", ""),
}


QUICK = (
    "joint_friction.torque_Nmm",
    "joint_torsional_stiffness.stiffness_Nmm_per_rad",
    "joint_clearance.play_mm",
)
EACH = [pytest.param(it, marks=[] if it in QUICK else pytest.mark.long) for it in HIDDEN]


@pytest.mark.parametrize("effect", EACH)
def test_the_place_is_the_best_or_in_its_group(effect: str) -> None:
    value, site, _ = HIDDEN[effect]
    seen = map_of(effect, value)
    assert site in {it.site.name.partition("@")[0] for it in seen.group(10.0)}
    assert seen.best > 50.0
    assert seen.body is None or seen.body.value < seen.best - 10.0


@pytest.mark.parametrize("effect", [it for it in EACH if HIDDEN[str(it.values[0])][2]])
def test_the_form_is_among_those_that_explain_as_much(effect: str) -> None:
    value, site, form = HIDDEN[effect]
    seen = map_of(effect, value)
    best = next(it for it in seen.sites if it.site.kind == site and "@" not in it.site.name)
    every = formed(best.site, seen.rest, best.evidence.site.largest)
    assert form in [it.form.name for it in every if it.cost <= every[0].cost + 10.0]


@pytest.mark.parametrize(
    ("effect", "value", "body"),
    [
        pytest.param("load_offset.y_mm", 3.0, "load_offset", marks=pytest.mark.long),
        ("modulus_error.scale", 0.95, "modulus_error"),
        pytest.param("bar_initial_bow.bow_y_mm", 0.5, "bar_initial_bow", marks=pytest.mark.long),
    ],
)
def test_what_is_no_law_by_nature_is_none(effect: str, value: float, body: str) -> None:
    seen = map_of(effect, value)
    assert seen.body is not None and seen.body.effect.name == body
    assert seen.body.value > seen.best - 10.0


def test_nothing_sits_anywhere_where_nothing_is() -> None:
    seen = map_of()
    assert seen.best < 8.0
    assert all(it.value < 8.0 for it in seen.bodies)


@pytest.fixture(scope="module")
def found() -> Discovery:
    return friction_found()


def test_friction_is_found_put_in_and_nothing_is_left(found: Discovery) -> None:
    (law,) = found.laws
    assert law.site.kind == "hinge_torque"
    assert found.whole and found.bent
    way = next(way for way in law.ways if way.formed.form.name in ("coulomb", "linear+coulomb"))
    assert way.values["limit_Nmm"] == pytest.approx(600.0, rel=0.1)
    assert found.end.rms == pytest.approx(1.0, abs=0.1)


def test_the_record_says_it_in_words(found: Discovery) -> None:
    campaign = bench("joint_friction.torque_Nmm", 600.0)
    record = recorded(found, campaign, 1.0)
    said = sentences(record)
    assert said[0].startswith("What is left sits here: torque about the hinge axes.")
    (law,) = record.laws
    assert "loop" in law.shape
    assert record.error[-1].holdout == pytest.approx(1.0, abs=0.15)
    assert law.curve is not None and law.curve.x_unit == "rad" and law.curve.y_unit == "N·mm"
    assert np.max(np.abs(law.curve.free)) == pytest.approx(600.0, rel=0.3)
    assert not record.not_done
    assert type(record).model_validate_json(record.text()) == record


def test_the_file_gives_the_same_chi_square(found: Discovery, tmp_path: Path) -> None:
    campaign = bench("joint_friction.torque_Nmm", 600.0)
    record = recorded(found, campaign, 1.0)
    path = tmp_path / "law.py"
    write_effect(path, effect_text(found, record))
    (law,) = found.laws
    effects = from_file(path)
    it: Effect = effects[name_of(law.ways[0])]
    base = replace(found.end.model, terms=found.end.model.terms[:-1])
    own = {p.name: v for p, v in zip(it.parameters, law.ways[0].values.values(), strict=True)}
    again = unfitted(replace(base, terms=(*base.terms, Term(it, own))), fitted_tests(campaign))
    there = unfitted(found.end.model, fitted_tests(campaign))
    assert again.chi_square == pytest.approx(there.chi_square, rel=1e-6)


def test_sigmas_that_are_too_small_make_no_law() -> None:
    """Of a bench without anything hidden whose positions were declared at a third of what they scatter by."""
    campaign = bench()
    factors = np.ones(12 + len(campaign.gauges))
    factors[:6] = 0.33
    told = replace(campaign, noise=campaign.noise.times(factors))
    at_first = mapped(unfitted(Model().with_effects([GEOMETRY]), fitted_tests(told)), effects_for(told))
    assert at_first.best > CRITERIA.law_proposed
    found = discover(fitted_tests(told), Model(), effects_for(told))
    assert not found.steps and found.last.best < CRITERIA.law_proposed
    record = recorded(found, told, 1.0)
    assert {each.column for each in record.noise} <= {"x_mm", "y_mm", "z_mm", "rx_rad", "ry_rad", "rz_rad"}
    assert all(2.0 < each.found / each.declared < 5.0 for each in record.noise) and len(record.noise) >= 2
    assert any("what it does counts" in said for said in sentences(record))


def test_what_is_left_beside_a_law_and_is_no_noise_is_said() -> None:
    """As where the place is another: the law is said of the model without it."""
    whole, campaign = friction_found(), bench("joint_friction.torque_Nmm", 600.0)
    assert not recorded(whole, campaign, 1.0).left
    wrong = recorded(replace(whole, end=whole.begin), campaign, 1.0)
    assert wrong.left and "sigma" in wrong.left[0]
    assert any("may be another" in said and wrong.left[0] in said for said in law_sentences(wrong))
    assert not any("may be another" in said for said in sentences(recorded(whole, campaign, 1.0)))


def test_a_file_that_is_no_python_file_is_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="no Python file"):
        write_effect(tmp_path / "law.txt", "")


@pytest.mark.long
def test_a_play_is_found_as_a_gap() -> None:
    campaign = bench("joint_clearance.play_mm", 0.02)
    found = discover(fitted_tests(campaign), Model(), effects_for(campaign))
    (law,) = found.laws
    assert law.site.kind == "along" and law.ways[0].formed.form.name == "gap"
    # Half of the play at either end of a bar, or all of it at one.
    parts = 2.0 if "@" not in law.site.name else 1.0
    assert parts * law.ways[0].values["gap_mm"] == pytest.approx(0.02, rel=0.05)
    assert found.whole


def test_what_a_function_at_a_place_explains_is_no_noise(unknown: Diagnosis, found: Discovery) -> None:
    """Also where no form is that function, and sums of squares are those of noise."""
    assert looking.explains(unknown, found)
    assert not looking.explains(unknown, replace(found, last=found.laws[0].map))


def test_a_form_that_a_place_cannot_have_is_not_tried_there(
    found: Discovery, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Dry friction holds a hinge; what is rigid is never in a group with it by that form."""
    law = found.laws[0]
    along = next(it for it in law.map.sites if it.site.name == "along")
    assert fitted_form(law.ways[0].formed.form, along.site, law.map.rest, along.largest) is None
    monkeypatch.setattr(search, "through", lambda *_: pytest.fail("it was tried"))
    wide = replace(law, group=(law.group[0], along))
    cases = found.end.residual.load_cases
    assert search._elsewhere(wide, found.end, cases, lambda _: None) is None


@pytest.mark.long
def test_a_law_of_one_end_of_the_bars_is_placed_there() -> None:
    """Influences that are known to some parts in a hundred do not tell it from one of both ends, the mechanism does."""
    campaign, _ = measured(law_case, 11)
    (law,) = discovered(campaign).laws
    names = {it.site.name for it in law.group}
    assert "hinge_torque@base" in names and "hinge_torque" in law.apart and not names & law.apart
    assert law.margin > 0.0


@pytest.mark.usefixtures("known_laws")
def test_what_nothing_known_explains_ends_with_its_place_and_law(unknown: Diagnosis) -> None:
    assert unknown.verdict == "unknown" and not unknown.laws
    answer = answered(with_laws(unknown))
    assert answer.verdict == "unknown"
    (law,) = answer.laws
    assert law.site == "hinge_torque" and "coulomb" in {law.form, *(tie.form for tie in law.ties)}
    assert law.fit == pytest.approx(1.0, abs=0.1)
    assert any("torque about the hinge axes" in said for said in answer.sentences)
    assert not answer.not_done
    assert type(answer).model_validate_json(answer.text()) == answer


def test_a_law_that_fails_takes_nothing_with_it(unknown: Diagnosis, monkeypatch: pytest.MonkeyPatch) -> None:
    def fails(*_: object) -> None:
        raise RuntimeError("no state")

    monkeypatch.setattr(looking, "discover", fails)
    answer = answered(with_laws(unknown))
    assert answer.verdict == "unknown" and not answer.laws
    assert any("laws beyond the catalogue" in said and "no state" in said for said in answer.not_done)


@pytest.mark.long
def test_an_effect_that_is_there_keeps_its_name() -> None:
    found = diagnosed(600.0, "joint_friction", "joint_torsional_stiffness")
    again = with_laws(found)
    assert again.verdict == found.verdict == "identified"
    assert again.sets == found.sets and not again.laws


@pytest.mark.usefixtures("known_laws")
def test_a_law_takes_the_name_from_a_set_that_it_beats(unknown: Diagnosis) -> None:
    """As if what was left by the best set had passed for noise."""
    taken = replace(
        unknown,
        decision=replace(unknown.decision, verdict="identified"),
        judgement=replace(unknown.judgement, checks=()),
    )
    again = with_laws(taken)
    assert again.verdict == "unknown" and "hinge_torque" in again.decision.because
    assert [law.site for law in again.laws] == ["hinge_torque"]
    assert not set(again.certain) & {"joint_torsional_stiffness", "base_compliance"}


def test_laws_that_explain_all_beside_what_is_certain_or_without_it(
    unknown: Diagnosis, monkeypatch: pytest.MonkeyPatch
) -> None:
    """What is certain stays where laws explain all beside it alone; where laws without it do, it was one of them."""
    whole, asked = friction_found(), list[Model]()
    halfway = replace(whole, end=whole.begin)
    there = replace(whole, end=replace(whole.end, model=asked_with(whole.end.model)))

    def of(beside: Discovery, without: Discovery) -> Diagnosis:
        def looked(_: object, start: Model, *__: object) -> Discovery:
            asked.append(start)
            return beside if "base_compliance" in start.names else without

        monkeypatch.setattr(looking, "discover", looked)
        return with_laws(replace(unknown, certain=("base_compliance",)))

    assert not of(halfway, whole).certain and [it.names for it in asked][1:] == [unknown.cache.base.names]
    assert of(there, halfway).certain == ("base_compliance",)
    assert not of(there, whole).certain


def test_where_noise_is_left_and_no_law_is_found_the_answer_is_as_it_was(
    unknown: Diagnosis, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Bars that bend far and nothing else: no law is looked for in their place, and none inside the noise is told."""
    none = replace(friction_found(), steps=(), end=friction_found().begin)
    monkeypatch.setattr(looking, "discover", lambda *_: none)
    decision = replace(unknown.decision, verdict="identified", sets=(frozenset({GEOMETRY.name}),))
    noise = replace(unknown, decision=decision, judgement=replace(unknown.judgement, checks=()))
    again = with_laws(noise)
    assert again.verdict == "identified" and not again.laws and not again.law_words and not again.failed
    assert with_laws(unknown).law_words


def test_a_place_without_a_form_takes_nothing_with_it(
    unknown: Diagnosis, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A sensor's column, or a place of which no form is one: there is no law in the mechanism."""
    whole = friction_found()
    (law,) = whole.laws
    bare = replace(whole, steps=(replace(law, ways=()),), whole=False)
    monkeypatch.setattr(looking, "discover", lambda *_: bare)
    again = with_laws(replace(unknown, certain=("base_compliance",)))
    assert not again.failed and [each.site for each in again.laws] == ["hinge_torque"]


def test_what_acts_at_the_place_of_a_law_is_not_certain(unknown: Diagnosis) -> None:
    """Beside another law of the hinges nobody knows that a spring is in them; the law that is the friction is that
    effect by other words."""
    found = friction_found()
    (law,) = found.laws
    assert law.ways[0].formed.form.name == "coulomb"
    sure = ("joint_torsional_stiffness", "base_compliance", "joint_friction")
    seen = spring_and_lengths("base_compliance")
    end = replace(found.end, model=seen.found.model)
    its = replace(found, steps=(replace(law, map=seen, group=(at_hinges(seen),)),), end=end)
    it = looking.less_certain(replace(unknown, certain=sure), its)
    assert it.certain == ("base_compliance", "joint_friction")


def spring_and_lengths(other: str) -> Map:
    """A bench with friction, and a model with a spring in its hinges and another effect."""
    campaign = bench("joint_friction.torque_Nmm", 600.0)
    effects = effects_for(campaign)
    own = [effects[name] for name in ("joint_torsional_stiffness", other)]
    return mapped(fitted_to(Model().with_effects([GEOMETRY, *own]), fitted_tests(campaign)), effects)


def at_hinges(seen: Map) -> Located:
    return next(it for it in seen.sites if it.site.name == "hinge_torque")


def asked_with(model: Model) -> Model:
    return model.with_effects([catalogue()["base_compliance"]])


def test_an_effect_at_the_place_of_a_law_is_a_part_of_it() -> None:
    """A linear spring in the hinges is a function there, bars of two lengths are none."""
    seen = spring_and_lengths("bar_length_mismatch")
    law = search.Law(seen, (at_hinges(seen),), np.zeros(0), ())
    assert [*search.in_its_place(law)] == ["joint_torsional_stiffness"]


def test_another_length_is_a_constant_along_the_bars() -> None:
    """A function there does what it does, but a law without a constant takes nothing from it."""
    campaign = bench("bar_length_mismatch.mismatch_mm", 0.2)
    effects = effects_for(campaign)
    known = Model().with_effects([GEOMETRY, effects["bar_length_mismatch"]])
    seen = mapped(fitted_to(known, fitted_tests(campaign)), effects)
    along = min((it for it in seen.sites if it.site.name == "along@1"), key=lambda it: it.site.parts)
    law = search.Law(seen, (along,), np.zeros(0), ())
    assert [*search.in_its_place(law)] == ["bar_length_mismatch"]
    assert not [*search.in_its_place(law, constant=False)]


@pytest.mark.long
def test_a_law_takes_the_place_of_an_effect_that_it_holds() -> None:
    """The spring that a model starts with is no part of what friction leaves."""
    campaign = bench("joint_friction.torque_Nmm", 600.0)
    effects = effects_for(campaign)
    start = Model().with_effects([effects["joint_torsional_stiffness"]])
    found = discover(fitted_tests(campaign), start, effects)
    assert "joint_torsional_stiffness" in found.begin.model.names
    assert "joint_torsional_stiffness" not in found.end.model.names and found.whole
    assert [law.site.name for law in found.laws] == ["hinge_torque"]


def test_a_place_that_one_test_alone_speaks_for_does_not_hide_the_next(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Sites within what is not told apart: those at which a function stands without its best test come first."""
    seen = map_of("joint_friction.torque_Nmm", 600.0)
    one, two = (next(it for it in seen.sites if it.site.name == name) for name in ("base_x", "along"))
    near = replace(seen, sites=(_valued(one, 19.0), _valued(two, 17.0)))
    for good, first in (("along", "along"), ("base_x", "base_x"), ("", None)):

        def gained(_: object, it: Evidence, good: str = good) -> tuple[Array, bool]:
            here = next(each.site.name for each in near.sites if each.evidence is it)
            return np.full(3, float(len(here))), here == good

        monkeypatch.setattr(search, "_gained_at", gained)
        group, gains = search._proposed(near)
        assert [it.site.name for it in group] == ([] if first is None else [first, _other(first)])
        assert gains.tolist() == ([] if first is None else [float(len(first))] * 3)


def _valued(it: Located, value: float) -> Located:
    return replace(it, evidence=replace(it.evidence, value=value))


def _other(name: str) -> str:
    return {"along": "base_x", "base_x": "along"}[name]
