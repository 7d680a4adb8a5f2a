"""The study as a page: the criteria, and what changes with each."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

from pipeline.assessment.sensitivity.trial import FACTORS, UNASKED, UNTOUCHED, Change, Trial, varied
from pipeline.selection.criteria import CRITERIA, Criterion

WRONG = ("wrong", "false alarm")
_ABOUT = """\
Every threshold by which the diagnosis chooses, halved and doubled alone, on benches of the challenge (frame finite
elements, every tenth case: nothing hidden, one effect, two, what no effect explains, plans that cannot tell). Counted
are the benches whose verdict or sets change. "right" counts what the change gains or loses of answers that are right
or hold the right set, "wrong" of names of what is not there. Fits are made again where they depend on the threshold;
the rest is chosen anew from the same fits. A count is at least one."""


def page(found: Sequence[Trial]) -> str:
    """Markdown; the source fits 120 columns."""
    kept = [each for each in found if each.answer is not None]
    commits = ", ".join(sorted({each.commit[:12] for each in found}))
    lines = [
        "# What hangs on each criterion of the diagnosis",
        "",
        *_ABOUT.splitlines(),
        "",
        f"{len(kept)} benches, code of {commits}. Again: `python -m pipeline.assessment.sensitivity`.",
        "",
        "| criterion | value | ÷2: changed | right | wrong | ×2: changed | right | wrong |",
        "|---|---|---|---|---|---|---|---|",
        *(_row(each, kept) for each in CRITERIA.of() if each.name in varied()),
        "",
        "## Every change",
        "",
        *_changes(kept),
        "",
        "## The criteria",
        "",
        *(line for each in CRITERIA.of() for line in _meaning(each)),
        f"Those of the groups {' and '.join(UNTOUCHED)} change no set of effects and are not in the study.",
        f"Nor are those of {', '.join(UNASKED)}: they ask, before a search and after it,",
        "whether tables, readings and what was written are as declared; on these benches they are.",
        "",
    ]
    return "\n".join(lines)


def _row(it: Criterion, found: Sequence[Trial]) -> str:
    cells = [it.name, f"{it.value:g} {it.unit}"]
    for factor in FACTORS:
        mine = [(t, c) for t in found for c in t.changes if (c.criterion, c.factor) == (it.name, factor)]
        right = sum(_good(c.answer.score) - _good(t.answer.score) for t, c in mine if t.answer)
        wrong = sum(_bad(c.answer.score) - _bad(t.answer.score) for t, c in mine if t.answer)
        cells += [str(len(mine)), _signed(right), _signed(wrong)] if mine else ["–", "", ""]
    return f"| {' | '.join(cells)} |"


def _good(score: str) -> int:
    return int(score in ("right", "in set"))


def _bad(score: str) -> int:
    return int(score in WRONG)


def _signed(count: int) -> str:
    return f"{count:+d}" if count else "0"


def _changes(found: Sequence[Trial]) -> list[str]:
    out = []
    for trial in found:
        if trial.answer is None or not trial.changes:
            continue
        same = Counter(_told(change) for change in trial.changes)
        out.append(f"- case {trial.number}, {trial.answer.score} as {_sets(trial.answer.sets)}:")
        for told in same:
            every = [_times(c) for c in trial.changes if _told(c) == told]
            out.append(f"  {told} with {', '.join(every)}")
    return out or ["None."]


def _times(change: Change) -> str:
    return f"{change.criterion} {'×' if change.factor > 1.0 else '÷'}2"


def _told(change: Change) -> str:
    return f"{change.answer.score} as {_sets(change.answer.sets)}"


def _sets(sets: Sequence[Sequence[str]]) -> str:
    return " or ".join(" + ".join(names) or "nothing" for names in sets)


def _meaning(it: Criterion) -> list[str]:
    return [f"- **{it.name}** = {it.value:g} {it.unit} ({it.group}): {it.meaning}. Source: {it.source}."]
