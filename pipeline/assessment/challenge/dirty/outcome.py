"""One dirty case, measured, diagnosed and judged: the names, what was found of the noise, and bad readings."""

from __future__ import annotations

from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fem.frame.bench import Readings
from pipeline.answer.of_diagnosis import answer_of
from pipeline.assessment.challenge.cases import ALWAYS
from pipeline.assessment.challenge.dirty.cases import DirtyCase, dirty_case
from pipeline.assessment.challenge.dirty.dirt import Knock, read_dirty, true_rig
from pipeline.assessment.challenge.dirty.judged import Score, judged
from pipeline.assessment.challenge.dirty.shown import shown
from pipeline.assessment.challenge.dirty.sizes import sizes_after_tolerances
from pipeline.assessment.challenge.outcome import Answered, begun, borne, held_out
from pipeline.campaign import Campaign
from pipeline.inference.model import Model
from pipeline.parameter_names import parted
from pipeline.selection.diagnosis import Diagnosis, diagnose
from vjm.effects import catalogue

Array = NDArray[np.float64]


class DirtyOutcome(Answered):
    """A case and its score. sizes: mu after tolerances, of each hidden effect; gamma: after them too. knocked: bad
    readings that were made, and found among them; shown: the same of those that show; and good ones that were set
    aside, of so many readings. declared: by what declared sigmas are off, and whether that was found. certain: what
    was told so. inside: whether the 95 % interval holds the truth, of sizes of right answers."""

    dirt: dict[str, float]
    certain: tuple[str, ...] = ()
    score: Score = "failed"
    knocked: int = 0
    knocked_found: int = 0
    shown: int = 0
    shown_found: int = 0
    good_aside: int = 0
    readings: int = 0
    declared_found: bool | None = None

    @property
    def hidden_names(self) -> tuple[str, ...]:
        """Names of what is hidden."""
        return tuple(dict.fromkeys(parted(path)[0] for path in self.hidden))


def dirty_outcome(number: int, commit: str, code: str) -> DirtyOutcome:
    """The outcome of the case of that number; one whose bench finds no state has no answer."""
    it = dirty_case(number)
    out = partial(begun(DirtyOutcome, it, commit, code), dirt=it.dirt.words)
    try:
        it, found, without = measured(number)
    except RuntimeError as error:
        return out(error=f"bench: {error}")
    campaign, knocks = read_dirty(f"dirty case {number}", it.bench, it.dirt, found, it.seed)
    rows = sum(t.data.steps.size for t in campaign.tests)
    try:
        answer = diagnose(campaign, Model(), catalogue())
    except (RuntimeError, ArithmeticError, ValueError) as error:
        return out(rows=rows, error=str(error))
    sets = tuple(tuple(n for n in names if n != ALWAYS) for names in answer.possible)
    sure = tuple(n for n in answer.certain if n != ALWAYS)
    sizes, gamma = sizes_after_tolerances(it, found, without, answer.cache)
    score = judged(it, answer.verdict, sets, sure, bool(answer.doctor))
    return out(
        rows=rows,
        sizes=sizes,
        gamma=gamma,
        verdict=answer.verdict,
        sets=sets,
        certain=sure,
        score=score,
        **_of_readings(it, campaign, answer, knocks),
        inside=_inside(it, answer) if score == "right" and it.hidden else {},
        holdout=held_out(answer),
    )


def measured(number: int) -> tuple[DirtyCase, list[Readings], list[Readings]]:
    """The case with loads that its bench bears, and exact readings of the true rig with and without what is hidden."""
    return borne(partial(dirty_case, number), lambda it: true_rig(it.bench.rig, it.dirt.bar))


def _of_readings(
    it: DirtyCase, campaign: Campaign, answer: Diagnosis, knocks: tuple[Knock, ...]
) -> dict[str, Any]:
    record = answer_of(answer)
    tests = {test.id: k for k, test in enumerate(it.bench.plan)}
    columns = answer.cache.whole.rows.columns
    # One that may be another of its step is found where either was knocked.
    aside = {
        frozenset((tests[a.test], int(a.step), columns.index(name)) for name in (a.column, *a.instead))
        for a in record.set_aside
    }
    # Of those that a model predicts or that control it, in tests that may be fitted.
    fitted = [k for k in knocks if not it.bench.plan[k.test].holdout]
    made = {(k.test, k.row, k.channel) for k in fitted}
    seen = {(k.test, k.row, k.channel) for k in shown(campaign, fitted)}
    off = np.flatnonzero(it.dirt.declared != 1.0)
    told = {columns.index(n.column): n.found / n.declared for n in record.noise if n.column in columns}
    ratios = [told[k] * float(it.dirt.declared[k]) for k in off.tolist() if k in told]
    return {
        "knocked": len(made),
        "readings": int(np.isfinite(answer.cache.whole.measured[answer.cache.whole.fitted]).sum())
        + len(aside),
        "knocked_found": sum(bool(cells & made) for cells in aside),
        "shown": len(seen),
        "shown_found": sum(bool(cells & seen) for cells in aside),
        "good_aside": sum(not cells & {(k.test, k.row, k.channel) for k in knocks} for cells in aside),
        "declared_found": bool(ratios) and all(1 / 1.5 < r < 1.5 for r in ratios) if off.size else None,
    }


def _inside(it: DirtyCase, answer: Diagnosis) -> dict[str, bool]:
    record, out = answer_of(answer), {}
    for path, truth in it.hidden.items():
        value = record.parameters.get(path)
        if value is not None and value.low95 is not None and value.high95 is not None:
            out[path] = bool(value.low95 <= truth <= value.high95)
    return out
