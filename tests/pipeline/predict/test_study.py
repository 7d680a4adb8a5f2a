"""The study of the intervals: it counts what it should, its kept page is as wanted, a case of it comes out again."""

from __future__ import annotations

import pytest

from pipeline.predict.study.__main__ import OUT, STORE
from pipeline.predict.study.table import HIGH, LEAST, LOW, Study, page, study
from pipeline.predict.study.trial import Counts, Trial, trial
from pipeline.trials import kept
from tests.conftest import ROOT

NUMBER = 10
"""A case of one effect on a bench of few tests: load_misalignment."""


def made_up(number: int, inside: int, named: bool = True, true: bool = True) -> Trial:
    """A case of which so many of a hundred readings at 1.5 times the loads lie inside, and half as many of fifty."""
    return Trial(
        number=number,
        kind="single",
        plan="few",
        share=1.0,
        hidden={},
        named=named,
        true=true,
        held=Counts(inside={"x_mm": inside // 2}, of={"x_mm": 50}),
        far=Counts(inside={"x_mm": inside - 40, "fy_N": 40}, of={"x_mm": 60, "fy_N": 40}),
        seconds=1.0,
        commit="c",
    )


def test_readings_are_counted_over_named_cases_and_the_worst_is_told() -> None:
    it = study([made_up(1, 96), made_up(4, 80), made_up(5, 90, true=False), made_up(7, 10, named=False)])
    assert (it.cases, it.named, it.true) == (4, 3, 2)
    assert (it.far.inside.count, it.far.inside.of) == (266, 300) and it.far.case == 4
    assert it.far.least == pytest.approx(0.8) and it.far.below == (4,)
    assert (it.true_far.inside.count, it.true_far.inside.of) == (176, 200)
    assert (it.far.columns["fy_N"].count, it.far.columns["fy_N"].of) == (120, 120)
    text = page(it)
    assert "| 1.5 times the loads | 88.7 % of 300 | 80.0 % (case 4) | 4 |" in text
    assert max(map(len, text.splitlines())) <= 120


def test_a_study_that_names_nothing_has_no_page() -> None:
    with pytest.raises(ValueError, match="at least one is needed"):
        study([made_up(1, 96, named=False)])


def test_the_kept_study_is_that_of_its_trials_and_as_wanted() -> None:
    """93 to 97 % of all readings together, at the fitted loads and at 1.5 times them, no case under 85 %."""
    found = Study.model_validate_json((ROOT / OUT / "predict.json").read_text(encoding="utf-8"))
    assert found == study(kept(ROOT / STORE, Trial))
    assert (ROOT / OUT / "predict.md").read_text(encoding="utf-8") == page(found)
    assert found.named >= 20
    for part in (found.held, found.far):
        assert LOW <= part.inside.count / part.inside.of <= HIGH
        assert part.least >= LEAST and not part.below


@pytest.mark.long
def test_a_case_of_the_study_comes_out_again() -> None:
    (before,) = (it for it in kept(ROOT / STORE, Trial) if it.number == NUMBER)
    again = trial(NUMBER, "now")
    assert (again.verdict, again.sets) == (before.verdict, before.sets)
    assert again.held.of == before.held.of and again.far.of == before.far.of
    for now, then in ((again.held, before.held), (again.far, before.far)):
        assert abs(now.total[0] - then.total[0]) <= 0.01 * then.total[1]
