"""Error outside against error inside, every case and approach."""

from __future__ import annotations

from matplotlib.figure import Figure

from pipeline.assessment.extrapolation.approaches import APPROACHES, TRUTH
from pipeline.assessment.extrapolation.table import Study
from reports.charts import dress, picture
from reports.style import CYCLE, FAINT, INK


def drawn(it: Study) -> bytes:
    """PNG."""
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
