"""The page: one HTML file with everything inside it."""

import base64
import json
from collections import Counter
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import plotly.io
from jinja2 import Environment, FileSystemLoader, StrictUndefined
from markupsafe import Markup
from plotly.offline import get_plotlyjs

from reports import bars
from reports.blocks import Block, Columns, Details, Explorer, Figure, Section

TEMPLATES = Path(__file__).parent / "templates"
CONFIG = {"responsive": True, "displaylogo": False}
SHORT = 40
"""Characters up to which a part is cheaper where it stands."""
KEY = "$"


def render(title: str, sections: Sequence[Section], template: str = "validation.html.j2") -> str:
    """The HTML text; the same sections give the same bytes."""
    page = _environment().get_template(template)
    return page.render(title=title, sections=sections, plotlyjs=Markup(get_plotlyjs())) + "\n"


def screen(section: Section) -> str:
    """One section as a piece of HTML for another page, with all that it needs: no script, nothing from outside.

    ValueError for a section with a plot, which needs a script.
    """
    if any(
        isinstance(it, Explorer) or getattr(it, "plot", None) is not None
        for it in every_block(section.blocks)
    ):
        raise ValueError(f"the section {section.title!r} has a plot, allowed are drawings and pictures")
    return _environment().get_template("first_screen.html.j2").render(section=section) + "\n"


def every_block(blocks: Sequence[Block]) -> Iterator[Block]:
    """Blocks, and those inside of blocks."""
    for it in blocks:
        yield it
        if isinstance(it, Columns):
            yield from every_block([*it.left, *it.right])
        elif isinstance(it, Details):
            yield from every_block(it.blocks)


def _environment() -> Environment:
    environment = Environment(
        loader=FileSystemLoader(TEMPLATES),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.filters["block_kind"] = lambda block: type(block).__name__
    environment.filters["picture"] = picture
    environment.filters["explorer"] = explorer
    environment.filters["height"] = height
    environment.filters["bars"] = bars.html
    return environment


def picture(figure: Figure) -> Markup:
    """The plot, else the drawing, else the picture, as HTML."""
    if figure.plot is not None:
        return plotted(f"plot-{figure.name}", figure.plot)
    if figure.svg:
        said = Markup('<svg role="img" aria-label="{}" ').format(figure.caption)
        return said + Markup(figure.svg.removeprefix("<svg "))
    data = base64.b64encode(figure.png).decode("ascii")
    return Markup('<img alt="{}" src="data:image/png;base64,{}">').format(figure.caption, data)


def plotted(name: str, plot: Any) -> Markup:
    """The place of a plot, as high as it will be, and what plotly.js draws there, as JSON."""
    said = {**json.loads(plotly.io.to_json(plot)), "config": CONFIG}
    place = '<div id="{0}" class="plot" style="min-height: {1}px"></div>'
    data = '<script type="application/json" class="plot-data" data-plot="{0}">{2}</script>'
    return Markup(place + data).format(name, said["layout"]["height"], _json(said))


def height(block: Explorer) -> int:
    """Pixels of the plot that is shown first."""
    return int(block.plots[block.first]["layout"]["height"])


def explorer(block: Explorer) -> Markup:
    """The plots of an explorer, and what its script needs, as JSON."""
    plots, pool = pooled([[*key, plot] for key, plot in block.plots.items()])
    said = {
        "name": block.name,
        "plots": plots,
        "pool": pool,
        "first": block.first,
        "linked": block.linked,
        "config": CONFIG,
    }
    return _json(said)


def pooled(items: Sequence[Any]) -> tuple[list[Any], list[Any]]:
    """JSON without its repetitions: the items with every longer part that occurs twice as {"$": number}, and the pool
    by number."""
    counts: Counter[str] = Counter()
    for item in items:
        _count(item, counts)
    numbers: dict[str, int] = {}
    pool: list[Any] = []

    def replaced(part: Any) -> Any:
        if not isinstance(part, dict | list):
            return part
        text = json.dumps(part, sort_keys=True)
        if len(text) <= SHORT or counts[text] < 2:
            return _inside(part, replaced)
        if text not in numbers:
            inner = _inside(part, replaced)
            numbers[text] = len(pool)
            pool.append(inner)
        return {KEY: numbers[text]}

    return [replaced(item) for item in items], pool


def _count(part: Any, counts: Counter[str]) -> None:
    """Every part once for each place; inside of what has been seen nothing is counted again."""
    if not isinstance(part, dict | list):
        return
    text = json.dumps(part, sort_keys=True)
    counts[text] += 1
    if counts[text] == 1:
        for inner in part.values() if isinstance(part, dict) else part:
            _count(inner, counts)


def _inside(part: Any, change: Any) -> Any:
    if isinstance(part, dict):
        return {key: change(value) for key, value in part.items()}
    return [change(value) for value in part]


def _json(said: Any) -> Markup:
    # A closing tag inside a script element would end it.
    return Markup(json.dumps(said, ensure_ascii=False, separators=(",", ":")).replace("</", "<\\/"))
