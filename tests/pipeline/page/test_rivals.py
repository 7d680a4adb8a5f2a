"""A page of a diagnosis shows the very numbers of its verdict, for every set that the verdict leaves possible."""

from __future__ import annotations

from functools import cache

import pytest

from pipeline.answer.of_diagnosis import answered
from pipeline.campaign import Campaign
from pipeline.inference.model import Model
from pipeline.inference.suitable import Known, known_effects
from pipeline.page.collect import Subject, collect
from pipeline.page.command import of_diagnosis
from pipeline.page.record import Page
from pipeline.page.rivals import possible
from pipeline.selection.diagnosis import diagnose
from tests.pipeline.selection.bench import AXIAL, bench
from tests.pipeline.selection.test_reading_noise import knocked, plain

FEW = ("bar_geometric_nonlinearity", "modulus_error", "axis_flexibility", "base_compliance")


@cache
def subject(campaign: Campaign) -> Subject:
    whole = known_effects()
    known = Known({name: whole.effects[name] for name in FEW}, {})
    begin = Subject(campaign, Model(), known, {})
    found = diagnose(campaign, Model(), known.effects)
    return of_diagnosis(begin, found, possible(found, answered(found)))


def page(campaign: Campaign) -> Page:
    return collect(subject(campaign))


@cache
def off() -> Campaign:
    return knocked(plain())


@pytest.mark.long
def test_rivals_stand_side_by_side_with_their_own_numbers() -> None:
    it = page(bench("axis_flexibility.radial_mm_per_N", 3e-6, AXIAL))
    assert it.verdict == "ambiguous" and len(it.rivals) >= 2
    assert [rival.effects for rival in it.rivals] == [it.effects, *it.alternatives][: len(it.rivals)]
    for rival in it.rivals:
        assert {name.rpartition(".")[0] for name in rival.parameters} == set(rival.effects)
        assert rival.error.effects == rival.effects and rival.error.fit < 1.1
        assert all(name in it.titles for name in rival.effects)
    # The numbers are each set's own, not those of the first.
    assert it.rivals[0].parameters == it.parameters != it.rivals[1].parameters


@pytest.mark.long
def test_headline_and_pictures_are_of_the_same_readings() -> None:
    """A reading that was set aside for the verdict is not in the error of the page either; it is named."""
    it, answer = page(off()), subject(off()).answer
    assert answer is not None and it.set_aside == answer.set_aside != ()
    assert it.error[-1].fit == pytest.approx(answer.error[-1].fit, rel=1e-3)
    assert it.error[0].fit == pytest.approx(answer.error[0].fit, rel=1e-2)
    assert all(sigma.given for sigma in it.sigmas)
    # With that reading in it the page would say more.
    found = subject(off())
    other = collect(Subject(off(), found.model, found.known, {}, answer))
    assert other.error[-1].fit > 1.2 * it.error[-1].fit


def test_a_page_of_before_reads_as_it_did() -> None:
    """A record without what is new is one where nothing of it was found."""
    it = collect(Subject(plain(), Model(), known_effects(), {}))
    new = {"titles", "certain", "alternatives", "rivals", "zeros", "laws", "not_done"}
    old = Page.model_validate(it.model_dump(exclude=new))
    assert old.rivals == () and old.laws == () and old.error == it.error
