"""The study of single doubts as a page."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from pipeline.assessment.challenge.score import share
from pipeline.assessment.doubts.benches import SEED
from pipeline.assessment.doubts.kinds import KINDS
from pipeline.assessment.doubts.trial import Trial

_ABOUT = """\
Benches of the frame finite elements that have one thing besides the physics and nothing else. Rigs, sensors and plans
are drawn as in the dirty programme, from a seed of their own, and are the same for every kind. Tolerances are the usual
ones. Where an effect may be hidden every other bench has one. Of the Orthoglide position and force are read (10 um,
0.5 N) in forty postures, each under 1000 N in a direction of its own; the truth is by frame elements at rest. Bounds
are those of Clopper and Pearson (95 %)."""


def page(found: Sequence[Trial]) -> str:
    """Markdown; the source fits 120 columns but for tables."""
    commits = ", ".join(sorted({each.commit[:12] for each in found}))
    return "\n".join(
        [
            "# One doubt at a time",
            "",
            *_ABOUT.splitlines(),
            "",
            f"{len(found)} benches, seed {SEED}, code of {commits}. Again: `python -m pipeline.assessment.doubts`.",
            "",
            "| kind | what the bench has | right is | wanted | found | median s |",
            "|---|---|---|---|---|---|",
            *(_row(kind, [it for it in found if it.kind == kind]) for kind in KINDS),
            "",
            "## Those that are not right",
            "",
            *_others(found),
            "",
        ]
    )


def _row(kind: str, mine: Sequence[Trial]) -> str:
    it = KINDS[kind]
    seconds = f"{np.median([each.seconds for each in mine]):.0f}" if mine else "–"
    right = share(each.right for each in mine)
    return f"| {kind} | {it.made} | {it.right} | {it.wanted} | {right} | {seconds} |"


def _others(found: Sequence[Trial]) -> Iterator[str]:
    for it in found:
        if not it.right:
            hidden = f", hidden {' + '.join(it.hidden)}" if it.hidden else ""
            yield f"- {it.kind} {it.number}{hidden}: {it.error or it.wrong}; {it.verdict} {it.sets}".rstrip(
                "; "
            )
