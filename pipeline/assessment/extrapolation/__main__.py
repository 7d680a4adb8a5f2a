"""`python -m pipeline.assessment.extrapolation`: runs the study, or goes on with it, and writes its report."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Annotated

import typer
from matplotlib.figure import Figure

from pipeline.assessment import trials
from pipeline.assessment.extrapolation.approaches import APPROACHES, TRUTH
from pipeline.assessment.extrapolation.page import PICTURE, page
from pipeline.assessment.extrapolation.study import run
from pipeline.assessment.extrapolation.table import Study, study
from pipeline.assessment.extrapolation.trial import Trial
from reports.charts import dress, picture
from reports.style import CYCLE, FAINT, INK

OUT = Path("reports/extrapolation")
STORE = OUT / "trials.jsonl"


def main(
    cases: Annotated[
        int, typer.Option(min=1, help="Campaigns with hidden effects, from the first one on.")
    ] = 100,
    workers: Annotated[int, typer.Option(min=1, help="Processes.")] = 2,
    store: Annotated[Path, typer.Option(help="Where finished campaigns are kept.")] = STORE,
    out: Annotated[Path, typer.Option(help="Folder of the page.")] = OUT,
) -> None:
    """Predict beyond the fitted loads in several ways, and compare. Stopped and started again, it goes on."""
    found = trials.followed(
        "extrapolation",
        run(cases, store, workers),
        lambda done: f"{len(done)} of {cases} campaigns",
        lambda done: written(done, out),
    )
    print(f"{out / 'extrapolation.md'}: {len(found)} campaigns")


def written(found: Sequence[Trial], out: Path) -> None:
    """The page, its record and its picture, in a folder."""
    it = study(found)
    record = it.model_dump_json(indent=1) + "\n"
    trials.left(out, {"extrapolation.json": record, "extrapolation.md": page(it), PICTURE: drawn(it)})


def drawn(it: Study) -> bytes:
    """Error outside against error inside, every case and approach, as PNG."""
    figure = Figure(figsize=(7.6, 5.6))
    ax = figure.subplots()
    ends = [value for p in it.points if p.approach != TRUTH for value in (p.inside, p.outside)]
    low, high = 0.7 * min(ends, default=0.1), 1.4 * max(ends, default=10.0)
    ax.plot([low, high], [low, high], color=FAINT, lw=1)
    for approach, colour, marker in zip(APPROACHES, CYCLE, "os^Dv<P", strict=False):
        mine = [p for p in it.points if p.approach == approach]
        if mine and approach != TRUTH:
            inside, outside = [p.inside for p in mine], [p.outside for p in mine]
            ax.scatter(inside, outside, s=26, color=colour, marker=marker, alpha=0.75, label=approach, lw=0)
    ax.set(xscale="log", yscale="log", xlim=(low, high), ylim=(low, high))
    ax.set_xlabel("error between the fitted loads, sigma")
    ax.set_ylabel("error beyond the fitted loads, sigma")
    count = len({p.number for p in it.points})
    ax.set_title(
        f"Errors of {count} benches between and beyond the fitted loads", loc="left", fontsize=12, color=INK
    )
    dress(ax)
    ax.legend(loc="center left", bbox_to_anchor=(1.01, 0.5), frameon=False)
    return picture(figure)


if __name__ == "__main__":
    typer.run(main)
