"""The study as a page: the criteria, and what changes with each."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

from pipeline.assessment.sensitivity.trial import UNTOUCHED, Change, Programme, Trial, Verdict, varied
from pipeline.assessment.sensitivity.watched import FACTORS
from pipeline.selection.criteria import CRITERIA, Criterion

WRONG = ("wrong", "false alarm")
_ABOUT = """\
Every threshold by which the diagnosis chooses, halved and doubled alone, on benches of the challenge (frame finite
elements). Those that one search asks, on every ninth case of the clean programme: nothing hidden, one effect, two, what
no effect explains, plans that cannot tell. Those that are asked of tables and sensors, on every nineteenth case of the
dirty programme. Counted are the benches whose answer changes: verdict or sets, and on dirty ones also what is certain
or said of the table. "right" counts what the change gains or loses of answers that are right or hold the right set (or,
dirty, name a part of it as certain), "wrong" of names of what is not there. Fits are made again where they depend on
the threshold; a threshold whose change turns no comparison on the way to an answer is not asked about again. A count
is at least one."""


def page(found: Sequence[Trial]) -> str:
    """Markdown; the source fits 120 columns."""
    kept = [each for each in found if each.answer is not None]
    commits = ", ".join(sorted({each.commit[:12] for each in found}))
    count = Counter(each.programme for each in kept)
    lines = [
        "# What hangs on each criterion of the diagnosis",
        "",
        *_ABOUT.splitlines(),
        "",
        f"{count['clean']} clean benches, {count['dirty']} dirty ones, code of {commits}.",
        "Again: `python -m pipeline.assessment.sensitivity`.",
        "",
        *_table("Asked in a search: clean benches", "clean", kept),
        *_table("Asked of tables and sensors: dirty benches", "dirty", kept),
        "## Every change",
        "",
        *_changes(kept),
        "",
        "## The criteria",
        "",
        *(line for each in CRITERIA.of() for line in _meaning(each)),
        f"Those of the groups {', '.join(UNTOUCHED)} change no set of effects and are not in the study.",
        "",
    ]
    return "\n".join(lines)


def _table(title: str, programme: Programme, found: Sequence[Trial]) -> list[str]:
    names, its = varied(programme), [each for each in found if each.programme == programme]
    return [
        f"## {title}",
        "",
        "| criterion | value | ÷2: changed | right | wrong | ×2: changed | right | wrong |",
        "|---|---|---|---|---|---|---|---|",
        *(_row(each, its) for each in CRITERIA.of() if each.name in names),
        "",
    ]


def _row(it: Criterion, found: Sequence[Trial]) -> str:
    cells = [it.name, f"{it.value:g} {it.unit}"]
    for factor in FACTORS:
        mine = [(t, c) for t in found for c in t.changes if (c.criterion, c.factor) == (it.name, factor)]
        right = sum(_good(c.answer.score) - _good(t.answer.score) for t, c in mine if t.answer)
        wrong = sum(_bad(c.answer.score) - _bad(t.answer.score) for t, c in mine if t.answer)
        cells += [str(len(mine)), _signed(right), _signed(wrong)] if mine else ["–", "", ""]
    return f"| {' | '.join(cells)} |"


def _good(score: str) -> int:
    return int(score in ("right", "in set", "certain"))


def _bad(score: str) -> int:
    return int(score in WRONG)


def _signed(count: int) -> str:
    return f"{count:+d}" if count else "0"


def _changes(found: Sequence[Trial]) -> list[str]:
    out = []
    for trial in found:
        if trial.answer is None or not trial.changes:
            continue
        same = Counter(_told(change.answer) for change in trial.changes)
        out.append(f"- {trial.programme} case {trial.number}, {_told(trial.answer)}:")
        for told in same:
            every = [_times(c) for c in trial.changes if _told(c.answer) == told]
            out.append(f"  {told} with {', '.join(every)}")
    return out or ["None."]


def _times(change: Change) -> str:
    return f"{change.criterion} {'×' if change.factor > 1.0 else '÷'}2"


def _told(answer: Verdict) -> str:
    more = [f"certain {' + '.join(answer.certain)}"] if answer.certain else []
    return "; ".join([f"{answer.score} as {_sets(answer.sets)}", *more, *answer.table])


def _sets(sets: Sequence[Sequence[str]]) -> str:
    return " or ".join(" + ".join(names) or "nothing" for names in sets)


def _meaning(it: Criterion) -> list[str]:
    return [f"- **{it.name}** = {it.value:g} {it.unit} ({it.group}): {it.meaning}. Source: {it.source}."]
