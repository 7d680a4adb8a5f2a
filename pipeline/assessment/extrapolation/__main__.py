"""`python -m pipeline.assessment.extrapolation`: runs the study, or goes on with it, and writes its report."""

from __future__ import annotations

from collections.abc import Sequence

from matplotlib.figure import Figure

from pipeline.assessment.extrapolation.approaches import APPROACHES, TRUTH
from pipeline.assessment.extrapolation.cases import numbers
from pipeline.assessment.extrapolation.page import PICTURE, page
from pipeline.assessment.extrapolation.table import Study, study
from pipeline.assessment.extrapolation.trial import Trial, trial
from pipeline.assessment.study import Study as StudyOf
from reports.charts import dress, picture
from reports.style import CYCLE, FAINT, INK


def beside(found: Sequence[Trial]) -> dict[str, str | bytes]:
    """The page's record and its picture."""
    it = study(found)
    return {"extrapolation.json": it.model_dump_json(indent=1) + "\n", PICTURE: drawn(it)}


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


STUDY = StudyOf(
    name="extrapolation",
    title="predictions beyond the fitted loads",
    of="campaigns",
    count=100,
    counted="Campaigns with hidden effects, from the first one on.",
    tasks=lambda count: [(n,) for n in numbers(count)],
    trial=trial,
    kind=Trial,
    task=lambda it: (it.number,),
    right=lambda it: not it.failed,
    page=lambda found: page(study(found)),
    beside=beside,
)

if __name__ == "__main__":
    STUDY.command()
