"""One whole case; a study goes on where it was stopped; its page says what fixed records say."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scipy.stats import binom

from pipeline.assessment.challenge.cases import ALWAYS, ROUND
from pipeline.assessment.extrapolation.__main__ import STUDY
from pipeline.assessment.extrapolation.approaches import APPROACHES, DIAGNOSIS, GAUSSIAN, PLAIN
from pipeline.assessment.extrapolation.bench import measured
from pipeline.assessment.extrapolation.cases import numbers
from pipeline.assessment.extrapolation.page import page
from pipeline.assessment.extrapolation.table import median_interval, study
from pipeline.assessment.extrapolation.trial import BENCH, Trial, trial
from pipeline.assessment.extrapolation.yardstick import Error
from pipeline.assessment.trials import kept
from tests.pipeline.assessment.challenge.small import first
from vjm.effects import catalogue

SMALL = first("single", "modulus_error", 0.02)
"""A few tests of few steps on bars of another modulus."""


def fixed(
    number: int, gaussian: float, diagnosis: float, verdict: str = "identified", **more: object
) -> Trial:
    def error(outside: float) -> Error:
        return Error(inside=0.5 * outside, outside=outside, lost=0)

    values = {
        "number": number,
        "kind": "single",
        "plan": "rich",
        "share": 1.0,
        "hidden": {"modulus_error.scale": 1.1},
        "sizes": {"modulus_error": 40.0, "load_offset": 7.0},
        "verdict": verdict,
        "sets": (("modulus_error",),),
        "selected": (),
        "errors": {PLAIN: error(500.0), GAUSSIAN: error(gaussian), DIAGNOSIS: error(diagnosis)},
        "seconds": {PLAIN: 0.1, GAUSSIAN: 2.0, DIAGNOSIS: 9.0},
        "failed": {},
        "commit": "abc",
        "code": "x",
    }
    return Trial.model_validate(values | more)


def test_the_first_cases_that_hide_effects() -> None:
    assert numbers(6) == [1, 2, 5, 6, 9, 10]
    assert {ROUND[n % len(ROUND)] for n in numbers(300)} == {"single", "pair"}


@pytest.mark.long
def test_a_whole_case_runs_and_is_not_run_again(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    store = tmp_path / "deep" / "trials.jsonl"
    done: list[Trial] = []
    few = {name: catalogue()[name] for name in (ALWAYS, "modulus_error", "load_offset")}

    def one(number: int, commit: str, code: str) -> Trial:
        again = done[0].model_copy(update={"code": code}) if done else trial(number, commit, code, known=few)
        done.append(again)
        return done[-1]

    whole = replace(STUDY, trial=one, tasks=lambda _: [(SMALL,)])
    (begun,) = whole.run(1, 1, store, tmp_path)
    (again,) = whole.run(1, 1, store, tmp_path)
    assert begun == again and done == [begun] and kept(store, Trial) == [begun]
    assert (
        set(begun.errors) == set(APPROACHES)
        and begun.kind == "single"
        and begun.mu == pytest.approx(31.01, rel=0.01)
    )
    assert begun.sets == (("modulus_error",),)
    assert begun.errors[DIAGNOSIS].outside < begun.errors[GAUSSIAN].outside
    monkeypatch.setattr("pipeline.assessment.study.code_digest", lambda: "another")
    (other,) = whole.run(1, 1, store, tmp_path)
    assert len(done) == 2 and other.code == "another"


def test_a_bench_that_bears_no_load_is_said(monkeypatch: pytest.MonkeyPatch) -> None:
    def breaks(*_: object) -> None:
        raise RuntimeError("the bench has buckled")

    monkeypatch.setattr("pipeline.assessment.extrapolation.bench.true_readings", breaks)
    it = trial(SMALL, "", "")
    assert "buckled" in it.failed[BENCH] and not it.errors
    assert f"case {SMALL}, bench: case {SMALL} at 0.35 of its loads: the bench has buckled" in page(
        study([it])
    )


def test_a_bench_that_does_not_bear_all_is_loaded_less(monkeypatch: pytest.MonkeyPatch) -> None:
    from pipeline.assessment.extrapolation import bench

    plain = bench.true_readings
    whole = measured(SMALL)
    borne = 0.6 * max(np.abs(t.data.wrench[:, 0]).max() for t in whole.asked.campaign.tests)

    def weak(rig: object, plan: tuple[object, ...], *more: object) -> object:
        if max(np.abs(test.values[:, 0]).max() for test in plan) > borne:  # type: ignore[attr-defined]
            raise RuntimeError("the bench has buckled")
        return plain(rig, plan, *more)  # type: ignore[arg-type]

    monkeypatch.setattr(bench, "true_readings", weak)
    less = measured(SMALL)
    most = max(np.abs(t.data.wrench[:, 0]).max() for t in less.asked.campaign.tests)
    assert whole.share == 1.0 and less.share < 1.0 and most <= borne


def test_the_page_says_what_the_records_say() -> None:
    """Seven cases by hand: ratios 2 .. 7 and one half; one of them ambiguous, one identified without a name."""
    every = [fixed(k, 0.1 * k, 0.1) for k in range(2, 7)]
    every += [
        fixed(7, 0.7, 0.1, sets=((),)),
        fixed(8, 0.1, 0.2, verdict="ambiguous", failed={"forward AIC": "why"}),
    ]
    it = study(every)
    whole, identified, named = it.groups
    assert (whole.cases, identified.cases, named.cases) == (7, 6, 5)
    assert whole.ratio is not None and (whole.ratio.median, whole.ratio.worse.count) == (
        pytest.approx(4.0),
        1,
    )
    assert (whole.ratio.low, whole.ratio.high) == (pytest.approx(0.5), pytest.approx(7.0))
    assert named.ratio is not None and named.ratio.low is None
    row = next(r for r in whole.rows if r.approach == GAUSSIAN)
    assert (row.outside, row.inside) == (pytest.approx(0.4), pytest.approx(0.2))
    # 0.1 0.2 0.3 0.4 0.5 0.6 0.7: nine tenths of the way lie between the last two.
    assert row.outside_90 == pytest.approx(0.64)
    text = page(it)
    assert (
        "| approach | all: inside | outside | identified: inside | outside | named: inside | outside |"
        in text
    )
    assert (
        "| Gaussian process | 0.200 0.320 | 0.400 0.640 | 0.225 0.325 | 0.450 0.650 | 0.200 0.280 | 0.4"
        in text
    )
    assert "| Gaussian process | 7 | 0 | 2.0 |" in text and "| forward AIC | – | – | – | – | – | – |" in text
    assert "| all | 7 | 4.00 (0.500 .. 7.00) | 14.3 % (0.4 .. 57.9) of 7 |" in text
    assert "| named | 5 | 4.00 (–) | 0.0 % (0.0 .. 52.2) of 5 |" in text
    assert "case 8, forward AIC: why" in text and "Code: abc." in text
    assert max(map(len, text.splitlines())) <= 120


@pytest.mark.parametrize("count", [6, 20, 101])
def test_the_interval_of_a_median_holds_it_as_often_as_it_says(count: int) -> None:
    """The interval from rank k to count + 1 - k misses with twice P(B < k); one rank more would miss too often."""
    low, high = median_interval(np.arange(1.0, count + 1.0))
    assert low is not None and high == count + 1 - low
    assert 2.0 * binom.cdf(low - 1, count, 0.5) <= 0.05 < 2.0 * binom.cdf(low, count, 0.5)
    assert median_interval(np.arange(5.0)) == (None, None)


def test_a_study_that_is_stopped_leaves_its_page(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def stopped(*_: object):  # type: ignore[no-untyped-def]
        yield fixed(2, 0.4, 0.1)
        raise KeyboardInterrupt

    monkeypatch.setattr("pipeline.assessment.trials.run", stopped)
    with pytest.raises(KeyboardInterrupt):
        STUDY.run(3, 1, tmp_path / "store", tmp_path)
    assert "## 1 cases" in (tmp_path / "extrapolation.md").read_text()
    assert '"cases": 1' in (tmp_path / "extrapolation.json").read_text()
    assert (tmp_path / "extrapolation.png").read_bytes().startswith(b"\x89PNG")
