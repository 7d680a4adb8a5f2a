"""A discovery as an engineer would say it, from its record alone."""

from __future__ import annotations

from collections.abc import Iterator

from pipeline.answer.law import LawFound
from pipeline.discover.record import Discovered
from pipeline.selection.criteria import CRITERIA
from reports.quantities import estimate, phrase, short, sigma

MANY = 4


def sentences(it: Discovered) -> tuple[str, ...]:
    """What was found, the place and the picture before the form."""
    return (*_first(it), *law_sentences(it), *_last(it))


def law_sentences(it: Discovered) -> tuple[str, ...]:
    """Of the laws alone, for an answer that has its own verdict."""
    return (*(said for law in it.laws for said in said_of(law)), *_doubt(it))


def _doubt(it: Discovered) -> Iterator[str]:
    if it.laws and it.left:
        places = "the place" if len(it.laws) == 1 else "a place"
        yield (
            f"More than noise is left beside this: {it.left[0]}. So {places} or its form may be another, or what is "
            "missing is no law of a single place."
        )


def _first(it: Discovered) -> Iterator[str]:
    before, after = it.error[0], it.error[-1]
    if not it.laws and not it.entered:
        yield (
            f"No law is found: the error is {sigma(before.fit)} sigma, and no place of the linkage explains what is "
            f"left of it by one function shared by all tests (the best is {it.next_site or 'none'}, ln evidence "
            f"{short(it.next_evidence)}, asked is {short(CRITERIA.law_proposed)})."
        )
        return
    names = [law.where for law in it.laws] + [each.effect for each in it.entered]
    falls = "falls" if (after.fit or 0.0) <= (before.fit or 0.0) else "goes"
    yield (
        f"What is left sits here: {'; '.join(names)}. The error {falls} from {sigma(before.fit)} to {sigma(after.fit)} "
        "sigma in the fitted tests"
        + (
            f", from {sigma(before.holdout)} to {sigma(after.holdout)} in those held out."
            if before.holdout is not None
            else "."
        )
    )
    if it.geometry:
        yield (
            "The geometric nonlinearity of the bars (`bar_geometric_nonlinearity`) entered the model first: with it "
            f"the error is {sigma(it.error[1].fit)} sigma."
        )
    for each in it.entered:
        yield (
            f"{each.effect} explains as much as a law at any place (ln evidence {short(each.evidence)}) and is none by "
            "nature: it entered the model. diagnose says whether its name is certain."
            + (
                f" These tests do not tell it from a law at {', '.join(each.sites[:MANY])}."
                if each.sites
                else ""
            )
        )


def said_of(it: LawFound) -> Iterator[str]:
    """One law: its place and what it is like, what it is not told from, its form with its numbers."""
    reach = f"{short(it.range[0])} to {short(it.range[1])}{f' {it.curve.x_unit}' if it.curve else ''}"
    yield f"{it.site}: {it.where}. What the readings say of it, over {reach}: {it.shape}."
    if it.group:
        others = [each.site for each in it.group]
        more = f" and {len(others) - MANY} more" if len(others) > MANY else ""
        yield (
            f"These tests do not tell it from {', '.join(others[:MANY])}{more}: their ln evidence is within "
            f"{short(max(CRITERIA.law_alike, CRITERIA.law_alike_share * it.evidence), 2)} of its own."
        )
    if it.form is None:
        yield f"No form of a law in the mechanism explains it there (ln evidence {short(it.evidence)})."
        return
    numbers = ", ".join(phrase(k, estimate(v.model_dump()), v.unit) for k, v in it.parameters.items())
    yield f"The form that explains most: {it.equation}, {numbers}."
    if it.effects:
        yield f"In the catalogue that is {' or '.join(it.effects)}: diagnose says whether that name is certain."
    if it.ties:
        names = ", ".join(tie.form for tie in it.ties[:MANY])
        apart = max(tie.beyond for tie in it.ties)
        yield (
            f"As good: {names}. At {CRITERIA.law_beyond:g} times these loads they differ by {short(apart, 2)} sigma"
            + (
                ": the law is not known beyond the loads measured."
                if apart > CRITERIA.law_unknown_beyond
                else "."
            )
        )


def _last(it: Discovered) -> Iterator[str]:
    if it.set_aside:
        some = ", ".join(
            f"{' or '.join([e.column, *e.instead])} at {e.place} ({sigma(e.sigma)})"
            for e in it.set_aside[:MANY]
        )
        more = f" and {len(it.set_aside) - MANY} more" if len(it.set_aside) > MANY else ""
        yield f"Set aside as single bad readings, off by so many of their sigmas: {some}{more}."
    for each in it.noise:
        if each.tails is None:
            yield (
                f"{each.column} scatters by {short(each.found)}, not by the {short(each.declared)} that is declared: "
                "what it does counts."
            )
    tails = next((each.tails for each in it.noise if each.tails is not None), None)
    if tails is not None:
        yield (
            f"The noise has long tails (Student's law of {tails:.1f} degrees of freedom): readings far out count less."
        )
    if not it.laws and not it.entered:
        return
    if it.whole:
        yield "Nothing more is found in what is left."
    elif it.next_site is not None:
        yield f"More is left: {it.next_site} comes next (ln evidence {short(it.next_evidence)})."
    yield from it.not_done
