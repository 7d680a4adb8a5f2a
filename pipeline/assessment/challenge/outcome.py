"""One case, measured, diagnosed and judged against what was hidden."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import partial
from time import process_time
from typing import Any, Literal, TypeVar

import numpy as np
from numpy.typing import NDArray

from fem.frame.bench import Readings
from pipeline.assessment.challenge.cases import ALWAYS, Case, case
from pipeline.assessment.challenge.faults import FAULTS
from pipeline.assessment.coverage.cases import is_size
from pipeline.assessment.study import Tried
from pipeline.assessment.virtual.bench import read_out, true_readings
from pipeline.assessment.virtual.plan import GAUGES
from pipeline.campaign import Campaign, ParallelogramRig
from pipeline.campaign.order import by_name
from pipeline.compare.error import Discrepancy
from pipeline.inference.intervals import intervals, profile_likelihood
from pipeline.inference.load_cases import LoadCases, load_cases
from pipeline.inference.model import Model
from pipeline.inference.predicted import Prediction
from pipeline.inference.prediction import predict
from pipeline.inference.residual import Whitening, whitening
from pipeline.parameter_names import parted
from pipeline.selection.confusability import multiple_correlation
from pipeline.selection.diagnosis import Diagnosis, diagnose
from pipeline.selection.fit_cache import FitCache
from vjm.effects import catalogue
from vjm.work import TooMuch

Array = NDArray[np.float64]
AnyCase = TypeVar("AnyCase", bound=Case)
Score = Literal["right", "in set", "part", "missed", "undecided", "wrong", "false alarm", "failed"]
"""right: exactly what was hidden, or that nothing was, or that nothing known explains it. in set: one of the sets is
right. part: some of it, and nothing else. missed: nothing was named where something was hidden. undecided: unknown
where the catalogue explains it; a set without the truth that is not false; ambiguous where nothing known explains it.
wrong: a name of what was not there. false alarm: one where nothing was hidden. failed: no answer."""
SHARES = (1.0, 0.7, 0.5, 0.35)
"""Of the loads, tried in turn where a bench does not bear them."""


class Answered(Tried):
    """A case and its answer. sizes: mu, sigmas by which each hidden effect shows. gamma: 1 / sqrt(1 - rho), by effect,
    of the rival that looks most like it. sets: the answer, without what every bench has. inside: whether the 95 %
    intervals hold the truth, of right answers. holdout: whitened RMS of each held-out test."""

    number: int
    kind: str
    plan: str
    hidden: dict[str, float]
    fault: tuple[str, float] | None
    rows: int = 0
    sizes: dict[str, float] = {}  # noqa: RUF012 (pydantic copies it)
    gamma: dict[str, float] = {}  # noqa: RUF012
    verdict: str = ""
    sets: tuple[tuple[str, ...], ...] = ()
    inside: dict[str, bool] = {}  # noqa: RUF012
    holdout: tuple[float, ...] = ()
    error: str = ""
    seconds: float

    @property
    def size(self) -> float:
        """The least of the effects' sizes, 0 where nothing is hidden."""
        return min(self.sizes.values(), default=0.0)

    @property
    def confusability(self) -> float:
        """The largest gamma, 1 where nothing is hidden."""
        return max(self.gamma.values(), default=1.0)


class Outcome(Answered):
    """A case of the clean programme and its score."""

    score: Score = "failed"


AnyOutcome = TypeVar("AnyOutcome", bound=Answered)


def begun(kind: type[AnyOutcome], it: Case, commit: str, code: str) -> Callable[..., AnyOutcome]:
    """What makes the outcome of a case of the rest of its fields, with the seconds of the processor from here to
    there."""
    began = process_time()
    head: dict[str, Any] = {"number": it.number, "kind": it.kind, "plan": it.bench.label, "fault": it.fault}
    head |= {"hidden": dict(it.hidden), "commit": commit, "code": code}
    return lambda **rest: kind(**head, **rest, seconds=round(process_time() - began, 2))


def outcome(number: int, commit: str, code: str) -> Outcome:
    """The outcome of the case of that number; one whose bench finds no state has no answer."""
    out = begun(Outcome, case(number), commit, code)
    try:
        it, found, without = measured(number)
    except RuntimeError as error:
        return out(error=f"bench: {error}")
    campaign = campaign_of(it, found, it.seed)
    sizes = {name: shows(it, only, without) for name, only in each_alone(it, found, it.bench.rig).items()}
    of_bench = {
        "rows": sum(t.data.steps.size for t in campaign.tests),
        "sizes": {name: float(np.linalg.norm(d)) for name, d in sizes.items()},
    }
    try:
        answer = diagnose(campaign, Model(), catalogue())
    except (RuntimeError, ArithmeticError, ValueError) as error:
        return out(**of_bench, error=str(error))
    sets = tuple(tuple(n for n in names if n != ALWAYS) for names in answer.possible)
    score = judged(it, answer.verdict, sets)
    return out(
        **of_bench,
        gamma=_confusable(answer.cache, it.effects, sizes),
        verdict=answer.verdict,
        sets=sets,
        score=score,
        inside=_inside(answer, it) if score == "right" and it.hidden else {},
        holdout=held_out(answer),
    )


def judged(it: Case, verdict: str, sets: Sequence[Sequence[str]]) -> Score:
    """The score of an answer; sets without what every bench has."""
    truth, named = set(it.effects), [set(names) for names in sets]
    if verdict == "unknown":
        return "right" if it.fault else "undecided"
    if it.kind == "clean":
        return of_nothing(named)
    if it.fault:
        if not any(named):
            return "missed"
        return "wrong" if len(named) == 1 else "undecided"
    return of_effects(named, truth)


def of_nothing(named: Sequence[set[str]]) -> Score:
    """Of sets that are named where nothing is hidden."""
    return "right" if not any(named) else "false alarm" if all(named) else "in set"


def of_effects(named: Sequence[set[str]], truth: set[str]) -> Score:
    """Of sets that are named where effects are hidden."""
    if len(named) == 1:
        (only,) = named
        if only == truth:
            return "right"
        return "wrong" if only - truth else "part" if only else "missed"
    if truth in named:
        return "in set"
    return "part" if any(names <= truth for names in named) else "wrong"


def measured(number: int) -> tuple[Case, list[Readings], list[Readings]]:
    """The case with loads that its bench bears, and its readings with and without what is hidden, both exact."""
    return borne(partial(case, number), lambda it: it.bench.rig)


def borne(
    make: Callable[[float], AnyCase], rig: Callable[[AnyCase], ParallelogramRig]
) -> tuple[AnyCase, list[Readings], list[Readings]]:
    """A case with the largest share of its loads that its true rig bears, and exact readings of that with and without
    what is hidden. RuntimeError where it bears none."""
    for share in SHARES:
        it = make(share)
        true, plan = rig(it), it.bench.plan
        try:
            without = true_readings(true, plan, {}, GAUGES)
            found = true_readings(true, plan, it.hidden, GAUGES) if it.hidden else without
            if it.fault:
                found = FAULTS[it.fault[0]](it.bench, found, it.fault[1])
            return it, found, without
        except RuntimeError as error:
            last = error
    raise RuntimeError(f"case {it.number} at {SHARES[-1]:g} of its loads: {last}")


def each_alone(it: Case, found: list[Readings], rig: ParallelogramRig) -> Mapping[str, list[Readings]]:
    """Readings of the true rig with each effect alone; the fault is one."""
    if it.fault:
        return {it.fault[0]: found}
    if len(it.effects) < 2:
        return dict.fromkeys(it.effects, found)
    alone = {}
    for name in it.effects:
        own = {path: value for path, value in it.hidden.items() if parted(path)[0] == name}
        try:
            alone[name] = true_readings(rig, it.bench.plan, own, GAUGES)
        except RuntimeError:
            # One that is borne only with the other: what it adds to that.
            alone[name] = found
    return alone


def campaign_of(it: Case, found: list[Readings], seed: int | None) -> Campaign:
    """The campaign that the case's sensors write of exact readings, its tests in the order of a diagnosis; seed: None
    for no noise."""
    bench = it.bench
    return by_name(read_out(f"case {it.number}", bench.rig, bench.plan, bench.noise, seed, found, GAUGES))


def shows(it: Case, found: list[Readings], without: list[Readings]) -> Array:
    """(N,) whitened difference of the fitted readings that are predicted, less what prescribed ones answer for."""
    cases, changed = (load_cases(campaign_of(it, readings, None)) for readings in (without, found))
    reference = predict(Model().with_effects([catalogue()[ALWAYS]]), cases, slopes=False)
    return difference(cases, changed, reference, whitening(cases, reference))


def difference(cases: LoadCases, changed: LoadCases, reference: Prediction, white: Whitening) -> Array:
    """(N,) the same of two programs of the same rows, about a prediction of the first."""
    change = changed.measured - cases.measured
    inputs = np.take_along_axis(change, cases.channels, axis=1)
    change = change - np.einsum("rck,rk->rc", reference.by_inputs[..., :6], inputs)
    used = cases.predicted & cases.fitted[:, None]
    return np.asarray(white.apply(np.where(used, change, 0.0))[used])


def _confusable(cache: FitCache, names: Sequence[str], signatures: Mapping[str, Array]) -> dict[str, float]:
    """Of each hidden effect, 1 / sqrt(1 - rho) of the candidate that looks most like it."""
    root = frozenset({ALWAYS}) if ALWAYS in cache.candidates else frozenset[str]()
    about, at = cache.first_order(root), cache.at
    used = cache.whole.predicted & cache.whole.fitted[:, None]
    place = np.full(used.shape, -1)
    place[used] = np.arange(used.sum())
    rows = place[at.rows][used[at.rows]]
    out = {}
    for name in names:
        mine = signatures[name][rows]
        others = [s for s in about.signatures.values() if s.effect.name not in (name, *names)]
        alike = [multiple_correlation(mine, c) for s in others for c in s.columns] if np.any(mine) else [0.0]
        out[name] = float(1.0 / np.sqrt(max(1.0 - max(alike, default=0.0), 1e-6)))
    return out


def _inside(answer: Diagnosis, it: Case) -> dict[str, bool]:
    """Of sizes, whether the 95 % interval holds what was hidden."""
    out = {}
    land = profile_likelihood(answer.fit, answer.cache.whole)
    try:
        ends = intervals(land)
    except TooMuch:
        # Then an answer has no intervals either.
        return {}
    for free, found in zip(answer.model.free, ends, strict=True):
        if is_size(free.effect, free.parameter.name):
            value = it.hidden[free.name]
            out[free.name] = (found.low is None or found.low <= value) and (
                found.high is None or value <= found.high
            )
    return out


def held_out(answer: Diagnosis) -> tuple[float, ...]:
    """Whitened RMS of each held-out test."""
    whole = answer.cache.whole
    gap = Discrepancy(whole, answer.fit.prediction)
    every = [
        gap.rms(whole.test == k) for k, test in enumerate(whole.campaign.tests) if test.role == "holdout"
    ]
    return tuple(rms for rms in every if rms is not None)
