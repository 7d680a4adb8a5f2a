"""One case of the challenge: measured, diagnosed, and where an effect is named, its held-out readings predicted."""

from __future__ import annotations

from dataclasses import dataclass, replace
from time import process_time
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pipeline.assessment.challenge.cases import ALWAYS, Case, case
from pipeline.assessment.challenge.outcome import SHARES
from pipeline.assessment.extrapolation.bench import beyond
from pipeline.assessment.prediction.off import Off, drawn_off
from pipeline.assessment.virtual.bench import read_out, true_readings
from pipeline.assessment.virtual.plan import GAUGES
from pipeline.campaign import Campaign, Test
from pipeline.campaign.names import channel_columns
from pipeline.inference.model import Model
from pipeline.predict.asked import Asked
from pipeline.predict.predicting import Fitted, Predicted, fitted_as, predicted
from pipeline.record import Record
from pipeline.selection.diagnosis import Diagnosis, diagnose
from vjm.effects import catalogue

Mask = NDArray[np.bool_]


class Counts(Record):
    """Readings by column: how many lie inside their 95 % interval, of how many."""

    inside: dict[str, int] = {}  # noqa: RUF012 (pydantic copies it)
    of: dict[str, int] = {}  # noqa: RUF012

    @property
    def total(self) -> tuple[int, int]:
        """Over all columns."""
        return sum(self.inside.values()), sum(self.of.values())

    @property
    def share(self) -> float | None:
        """Inside over all; None without any."""
        inside, of = self.total
        return inside / of if of else None


class Trial(Record):
    """A case. share: of the loads, that the bench bears even 1.5 times. sets: of the verdict, without what every bench
    has. named: whether one set with an effect was identified; only then anything is predicted. true: whether that is
    what was hidden. held: tests that were held out, at about the fitted loads; far: the fitted tests at 1.5 times.
    sampled: rows
    whose intervals are by samples. lost: rows without a prediction. failed: why there is none. commit: of the code."""

    number: int
    kind: str
    plan: str
    share: float
    hidden: dict[str, float]
    verdict: str = ""
    sets: tuple[tuple[str, ...], ...] = ()
    named: bool = False
    true: bool = False
    sampled: int = 0
    factor: float = 1.0
    held: Counts = Counts()
    far: Counts = Counts()
    lost: int = 0
    failed: str = ""
    seconds: float
    commit: str


@dataclass(frozen=True, eq=False)
class Measured:
    """campaign: fitted and held-out tests with noise. far: the fitted tests at 1.5 times their loads, with noise."""

    case: Case
    share: float
    campaign: Campaign
    far: tuple[Test, ...]


def measured(number: int, tolerances: bool = False) -> Measured:
    """The case of that number, with its bench drawn off what is written and default tolerances if `tolerances`.

    RuntimeError where it bears no share of 1.5 times the loads."""
    last = RuntimeError("no share of the loads")
    for share in SHARES:
        it = case(number, share)
        plan = it.bench.plan
        far = tuple(beyond(test) for test in plan if not test.holdout)
        there = drawn_off(it.bench.rig, number) if tolerances else Off(it.bench.rig, 0.0)
        try:
            found = true_readings(there.rig, there.plan((*plan, *far)), it.hidden, GAUGES)
        except RuntimeError as error:
            last = error
            continue
        every = read_out(
            f"case {number}", it.bench.rig, (*plan, *far), it.bench.noise, it.seed, found, GAUGES
        )
        known = it.bench.rig.usual_tolerance if tolerances else every.tolerance
        campaign = replace(every, tests=every.tests[: len(plan)], tolerance=known)
        return Measured(
            it, share, campaign, tuple(replace(t, role="holdout") for t in every.tests[len(plan) :])
        )
    raise RuntimeError(f"case {number} at {SHARES[-1]:g} of its loads: {last}")


def trial(number: int, commit: str, tolerances: bool = False) -> Trial:
    """The case of that number; tolerances as in `measured`."""
    began = process_time()
    whole = case(number)
    out = Trial(
        number=number,
        kind=whole.kind,
        plan=whole.bench.label,
        share=0.0,
        hidden=dict(whole.hidden),
        seconds=0.0,
        commit=commit,
    )
    try:
        it = measured(number, tolerances)
        out = judged(it, out)
    except (RuntimeError, ArithmeticError, ValueError) as error:
        out = out.model_copy(update={"failed": f"{type(error).__name__}: {error}"})
    return out.model_copy(update={"seconds": round(process_time() - began, 2)})


def judged(it: Measured, out: Trial) -> Trial:
    """The trial with its verdict, and with what lies inside where that names something."""
    found = diagnose(it.campaign, Model(), catalogue())
    sets = tuple(tuple(name for name in names if name != ALWAYS) for names in found.sets)
    named = found.verdict == "identified" and any(sets)
    said: dict[str, Any] = {"share": it.share, "verdict": found.verdict, "sets": sets, "named": named}
    if not named:
        return out.model_copy(update=said)
    bands = predicted(_fitted(found), _asked(it), seed=it.case.number)
    held, far = _rows(bands, it)
    said |= {
        "true": set(sets[0]) == set(it.case.effects),
        "sampled": int(bands.bands.sampled.sum()),
        "factor": bands.fitted.factor,
        "held": counts(bands, held),
        "far": counts(bands, far),
        "lost": int(bands.bands.lost.sum()),
    }
    return out.model_copy(update=said)


def _fitted(found: Diagnosis) -> Fitted:
    whole = found.campaign if found.given is None else found.given
    return fitted_as(found.fit, whole, found.readings)


def _asked(it: Measured) -> Asked:
    held = tuple(test for test in it.campaign.tests if test.role == "holdout")
    return Asked((*held, *it.far), True, {})


def _rows(found: Predicted, it: Measured) -> tuple[Mask, Mask]:
    """(R,) of the held-out tests, and of those at 1.5 times the loads."""
    far = {test.id for test in it.far}
    beyond_fit = np.array([test.id in far for test in found.asked.tests])[found.cases.test]
    return ~beyond_fit, beyond_fit


def counts(found: Predicted, rows: Mask) -> Counts:
    """Readings of these rows (R,), by column."""
    columns = channel_columns(found.cases.campaign.gauges)
    judged_there = found.judged & rows[:, None]
    inside = found.inside & judged_there
    there = np.flatnonzero(judged_there.any(axis=0)).tolist()
    return Counts(
        inside={columns[k]: int(inside[:, k].sum()) for k in there},
        of={columns[k]: int(judged_there[:, k].sum()) for k in there},
    )
