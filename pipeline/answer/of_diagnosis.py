"""A diagnosis as a record: what answers, pages and sentences are made from."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from pipeline.answer.evidence_of import evidence_of
from pipeline.answer.record import (
    Answer,
    Candidate,
    Certain,
    Correlation,
    DoctorFinding,
    FoundNoise,
    UnknownZero,
)
from pipeline.answer.summary import (
    as_written,
    changes,
    confusable,
    error_of,
    nominals_of,
    set_aside_records,
    undetermined,
    values_of,
)
from pipeline.answer.wording.diagnosis import sentences
from pipeline.attempt import Attempts
from pipeline.campaign import Campaign
from pipeline.campaign.names import COORDINATES
from pipeline.inference.fit import Fit
from pipeline.inference.intervals import correlations, intervals, only_together, profile_likelihood, straight
from pipeline.inference.model import Model
from pipeline.inference.nuisances import nominals
from pipeline.provenance import made_with
from pipeline.selection.cost import taken
from pipeline.selection.cross_validation import crossvalidated, crossvalidated_with
from pipeline.selection.diagnosis import Diagnosis
from pipeline.selection.doctor import Suspicion
from pipeline.selection.fit_cache import FitCache, Names
from pipeline.selection.mistakes.base import columns_of, sigmas_of
from pipeline.selection.next_test import NextTest
from pipeline.selection.possible_tests import Choice
from pipeline.selection.reading_noise import Readings
from pipeline.selection.unknown_zeros import Zero


def answered(it: Diagnosis, found: Fit | None = None) -> Answer:
    """The diagnosis as a record with its sentences. found: whose parameters it has, default those of the first set;
    effects, errors and sentences stay those of the first set."""
    answer = answer_of(it, found)
    own = answer if found is None or found is it.fit else answer_of(it)
    return answer.model_copy(update={"sentences": sentences(own)})


def answer_of(it: Diagnosis, found: Fit | None = None) -> Answer:
    """The diagnosis as a record without its sentences. found: whose numbers it has, as in `answered`."""
    cache, whole, found = it.cache, it.cache.whole, found or it.fit
    before, attempts = cache.fit(frozenset()), Attempts()
    land = profile_likelihood(found, whole)
    surely = it.judgement.noise and not it.untested
    ends = attempts.get("intervals", lambda: intervals(land) if surely else straight(land), None) or straight(
        land
    )
    values = values_of(found.model, ends)
    pairs = attempts.get("correlations of the numbers", lambda: correlations(land), [])
    together = attempts.get("what is seen only together", lambda: only_together(land), [])
    names = [each.name for each in found.model.free]
    steps = [before, *_steps(it)]
    return Answer(
        campaign=it.campaign.name,
        verdict=it.verdict,
        effects=it.model.names,
        added=it.sets[0],
        alternatives=tuple((*cache.base.names, *names) for names in it.possible[1:]),
        parameters=values,
        error=tuple(
            error_of(each, whole, each.numbers, it.judgement if each is steps[-1] else None) for each in steps
        ),
        tests=changes(before, it.fit, whole),
        # Where nothing is tested no candidate promises anything.
        candidates=()
        if it.untested
        else attempts.get("the table of candidates", lambda: candidates_of(it), ()),
        correlations=tuple(Correlation(first=names[i], second=names[j], value=r) for i, j, r in pairs),
        undetermined=undetermined(values, [[names[k] for k in group] for group in together]),
        confusable=confusable(names, pairs) + _alike(it),
        next_test=next_test_record(it.next_test, it.sets),
        at_bound=it.decision.at_bound,
        out_by_plausibility=tuple((*cache.base.names, *cache.order(n)) for n in it.decision.out),
        set_aside=set_aside_records(it.readings.bad),
        noise=(*_other_noise(it), *_correlated(it)),
        as_declared=None if it.readings.plain else it.with_all,
        certain=tuple(Certain(effect=name, parameters=_values(found.model, name)) for name in it.certain),
        laws=it.laws,
        doctor=tuple(doctor_finding(each) for each in it.doctor),
        zeros=()
        if it.decision.zero is None or it.decision.zero.zero is None
        else (zero_record(it.decision.zero.zero),),
        # Beside a mistake of the table they take up what that does.
        nominals=()
        if it.doctor
        else attempts.get("what was written about the rig", lambda: nominals_of(found, cache.criteria), ()),
        as_written=None
        if it.doctor or it.untested or not nominals(it.campaign)
        else attempts.get("the error of the rig as it is written", lambda: as_written(before, whole), None),
        evidence=evidence_of(it, attempts),
        not_done=(*it.failed, *attempts.failed),
        evaluations=cache.evaluations + land.evaluations,
        seconds=it.seconds,
        **made_with(),
        data=dict(it.campaign.digests),
    )


def doctor_finding(it: Suspicion) -> DoctorFinding:
    """As a record."""
    return DoctorFinding(
        hypothesis=it.mistake.words,
        column=", ".join(it.mistake.columns),
        chi_square_before=it.before,
        chi_square_after=it.after,
        mend=it.mistake.mend,
    )


def _other_noise(it: Diagnosis) -> Iterator[FoundNoise]:
    if it.given is not None:
        yield from found_noise(it.readings, it.given, it.cache.whole.predicted)


def _correlated(it: Diagnosis) -> Iterator[FoundNoise]:
    """Sensors whose noise is correlated from row to row, with the sigmas that count."""
    sigmas, names = sigmas_of(it.campaign), columns_of(it.campaign)
    declared = sigmas if it.given is None else sigmas_of(it.given)
    for each in it.alike_rows.sensors:
        yield FoundNoise(
            column=names[each.channel],
            declared=float(declared[each.channel]),
            found=float(sigmas[each.channel]),
            relative_error=each.error / each.correlation,
            correlation=each.correlation,
        )


def found_noise(it: Readings, given: Campaign, predicted: np.ndarray) -> Iterator[FoundNoise]:
    """Sensors whose noise is not as it was declared. predicted: (R, C) readings that are compared."""
    sigmas, names = sigmas_of(given), columns_of(given)
    for each in it.scatter:
        declared = float(sigmas[each.channel])
        found = declared * each.factor
        yield FoundNoise(
            column=names[each.channel], declared=declared, found=found, relative_error=each.error
        )
    if it.tails is not None:
        for channel in np.flatnonzero(predicted.any(axis=0)):
            declared = float(sigmas[channel])
            found, tails = declared * it.tails.scale, it.tails.degrees
            yield FoundNoise(column=names[channel], declared=declared, found=found, tails=tails)


def _values(model: Model, name: str) -> dict[str, float]:
    """Of an effect of a model, by the names of its parameters."""
    term = next((each for each in model.terms if each.effect.name == name), None)
    return {} if term is None else {key: float(value) for key, value in term.values.items()}


def zero_record(it: Zero) -> UnknownZero:
    """As a record."""
    return UnknownZero(
        column=it.column, tests=it.tests, value=it.value, std=it.std, unit=it.unit, chi_square=it.gain
    )


def _steps(it: Diagnosis) -> list[Fit]:
    """Fits on the way to the first set, the effect that explains most first; those that were made."""
    cache, goal = it.cache, frozenset(it.sets[0])
    here: Names = frozenset()
    out = []
    while here != goal:
        ahead = [here | {name} for name in goal - here if here | {name} in cache.fits]
        if not ahead:
            out.append(cache.fit(goal))
            break
        here = min(ahead, key=lambda names: cache.fit(names).chi_square)
        out.append(cache.fit(here))
    return out


def _alike(it: Diagnosis) -> tuple[tuple[str, ...], ...]:
    return tuple(
        dict.fromkeys(
            (a.effect, a.rival) for a in it.alike if 1.0 - a.correlation < it.cache.criteria.confusable_within
        )
    )


def candidates_of(it: Diagnosis) -> tuple[Candidate, ...]:
    """Every effect that was tried: what it promised, what it did, how it does in tests it did not see."""
    cache, best = it.cache, it.found.best
    root = frozenset(name for name in best if not cache.candidates[name].parameters)
    # After a search that took too long there is no time for what was not looked at.
    about = cache.first_orders.get(root) if it.found.ended else cache.first_order(root)
    least = _bic(cache, best)
    out = []
    for name in cache.candidates:
        mine = [names for names in cache.fits if name in names]
        top = min(mine, key=lambda names: _bic(cache, names), default=None)
        screen = cross = None
        if about is not None and name in about.signatures:
            left = about.fit.chi_square - about.gain([name]).value
            screen = float(np.sqrt(max(left, 0.0) / max(about.fit.degrees, 1)))
            cross = crossvalidated_with(about, name)
        fitted = None if top is None else cache.fit(top)
        out.append(
            Candidate(
                effect=name,
                screen=screen,
                fit=None if fitted is None else fitted.rms,
                crossvalidated=cross if fitted is None else crossvalidated(fitted),
                evidence=None if top is None else _bic(cache, top) - least,
            )
        )
    return tuple(sorted(out, key=lambda c: (c.evidence is None, c.evidence or 0.0, c.screen or np.inf)))


def _bic(cache: FitCache, names: Names) -> float:
    found = cache.fit(names)
    return found.chi_square + taken(cache, names) * float(np.log(max(found.whitened.size, 2)))


def next_test_record(it: NextTest | None, sets: tuple[tuple[str, ...], ...]) -> dict[str, object] | None:
    """The next test as JSON, what it would tell apart, and a second one where only both together tell."""
    if it is None or not it.apart:
        return None
    first, *others = [_test_record(choice) for choice in it.choices]
    return {
        **first,
        "tells_apart": [[list(sets[a]), list(sets[b])] for a, b in it.apart],
        "expected_chi_square": [it.parted[pair] for pair in it.apart],
        "together_with": others,
    }


def _test_record(choice: Choice) -> dict[str, object]:
    return {
        "q_deg": choice.test.q_deg,
        "control": dict(zip(COORDINATES, choice.test.control, strict=True)),
        "driven": COORDINATES[choice.shape.coordinate],
        "largest": choice.limit,
        "why": in_words(choice),
    }


def in_words(choice: Choice) -> str:
    """A test of the menu."""
    unit = ("N", "mm", "mm", "rad", "rad", "rad")[choice.shape.coordinate]
    warm = ", 10 K warmer" if choice.warmer else ""
    return f"q = {choice.test.q_deg:g}°, {choice.shape.words}, there and back to ±{choice.limit:.3g} {unit}{warm}"
