"""What a diagnosis leaves possible: every set of effects with its own numbers, each as an answer of its own."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from pipeline.add.summary import error_of
from pipeline.adequacy.judgement import judge
from pipeline.answer import Answer
from pipeline.diagnose.diagnosis import Diagnosis
from pipeline.diagnose.record import answer_of
from pipeline.inference.model import Model
from pipeline.page.record import RivalPage

Say = Callable[[str], None]
MOST = 4
"""Sets that stand side by side on a page; a verdict of more names them all."""


@dataclass(frozen=True, eq=False)
class Possible:
    """One set: its record, and its fitted model."""

    answer: Answer
    model: Model


def possible(
    found: Diagnosis, answer: Answer, say: Say = lambda _: None, most: int = MOST
) -> tuple[Possible, ...]:
    """The sets that a verdict leaves, the simplest first; one where it is not ambiguous.

    answer: that of the diagnosis, which is the first of them. Each has effects, numbers and the last error of its own
    set; sentences and candidates are those of the diagnosis.
    """
    first = Possible(answer, found.model)
    if found.verdict != "ambiguous":
        return (first,)
    return (first, *(_with(found, answer, names, say) for names in found.sets[1:most]))


def pages_of(sets: tuple[Possible, ...]) -> tuple[RivalPage, ...]:
    """As a page has them; none where the verdict leaves one only."""
    every = (it.answer for it in sets if it.answer.verdict == "ambiguous")
    return tuple(RivalPage(effects=it.effects, error=it.error[-1], parameters=it.parameters) for it in every)


def _with(found: Diagnosis, answer: Answer, names: tuple[str, ...], say: Say) -> Possible:
    """The answer with another set in the place of the first."""
    say(" + ".join(names))
    shelf = found.shelf
    fit = shelf.fit(frozenset(names))
    own = answer_of(found, answer.sentences, fit)
    last = error_of(fit, shelf.whole, len(fit.model.free), judge(fit, shelf.criteria))
    update = {"effects": fit.model.names, "added": names, "error": (answer.error[0], last)}
    return Possible(own.model_copy(update=update), fit.model)
