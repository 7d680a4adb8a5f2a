"""The study as a record and as a page: how many held-out readings lie inside their 95 % intervals."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from statistics import median

from pipeline.assessment.coverage.table import Share
from pipeline.assessment.prediction.off import DECLARED
from pipeline.assessment.prediction.trial import Counts, Trial
from pipeline.record import Record

LOW, HIGH, LEAST = 0.93, 0.97, 0.85
"""Wanted: of all readings together, and of each case at least."""
COLUMNS = (
    "x_mm",
    "y_mm",
    "z_mm",
    "rx_rad",
    "ry_rad",
    "rz_rad",
    "fx_N",
    "fy_N",
    "fz_N",
    "mx_Nmm",
    "my_Nmm",
    "mz_Nmm",
    "mid_mm",
)
"""In the order of the page."""


class Part(Record):
    """Readings at some loads. inside: over all cases. least: smallest share of a case, and its number. below: cases
    under 85 %. columns: share inside by column."""

    inside: Share
    least: float
    case: int
    below: tuple[int, ...]
    columns: dict[str, Share]


class Study(Record):
    """cases: with an answer. named: of them, cases where one set with an effect was identified, and predicted. true:
    of those, sets that are what was hidden. sampled: cases with histories whose intervals are by samples. held, far:
    held-out tests, and the fitted ones at 1.5 times the loads. true_held, true_far: of true sets alone. lost: rows
    without a prediction. failed: reasons, by case."""

    cases: int
    named: int
    true: int
    sampled: int
    held: Part
    far: Part
    true_held: Part
    true_far: Part
    lost: int
    failed: dict[str, str]
    seconds: float
    commits: tuple[str, ...]


def study(trials: Sequence[Trial]) -> Study:
    """Of trials, at least one of which names an effect. ValueError where none does."""
    every = sorted(trials, key=lambda it: it.number)
    named = [it for it in every if it.named and it.held.share is not None and it.far.share is not None]
    true = [it for it in named if it.true]
    if not true:
        raise ValueError("no case names what was hidden, at least one is needed")
    return Study(
        cases=sum(not it.failed for it in every),
        named=len(named),
        true=len(true),
        sampled=sum(it.sampled > 0 for it in named),
        held=_part((it.number, it.held) for it in named),
        far=_part((it.number, it.far) for it in named),
        true_held=_part((it.number, it.held) for it in true),
        true_far=_part((it.number, it.far) for it in true),
        lost=sum(it.lost for it in named),
        failed={str(it.number): it.failed for it in every if it.failed},
        seconds=round(median(it.seconds for it in every), 1),
        commits=tuple(sorted({it.commit for it in every})),
    )


def _part(cases: Iterable[tuple[int, Counts]]) -> Part:
    each = list(cases)
    shares = {number: counts.share or 0.0 for number, counts in each}
    worst = min(shares, key=lambda number: shares[number])
    columns = [column for column in COLUMNS if any(column in counts.of for _, counts in each)]
    return Part(
        inside=_share(sum(c.total[0] for _, c in each), sum(c.total[1] for _, c in each)),
        least=shares[worst],
        case=worst,
        below=tuple(number for number, share in shares.items() if share < LEAST),
        columns={
            column: _share(
                sum(c.inside.get(column, 0) for _, c in each), sum(c.of.get(column, 0) for _, c in each)
            )
            for column in columns
        },
    )


def _share(count: int, of: int) -> Share:
    return Share(count=count, of=of)


def page(it: Study, tolerances: bool = False) -> str:
    """The study in Markdown; the source fits 120 columns. tolerances: of benches that are off what is written."""
    title, option = (", of benches off what is written", " --tolerances") if tolerances else ("", "")
    every, true = (
        (("held-out tests", it.held), ("1.5 times the loads", it.far)),
        (
            ("held-out tests, name is right", it.true_held),
            ("1.5 times the loads, name is right", it.true_far),
        ),
    )
    columns = list(it.held.columns)
    return "\n".join(
        [
            f"# How often the intervals of `predict` hold a reading{title}",
            "",
            "Campaigns of the challenge that hide one effect of the catalogue or two, on finite elements, with noise.",
            "Each is diagnosed; where one set with an effect is identified, its fitted model predicts readings that it",
            "was not fitted to, at what was prescribed as it was read, and the share of them inside their 95 %",
            "intervals is counted: the tests that were held out, at angles between the fitted ones and 0.9 times their",
            "loads, and the fitted tests done once more at 1.5 times their loads and travels.",
            *(DECLARED if tolerances else ()),
            f"Wanted: {100 * LOW:.0f} to {100 * HIGH:.0f} % of all readings together, no case under "
            f"{100 * LEAST:.0f} %.",
            "",
            f"{it.cases} cases, {it.named} of them with a named effect, {it.true} with exactly what was hidden.",
            "",
            "| readings | inside | least of a case | cases under 85 % |",
            "|---|---|---|---|",
            *(_row(name, part) for name, part in (*every, *true)),
            "",
            "| column | held-out tests | 1.5 times the loads |",
            "|---|---|---|",
            *(f"| {name} | {it.held.columns[name]} | {it.far.columns.get(name, '–')} |" for name in columns),
            "",
            f"Histories whose intervals are by samples: in {it.sampled} cases. Rows without a stable state: {it.lost}.",
            f"No answer: {'; '.join(f'case {k}: {why}' for k, why in it.failed.items()) or 'none'}.",
            f"A case took {it.seconds:.0f} s of one processor in the median. Code: {', '.join(it.commits)}.",
            f"Again: `python -m pipeline.assessment.prediction{option} --cases {it.cases + len(it.failed)}`.",
            "",
        ]
    )


def _row(name: str, part: Part) -> str:
    below = ", ".join(map(str, part.below)) or "none"
    return f"| {name} | {part.inside} | {100 * part.least:.1f} % (case {part.case}) | {below} |"
