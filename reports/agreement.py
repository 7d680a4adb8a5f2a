"""Solid, frame, refined springs and LIN under the same conditions, and how far each is from the solid."""

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from reports.charts import dress, picture
from reports.formats import held_label
from reports.load import Json
from reports.style import colour_of

Floats = npt.NDArray[np.float64]

LABELS = {"fea": "solid FE", "frame": "frame", "vjm": "VJM, distributed", "lin": "LIN"}
LOOKS = {"fea": ("-", 4.0), "frame": ("-", 1.6), "vjm": ("--", 1.6), "lin": (":", 1.4)}
LARGEST = 3.0
"""Range of the differences, per cent: LIN leaves it at the critical load."""


def draw(result: Json) -> bytes:
    """Curves above, differences to the solid below, a column for each way of holding the platform, as PNG."""
    first = result["curves"][0]["q_deg"]
    here = [c for c in result["curves"] if c["q_deg"] == first]
    sets = list(dict.fromkeys(tuple(c["held"]) for c in here))
    # As wide as the page, on which one panel alone would be drawn too large.
    figure = Figure(figsize=(max(4.6 * len(sets), 9.2), 6.2))
    grid = figure.subplots(2, len(sets), squeeze=False, gridspec_kw={"height_ratios": (1.5, 1.0)})
    for (top, bottom), held in zip(grid.T, sets, strict=True):
        panel(top, bottom, [c for c in here if tuple(c["held"]) == held])
        top.set_title(f"q = {first:g}°, held: {held_label(held)}", fontsize=9.5, loc="left")
    grid[0, 0].set_ylabel("compression −F$_x$, kN")
    grid[1, 0].set_ylabel("difference to solid FE, %")
    figure.tight_layout(w_pad=2.0)
    lines, names = grid[0, 0].get_legend_handles_labels()
    figure.legend(
        lines, names, loc="upper center", bbox_to_anchor=(0.5, 0.0), ncols=len(names), frameon=False
    )
    return picture(figure)


def panel(top: Axes, bottom: Axes, curves: Sequence[Json]) -> None:
    """One way of holding the platform."""
    x, solid = joined(curves, "fea")
    band = next((c["band"] for c in curves if c["model"] == "fea" and c.get("band") is not None), None)
    critical = next(c["critical_N"][0] for c in curves if c["model"] == "fea" and c["critical_N"])
    for model, label in LABELS.items():
        at, force = joined(curves, model)
        if not len(at):
            continue
        dash, width = LOOKS[model]
        top.plot(-at, -force / 1e3, dash, lw=width, color=colour_of(label), label=label)
        if model != "fea":
            same = (x != 0.0) & (x >= at[0]) & (x <= at[-1])
            off = 100.0 * (np.interp(x[same], at, force) / solid[same] - 1.0)
            bottom.plot(-x[same], off, dash, marker=".", lw=width, color=colour_of(label))
    bent = -x[solid <= 0.97 * critical]
    if band is not None and len(bent):
        bottom.fill_between([bent.min(), bent.max()], -100 * band, 100 * band, color="#d9dee3", lw=0)
    margin = 0.08 * (max(-solid) - min(-solid)) / 1e3
    top.set_ylim(min(-solid) / 1e3 - margin, max(-solid) / 1e3 + 2 * margin)
    bottom.set_ylim(-LARGEST, LARGEST)
    bottom.set_xlim(*top.get_xlim())
    bottom.set_xlabel("shortening −x, mm")
    dress(top)
    dress(bottom)


def joined(curves: Sequence[Json], model: str) -> tuple[Floats, Floats]:
    """x mm and Fx N, (n,) each, of all branches of a model, x rising; of the springs, the distributed ones."""
    mine = [c for c in curves if c["model"] == model and (model != "vjm" or c["spring_at"] == "distributed")]
    x = np.array([v for c in mine for v in c["x_mm"]])
    force = np.array([v for c in mine for v in c["fx_N"]])
    order = np.argsort(x, kind="stable")
    return x[order], force[order]
