"""The study of mistakes of tables as a page."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from pipeline.assessment.mistaken.tables import KINDS
from pipeline.assessment.mistaken.trial import NONE, Trial

_ABOUT = """\
Tables with one mistake, on benches of the challenge (frame finite elements): without any effect that is missing, and
with one. What is written of the rig is known to the usual tolerances. "named" counts tables of which the mistake is
told, alone or among others that the readings do not tell from it; "alone" those where it is the only one told. Signs,
exchanges and zeros are made in columns that read at least a hundred times their noise. The last row are the same
benches without a mistake: named means that none is told."""


def page(found: Sequence[Trial]) -> str:
    """Markdown; the source fits 120 columns."""
    commits = ", ".join(sorted({each.commit[:12] for each in found}))
    counted = [each for each in found if each.counts and not (each.error and not each.made)]
    lines = [
        "# Mistakes of a table",
        "",
        *_ABOUT.splitlines(),
        "",
        f"{len(counted)} tables, code of {commits}. Again: `python -m pipeline.assessment.mistaken`.",
        "",
        "| mistake | nothing missing: tables | named | alone | one effect missing: tables | named | alone | median s |",
        "|---|---|---|---|---|---|---|---|",
        *(_row(kind, [it for it in counted if it.kind == kind]) for kind in (*KINDS, NONE)),
        _row("all mistakes", [it for it in counted if it.kind != NONE]),
        "",
        "## Those that are not named",
        "",
        *(_told(it) for it in counted if not it.named),
        "",
    ]
    return "\n".join(lines)


def _row(kind: str, mine: Sequence[Trial]) -> str:
    cells = [kind]
    for hidden in (False, True):
        some = [it for it in mine if bool(it.hidden) == hidden]
        alone = sum(it.named and len(it.told) <= 1 for it in some)
        cells += [str(len(some)), str(sum(it.named for it in some)), str(alone)]
    cells.append(f"{np.median([it.seconds for it in mine]):.1f}" if mine else "–")
    return f"| {' | '.join(cells)} |"


def _told(it: Trial) -> str:
    missing = f", {' and '.join(it.hidden)} missing" if it.hidden else ""
    said = "; ".join(it.told) or "nothing"
    why = f" ({it.error})" if it.error else ""
    return f"- bench {it.number}, {it.kind}{missing}: {it.made or 'right'}; told: {said}{why}"
