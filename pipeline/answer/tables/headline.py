"""An answer in one line of a terminal."""

from __future__ import annotations

from collections.abc import Iterator

from pipeline.answer.record import Answer
from pipeline.terminal import one_line
from reports.quantities import sigma

NOTHING = {
    "identified": "the effect is named below",
    "within_noise": "the model explains the measurements",
    "ambiguous": "several sets of effects fit alike, named below",
    "unknown": "what is left is no noise",
    "nothing_tested": "no reading is left to test a model by",
}
"""What is said where names and numbers do not fit a line."""


def headline(answer: Answer) -> str:
    """Verdict, effects and errors in sigmas, as many of these as fit 80 columns; never more than that."""
    return one_line(*_tries(answer))


def title(answer: Answer) -> str:
    """Of a table of errors: what they are of."""
    within = ", rig within its tolerances" if answer.nominals else ""
    return f"{answer.campaign}: error in sigmas, 1 is noise{within}"


def sets_of(answer: Answer) -> tuple[tuple[str, ...], ...]:
    """The sets of effects that an answer leaves possible, without those of the model that it began with."""
    began = answer.error[0].effects
    others = (tuple(name for name in names if name not in began) for names in answer.alternatives)
    return (answer.added, *others)


def _tries(answer: Answer) -> Iterator[str]:
    verdict, last = answer.verdict, answer.error[-1]
    plain = f"{verdict}: {NOTHING[verdict]}"
    before = sigma(answer.error[0].fit)
    fall = f"{before} -> {sigma(last.fit)} sigma" if len(answer.error) > 1 else f"{sigma(last.fit)} sigma"
    if answer.doctor:
        yield f"{answer.campaign}: {verdict}: a mistake of the table comes first, {sigma(last.fit)} sigma"
        yield f"{verdict}: a mistake of the table comes first, see below"
        return
    if verdict != "nothing_tested":
        for said in _said(answer):
            yield f"{answer.campaign}: {verdict}: {said}; {fall}"
            yield f"{verdict}: {said}; {fall}"
            yield f"{verdict}: {said}"
        yield f"{answer.campaign}: {plain}, {fall}"
        yield f"{plain}, {fall}"
    yield f"{answer.campaign}: {plain}"
    yield plain


def _said(answer: Answer) -> Iterator[str]:
    """The effects, of `unknown` those that help; of many sets ever fewer."""
    if answer.verdict == "ambiguous":
        sets = [" + ".join(names) or "no further effect" for names in _without_faults(answer)]
        sets += ["a fault of a sensor"] if answer.evidence is not None and answer.evidence.sensors else []
        sets += [_law_at(answer)] if answer.laws else []
        yield " or ".join(sets)
        for count in range(len(sets) - 1, 0, -1):
            yield f"{', '.join(sets[:count])} or {len(sets) - count} more"
        return
    names = " + ".join(answer.added)
    if answer.verdict == "unknown" and answer.laws:
        helping = f"{names} and " if names else ""
        yield f"{helping}{_law_at(answer)}"
        yield _law_at(answer)
    elif answer.verdict == "unknown" and names:
        yield f"{names} {'helps' if len(answer.added) == 1 else 'help'}"
    elif names:
        yield names


def _without_faults(answer: Answer) -> tuple[tuple[str, ...], ...]:
    """The sets that need no fault of a sensor beside them."""
    return sets_of(answer) if answer.evidence is None else answer.evidence.sets


def _law_at(answer: Answer) -> str:
    """The places of laws beyond the catalogue."""
    return f"a law at {' and '.join(law.site for law in answer.laws)}"
