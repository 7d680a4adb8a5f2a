"""The page: one HTML file with everything inside it."""

import base64
import json
from collections.abc import Sequence
from pathlib import Path

import plotly.io
from jinja2 import Environment, FileSystemLoader, StrictUndefined
from markupsafe import Markup
from plotly.offline import get_plotlyjs

from reports.blocks import Explorer, Figure, Section
from reports.pooling import pooled

TEMPLATES = Path(__file__).parent / "templates"
CONFIG = {"responsive": True, "displaylogo": False}


def render(title: str, sections: Sequence[Section], template: str = "validation.html.j2") -> str:
    """The HTML text; the same sections give the same bytes."""
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
    page = environment.get_template(template)
    return page.render(title=title, sections=sections, plotlyjs=Markup(get_plotlyjs())) + "\n"


def picture(figure: Figure) -> Markup:
    """The plot, else the drawing, else the picture, as HTML."""
    if figure.plot is not None:
        html = plotly.io.to_html(
            figure.plot, include_plotlyjs=False, full_html=False, div_id=f"plot-{figure.name}", config=CONFIG
        )
        return Markup(html)
    if figure.svg:
        return Markup(figure.svg)
    data = base64.b64encode(figure.png).decode("ascii")
    return Markup('<img alt="{}" src="data:image/png;base64,{}">').format(figure.caption, data)


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
    # A closing tag inside a script element would end it.
    return Markup(json.dumps(said, ensure_ascii=False, separators=(",", ":")).replace("</", "<\\/"))
