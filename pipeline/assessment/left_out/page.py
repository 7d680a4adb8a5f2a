"""The study of effects that are left out of the catalogue, as a page."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from pipeline.assessment.challenge.score import Share, share
from pipeline.assessment.left_out.benches import MU, SEED
from pipeline.assessment.left_out.entries import ENTRIES
from pipeline.assessment.left_out.trial import Trial

_ABOUT = """\
Benches of the frame finite elements with one effect of the catalogue, which the catalogue of the search lacks. The bar
is up to 2 % beside its drawing. Rigs, sensors and plans are drawn as in the clean programme, from a seed of their own.
An effect is brought to the size at which it shows by so many sigmas in the fitted tests. Beside the tolerances: those
that no deviation within them explains, for its price in them; a pin that gives in the plane is much as a softer bar,
and of 50 sigmas 7 may be left. Right is a group with a place at which the effect is a law or a constant, and for what
is no law of a place that no place of the linkage is told, or with the doubt whether it is one, as more than noise is
left. Held out: whitened RMS, by the model with what was found, of the tests that were held out and see the effect by
five sigmas. Bounds are those of Clopper and Pearson (95 %)."""
LARGE, SMALL = 40.0, 15.0
"""Sigmas from which a place has to be found in 95 of 100 cases, and in 80."""


def page(found: Sequence[Trial]) -> str:
    """Markdown; the source fits 120 columns but for tables."""
    commits = ", ".join(sorted({each.commit[:12] for each in found}))
    laws = [it for it in found if ENTRIES[it.name].a_law and not it.error]
    return "\n".join(
        [
            "# Effects that are left out of the catalogue",
            "",
            *_ABOUT.splitlines(),
            "",
            f"{len(found)} benches, seed {SEED}, code of {commits}. Again: `python -m pipeline.assessment.left_out`.",
            "",
            "| goal | wanted | found |",
            "|---|---|---|",
            f"| place or its group right, from 50 sigmas | 95 % | {_right(it for it in laws if it.mu > LARGE)} |",
            f"| place or its group right, at 15 sigmas | 80 % | {_right(it for it in laws if it.mu < LARGE)} |",
            f"| the same, from 40 sigmas beside tolerances | 95 % | {_right(it for it in laws if it.told > LARGE)} |",
            f"| the same, 15 to 40 of them | 80 % | {_right(it for it in laws if SMALL < it.told < LARGE)} |",
            f"| held out as small as it should be, place right | 90 % | {_held(laws)} |",
            f"| no place where there is none | always | {_right(it for it in found if not ENTRIES[it.name].a_law)} |",
            "",
            f"| hidden | right is | right at {', '.join(f'{mu:g}' for mu in MU)} sigmas |",
            "|---|---|---|",
            *(_row(name, [it for it in found if it.name == name]) for name in ENTRIES),
            "",
            "## Bench by bench",
            "",
            "| bench | hidden | sigmas | beside tolerances | found | right | held out | s |",
            "|---|---|---|---|---|---|---|---|",
            *map(_line, found),
            "",
        ]
    )


def _right(some: Iterable[Trial]) -> Share:
    return share(it.right for it in some if not it.error)


def _held(laws: Sequence[Trial]) -> Share:
    return share(
        it.held_out <= ENTRIES[it.name].held_out for it in laws if it.right and it.held_out is not None
    )


def _row(name: str, mine: Sequence[Trial]) -> str:
    entry = ENTRIES[name]
    kinds = ", ".join(entry.kinds) or "no place"
    each = [[it for it in mine if not it.error and abs(it.mu / mu - 1.0) < 0.1] for mu in MU]
    told = ", ".join(f"{sum(it.right for it in some)} of {len(some)}" for some in each)
    return f"| {name} (`{entry.effect}`) | {kinds}: {entry.why} | {told} |"


def _line(it: Trial) -> str:
    found = ", ".join(_found(it)) or it.error or "nothing"
    held = "–" if it.held_out is None else f"{it.held_out:.2f}"
    right = "–" if it.error else "yes" if it.right else "no"
    return f"| {it.number} | {it.name} | {it.mu:.0f} | {it.told:.0f} | {found} | {right} | {held} | {it.seconds:.0f} |"


def _found(it: Trial) -> Iterator[str]:
    for group, form in zip(it.sites, it.forms, strict=True):
        more = f" (+{len(group) - 1})" if len(group) > 1 else ""
        yield f"{group[0]}{more} {form}".strip()
    if it.doubted:
        yield "doubted"
    yield from (f"`{name}`" for name in it.effects if name != "bar_geometric_nonlinearity")
