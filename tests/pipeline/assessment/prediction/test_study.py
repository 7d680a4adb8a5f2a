"""The study of the intervals: it counts what it should, its kept page is as wanted, a case of it comes out again."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from fem.beam import uniform_stiffness
from pipeline.assessment.challenge.benches import drawn_rig
from pipeline.assessment.prediction.__main__ import NAMES, OUT, STORES
from pipeline.assessment.prediction.off import drawn_off, scaled
from pipeline.assessment.prediction.table import HIGH, LEAST, LOW, Study, page, study
from pipeline.assessment.prediction.trial import Counts, Trial, trial
from pipeline.assessment.trials import kept
from pipeline.assessment.virtual.plan import bench_plan
from pipeline.campaign import ParallelogramRig
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
    assert found == study(kept(ROOT / OUT / STORES[False], Trial))
    assert (ROOT / OUT / "predict.md").read_text(encoding="utf-8") == page(found)
    assert found.named >= 20
    for part in (found.held, found.far):
        assert LOW <= part.inside.count / part.inside.of <= HIGH
        assert part.least >= LEAST and not part.below


def test_the_kept_study_with_tolerances_is_that_of_its_trials() -> None:
    found = Study.model_validate_json((ROOT / OUT / f"{NAMES[True]}.json").read_text(encoding="utf-8"))
    assert found == study(kept(ROOT / OUT / STORES[True], Trial))
    text = (ROOT / OUT / f"{NAMES[True]}.md").read_text(encoding="utf-8")
    assert text == page(found, tolerances=True) and "drawn from them" in text and "--tolerances" in text
    assert max(map(len, text.splitlines())) <= 120


def test_a_bench_is_off_by_what_its_tolerances_say_and_nothing_else() -> None:
    """Over many cases: no bias, one standard deviation; the same number is the same bench; a 6x6 is scaled as the
    uniform bar that it is the 6x6 of."""
    rig = drawn_rig(np.random.default_rng(1))
    assert rig.bar is not None
    off = [drawn_off(rig, number) for number in range(400)]
    usual = rig.usual_tolerance
    for key, values, written in (
        ("EA", [it.rig.bar.EA / rig.bar.EA for it in off], 1.0),
        ("EIy", [it.rig.bar.EIy / rig.bar.EIy for it in off], 1.0),
        ("length_mm", [it.rig.length for it in off], rig.length),
        ("width_mm", [it.rig.width for it in off], rig.width),
        ("q_mrad", [1e3 * it.angle for it in off], 0.0),
    ):
        assert np.std(values) == pytest.approx(usual[key], rel=0.15), key
        assert abs(np.mean(values) - written) < 4.0 * usual[key] / np.sqrt(len(off)), key
    again = drawn_off(rig, 3)
    assert (again.rig.bar, again.rig.length, again.angle) == (off[3].rig.bar, off[3].rig.length, off[3].angle)
    (moved,) = off[3].plan(bench_plan(8)[:1])
    assert np.radians(moved.q_deg - bench_plan(8)[0].q_deg) == pytest.approx(off[3].angle)
    factors = {"EA": 1.1, "EIy": 0.9, "EIz": 1.3, "GJ": 0.8}
    b = rig.bar
    wanted = uniform_stiffness(rig.length, 1.1 * b.EA, 0.9 * b.EIy, 1.3 * b.EIz, 0.8 * b.GJ)
    np.testing.assert_allclose(scaled(rig.stiffness, factors), wanted, atol=1e-9 * wanted.max())
    written = replace(rig, bar=None, bar_stiffness=rig.stiffness)
    as_matrix = drawn_off(written, 3).rig
    np.testing.assert_allclose(
        as_matrix.stiffness, scaled(rig.stiffness, _factors(off[3].rig, rig)), rtol=1e-9, atol=1e-6
    )


def _factors(there: ParallelogramRig, written: ParallelogramRig) -> dict[str, float]:
    """What the stiffnesses of the section are scaled by."""
    assert there.bar is not None and written.bar is not None
    return {key: getattr(there.bar, key) / getattr(written.bar, key) for key in ("EA", "EIy", "EIz", "GJ")}


@pytest.mark.long
def test_a_case_of_the_study_comes_out_again() -> None:
    (before,) = (it for it in kept(ROOT / OUT / STORES[False], Trial) if it.number == NUMBER)
    again = trial(NUMBER, "now")
    assert (again.verdict, again.sets) == (before.verdict, before.sets)
    assert again.held.of == before.held.of and again.far.of == before.far.of
    for now, then in ((again.held, before.held), (again.far, before.far)):
        assert abs(now.total[0] - then.total[0]) <= 0.01 * then.total[1]
