"""Technical drawing by matplotlib: what its drawings share."""

import io
import re
from math import hypot

from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from reports.style import FAINT, INK

Point = tuple[float, float]


def save(figure: Figure, name: str) -> tuple[str, bytes]:
    """The figure as SVG for the page and PNG for Markdown, the same bytes every time."""
    drawing, picture = io.StringIO(), io.BytesIO()
    with rc_context({"svg.hashsalt": name}):
        figure.savefig(drawing, format="svg", bbox_inches="tight", metadata={"Date": None, "Creator": None})
    figure.savefig(picture, format="png", dpi=170, bbox_inches="tight", metadata={"Software": None})
    text = drawing.getvalue()
    text = text[text.index("<svg") :]
    # In a page two drawings must not share an id, and a style element would reach beyond the drawing.
    text = re.sub(r'(\bid="|href="#|url\(#)', rf"\g<1>{name}-", text)
    text = re.sub(r"<style.*?</style>|<metadata>.*?</metadata>", "", text, flags=re.DOTALL)
    text = text.replace(
        "<svg", '<svg class="drawing" style="stroke-linejoin: round; stroke-linecap: butt"', 1
    )
    return text, picture.getvalue()


def arrow(
    ax: Axes, tail: Point, head: Point, colour: str = INK, style: str = "-|>", width: float = 1.2
) -> None:
    """An arrow from tail to head, data coordinates."""
    look = {
        "arrowstyle": style,
        "color": colour,
        "lw": width,
        "shrinkA": 0,
        "shrinkB": 0,
        "mutation_scale": 10,
    }
    ax.annotate("", xy=head, xytext=tail, arrowprops=look)


def dimension(ax: Axes, a: Point, b: Point, offset: float, text: str, gap: float) -> None:
    """A dimension line beside a -> b, `offset` to the left of that direction, its text `gap` beyond."""
    length = hypot(b[0] - a[0], b[1] - a[1])
    nx, ny = -(b[1] - a[1]) / length, (b[0] - a[0]) / length
    ends = [(p[0] + nx * offset, p[1] + ny * offset) for p in (a, b)]
    for p, end in zip((a, b), ends, strict=True):
        ax.plot([p[0], end[0]], [p[1], end[1]], color=FAINT, lw=0.7, zorder=1)
    arrow(ax, ends[0], ends[1], FAINT, "<|-|>", 0.8)
    reach = offset + (gap if offset > 0 else -gap)
    middle = ((a[0] + b[0]) / 2 + nx * reach, (a[1] + b[1]) / 2 + ny * reach)
    ax.text(*middle, text, ha="center", va="center", color=INK)
