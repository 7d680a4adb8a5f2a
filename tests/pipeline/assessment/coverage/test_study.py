"""The study goes on where it was stopped, and its page counts what it was given."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from pipeline.assessment.coverage import __main__ as module
from pipeline.assessment.coverage.__main__ import run, tasks
from pipeline.assessment.coverage.table import joined, page, study
from pipeline.assessment.coverage.trial import Trial
from pipeline.assessment.trials import kept


def one(seed: int, deviation: float | None, steps: int = 8, **more: object) -> Trial:
    values = {
        "kind": "there",
        "effects": ("modulus_error",),
        "seed": seed,
        "steps": steps,
        "residuals": 900,
        "degrees": 900,
        "chi_square": 900.0,
        "holdout": (1.0, 1.2),
        "deviations": {"modulus_error.scale": deviation},
        "symmetric": {"modulus_error.scale": deviation},
        "lost": 0,
        "seconds": 1.0,
        "commit": "x",
    }
    return Trial.model_validate(values | more)


def test_shares_are_counted() -> None:
    """Seven benches of two kinds, each number by hand; a parameter without an error bar counts as missed."""
    trials = [
        one(0, 0.5, steps=24),
        one(1, -1.95),
        one(2, 2.5),
        one(3, -3.5, symmetric={"modulus_error.scale": -2.0}),
        one(4, None, chi_square=1200.0),
    ]
    without = {"kind": "absent", "deviations": {}, "symmetric": {}}
    absent = [one(k, None, **without, inside={"modulus_error.scale": k == 0}) for k in (0, 1)]
    (row,) = study([*trials, *absent]).rows
    assert (row.within_1_96.count, row.within_1_96.of) == (2, 5)
    assert (row.within_3.count, row.within_3.of) == (3, 5)
    assert (row.noise.count, row.size.count, row.noise.of) == (4, 4, 5)
    assert (row.holdout.count, row.holdout.of) == (1, 2)
    assert (row.null_inside.count, row.null_inside.of) == (1, 2)
    assert (row.symmetric.count, row.symmetric.of) == (4, 5)
    assert [(it.seed, it.deviation) for it in row.beyond] == [(3, -3.5), (4, None)]
    text = page(study(trials))
    assert "errors: modulus_error.scale -3.5, without a standard error." in text
    assert "of a parabola instead: modulus_error 80.0 % of 5." in text
    assert "| modulus_error | 1.000 .. 1.155 | 80.0 % of 5 |" in text and text.startswith("# How often")


def test_rows_of_more_benches_stay() -> None:
    """A page grows effect by effect: what it has of more benches is not replaced, what it lacks is added."""
    fewer, more = study([one(0, 0.5)]), study([one(0, 0.5), one(1, 0.1)])
    other = study([one(0, 0.5, effects=("self_weight",))])
    assert joined(fewer, more) == joined(more, fewer) == more
    assert [row.effects for row in joined(other, more).rows] == [("modulus_error",), ("self_weight",)]
    again = study([one(0, 9.0)])
    assert joined(again, fewer) == again


def test_a_study_goes_on_where_it_was_stopped(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """What is in the store is not made again, and a line that was cut off is."""
    store = tmp_path / "deep" / "trials.jsonl"
    asked: list[int] = []

    def done(*task: Any) -> Trial:
        asked.append(task[2])
        return one(task[2], 0.0, steps=task[3])

    monkeypatch.setattr(module, "trial", done)
    wanted = [task for task in tasks(3, 0, ["modulus_error"]) if task[0] == "there"]
    assert [task[3] for task in wanted] == [24, 8, 8]
    assert len(list(run(wanted[:2], store, 1))) == 2
    store.write_text(store.read_text() + '{"kind": "there", "eff')
    with store.open("a") as file:
        file.write("\n")
    assert len(list(run(wanted, store, 1))) == 3 and asked == [0, 1, 2]
    assert [each.seed for each in kept(store, Trial)] == [0, 1, 2]
