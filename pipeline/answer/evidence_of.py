"""What the verdict of a diagnosis rests on, collected from its fits."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

from pipeline.answer.evidence import (
    Evidence,
    Explained,
    FailedCheck,
    LookAlike,
    NearMiss,
    RestOfChannel,
    RivalSet,
    SensorInstead,
)
from pipeline.attempt import Attempts
from pipeline.discrepancy.description import descriptions
from pipeline.inference.driving import column_name
from pipeline.selection.adequacy.judgement import SIZE, judge
from pipeline.selection.adequacy.untested import in_units
from pipeline.selection.cost import misfit
from pipeline.selection.diagnosis import Diagnosis
from pipeline.selection.exclusion import needed, worse
from pipeline.selection.possible_tests import menu
from pipeline.selection.single_angle import only_place

NEAR = 3
"""Sets that come closest are told, where nothing explains."""
LOOKS_LIKE = 0.9
"""Correlation from which an effect is said to look like another one."""


def evidence_of(it: Diagnosis, attempts: Attempts) -> Evidence:
    """A part that cannot be worked out is said in the attempts, and takes no other with it."""
    if it.doctor or it.verdict == "nothing_tested":
        return Evidence(**_plain(it, attempts))
    parts: dict[str, tuple[str, Callable[[], object]]] = {
        "explained": ("how the effects show", lambda: tuple(_explained(it))),
        "rivals": ("how far the rivals are", lambda: tuple(_rivals(it))),
        "sensors": ("faults of sensors", lambda: tuple(_sensors(it))),
        "look_alikes": ("what looks alike", lambda: tuple(_look_alikes(it))),
        "near": ("what comes close", lambda: tuple(_near(it))),
        "rest": ("a description of what is left", lambda: tuple(_rest(it))),
        "no_sensor": ("which tests could be proposed", lambda: _no_sensor(it)),
    }
    found = {key: attempts.get(what, work, None) for key, (what, work) in parts.items()}
    return Evidence(
        **_plain(it, attempts), **{key: value for key, value in found.items() if value is not None}
    )


def _plain(it: Diagnosis, attempts: Attempts) -> dict[str, Any]:
    """What is there without another calculation."""
    scatter = next((check.words for check in it.judgement.checks if check.name == SIZE), "")
    zero = it.decision.zero
    return {
        "sets": it.sets,
        "untested": it.untested,
        "because": it.decision.because,
        "unlooked": it.decision.unlooked,
        "zero": "" if zero is None else zero.words,
        "law": it.decision.law or "",
        "failed_checks": tuple(
            FailedCheck(name=check.name, p_value=check.p_value, words=check.words)
            for check in it.judgement.checks
            if not check.passed
        ),
        "larger_scatter": scatter if it.judgement.scatter > 1.0 else "",
        "ended_after": len(it.cache.fits) if it.found.ended else None,
        "as_declared_of_one": it.alone,
        "beside_correlated": it.cache.order(it.alike_rows.beside),
        "law_words": it.law_words,
        "units": attempts.get("what is known in units", lambda: in_units(it.fit), ()),
        "remarks": it.campaign.remarks,
    }


def _explained(it: Diagnosis) -> Iterator[Explained]:
    for name in it.sets[0]:
        effect = it.cache.candidates[name]
        place = only_place(it.fit, name, it.cache.criteria)
        yield Explained(
            effect=name,
            title=effect.title,
            equation=effect.equation,
            signature=effect.signature,
            size=next((a.size for a in it.alike if a.effect == name), None),
            chosen_again=it.agreement.get(name),
            held_out_only=name == it.found.beyond,
            only_angle_deg=None if place is None else place.q_deg,
            only_tests=() if place is None else place.tests,
        )


def _rivals(it: Diagnosis) -> Iterator[RivalSet]:
    if len(it.sets) < 2:
        return
    cache = it.cache
    least = min(map(frozenset, it.sets), key=lambda names: misfit(cache, names))
    for names in it.sets:
        yield RivalSet(
            effects=names,
            above_best=round(worse(cache, frozenset(names), least), 6),
            would_exclude=max(needed(cache, frozenset(names), least), cache.criteria.exclusion_least),
        )


def _sensors(it: Diagnosis) -> Iterator[SensorInstead]:
    for fault in it.instead:
        yield SensorInstead(
            effect=fault.effect,
            words=fault.words,
            explains=fault.explains,
            of=fault.of,
            beside=it.cache.order(fault.without),
        )


def _look_alikes(it: Diagnosis) -> Iterator[LookAlike]:
    cache, best = it.cache, frozenset(it.sets[0])
    for a in it.alike:
        # Alike to first order: fits with it in the place of the effect may have told them apart.
        tried = [n for n in cache.fits if n >= best - {a.effect} | {a.rival} and a.effect not in n]
        apart = bool(tried) and all(worse(cache, names, best) > needed(cache, names, best) for names in tried)
        if a.correlation > LOOKS_LIKE and a.effect in best and a.size < a.needed and not apart:
            yield LookAlike(
                effect=a.effect, rival=a.rival, correlation=a.correlation, size=a.size, needed=a.needed
            )


def _near(it: Diagnosis) -> Iterator[NearMiss]:
    """The closest known explanations, and why each fails."""
    cache = it.cache
    if it.verdict != "unknown":
        return
    near = sorted(cache.fits, key=lambda names: cache.fit(names).chi_square)
    for names in [n for n in near if n and n != frozenset(it.sets[0])][:NEAR]:
        found = cache.fit(names)
        worst = min(judge(found, cache.criteria).checks, key=lambda check: check.p_value)
        yield NearMiss(
            effects=cache.order(names),
            rms=found.rms,
            against="" if worst.name == SIZE else worst.words,
        )


def _rest(it: Diagnosis) -> Iterator[RestOfChannel]:
    if it.verdict != "unknown":
        return
    for each in descriptions(it.fit):
        yield RestOfChannel(
            channel=column_name(each.channel, it.campaign.gauges),
            inputs=each.inputs,
            rms=each.rms,
            elsewhere=each.elsewhere,
        )


def _no_sensor(it: Diagnosis) -> bool:
    if len(it.sets) < 2 or (it.next_test is not None and it.next_test.apart):
        return False
    listed = it.campaign.rig.usual_tests(it.campaign.tests[0].control)
    return listed is not None and not menu(it.campaign)
