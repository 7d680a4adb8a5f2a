"""Static charts by matplotlib for the Markdown twin: convergence and force-deflection."""

import io

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from reports.curves import Panel, panels
from reports.formats import fixed, symbol
from reports.load import Json
from reports.plots import distances
from reports.style import CYCLE, FAINT, GRID, INK


def picture(figure: Figure) -> bytes:
    """The figure as PNG, the same bytes every time."""
    out = io.BytesIO()
    figure.savefig(out, format="png", dpi=150, bbox_inches="tight", metadata={"Software": None})
    return out.getvalue()


def dress(ax: Axes) -> None:
    """Grid and frame as in the page."""
    ax.grid(color=GRID, lw=0.7)
    ax.set_axisbelow(True)
    ax.tick_params(colors=INK)
    for side in ("top", "right"):
        ax.spines[side].set_visible(False)
    for side in ("left", "bottom"):
        ax.spines[side].set_color(FAINT)


def convergence(result: Json) -> bytes:
    """Distance of each entry of K_b to its extrapolated value against dofs."""
    figure = Figure(figsize=(8.6, 4.8))
    ax = figure.subplots()
    record = result["bar"]["convergence"]
    for (entry, (dofs, off)), colour, marker in zip(
        distances(record).items(), CYCLE, "os^Dv<>P", strict=False
    ):
        label = f"{symbol(entry)}, order {fixed(record['orders'][entry] or None, 2)}"
        ax.loglog(dofs, off, marker=marker, color=colour, lw=1.4, ms=5, label=label)
    ax.axvline(result["bar"]["dofs"], color=FAINT, ls="--", lw=1)
    ax.set_xlabel("degrees of freedom")
    ax.set_ylabel("|K / K extrapolated − 1|")
    dress(ax)
    ax.legend(loc="center left", bbox_to_anchor=(1.01, 0.5), frameon=False)
    return picture(figure)


def force_deflection(result: Json) -> bytes:
    """Fig. 3 as small multiples: a row for each q, a column for each held set."""
    found = panels(result)
    rows = list(dict.fromkeys(p.q_deg for p in found))
    columns = max(sum(p.q_deg == q for p in found) for q in rows)
    figure = Figure(figsize=(5.8 * columns, 3.9 * len(rows)))
    grid = figure.subplots(len(rows), columns, squeeze=False)
    for line, q in zip(grid, rows, strict=True):
        here = [p for p in found if p.q_deg == q]
        for ax, panel in zip(line, here, strict=False):
            draw(ax, panel)
        for ax in line[len(here) :]:
            ax.axis("off")
    figure.tight_layout(w_pad=2.0, h_pad=2.0)
    handles = {
        h.get_label(): h for ax in grid.flat for h in ax.get_lines() if not h.get_label().startswith("_")
    }
    figure.legend(
        handles.values(),
        handles.keys(),
        loc="upper center",
        bbox_to_anchor=(0.5, 0.0),
        ncols=4,
        frameon=False,
    )
    return picture(figure)


def draw(ax: Axes, panel: Panel) -> None:
    """One held set at one angle."""
    styles = {"solid": "-", "dash": "--", "dot": ":"}
    for line in panel.lines:
        label = line.label if line.named else f"_{line.label}"
        ax.plot(line.x, line.y, color=line.colour, ls=styles[line.dash], lw=0.75 * line.width, label=label)
    for level in panel.levels:
        ax.axhline(level.load, color=level.colour, lw=0.9, ls=(0, (5, 3)))
    for place, text in panel.level_labels():
        ax.annotate(
            text,
            (1.0, place),
            xycoords=("axes fraction", "data"),
            xytext=(4, 0),
            textcoords="offset points",
            ha="left",
            va="center",
            fontsize=7.5,
            color=INK,
        )
    ax.set_xlim(*panel.x_range)
    ax.set_ylim(*panel.y_range)
    ax.set_title(panel.title, fontsize=9.5, color=INK, loc="left")
    ax.set_xlabel("shortening −x, mm")
    ax.set_ylabel("compression −F$_x$, kN")
    dress(ax)
