"""Errors in sigmas as bars: plain HTML with its styles inside, for a page, the studio and a notebook."""

from collections.abc import Iterator
from math import log10

from markupsafe import Markup

from reports.blocks import Bar, Bars
from reports.quantities import sigma
from reports.style import INK

LEAST = 0.3
"""Sigmas where the bars begin; noise makes one."""
FILLS = (
    "background:#0072B2",
    "background:repeating-linear-gradient(135deg,#b9d6e8 0 5px,#0072B2 5px 7px)",
)
"""Of the series, told apart by pattern and shade: a hue of its own would draw the eye to what is fine."""
_ROW = (
    '<div style="display:flex;align-items:center;gap:8px;font-size:13px;line-height:1.15">'
    '<span style="flex:0 0 5.2em;color:#4a5661;font-size:12px">{}</span>'
    '<span style="flex:1;position:relative;height:11px;background:#f1f4f6">'
    '<span style="position:absolute;inset:0 auto 0 0;width:{}%;{}"></span>'
    '<span style="position:absolute;inset:-3px auto -3px {}%;border-left:1.5px dashed {}"></span></span>'
    '<span style="flex:0 0 3.6em;text-align:right;font-variant-numeric:tabular-nums;color:{}">{}</span></div>'
)


def html(block: Bars) -> Markup:
    """The bars, one group for each row, on one logarithmic scale."""
    every = [value for row in block.rows for value in row.values if value is not None]
    top = max([3.0, *every]) * 1.15
    noise = _share(1.0, top)
    parts = [part for row in block.rows for part in _group(row, block, top, noise)]
    legend = Markup(
        '<div style="font-size:12px;color:#4a5661">error in sigmas, logarithmic; dashed: noise</div>'
    )
    return Markup('<div class="bars">') + Markup("").join(parts) + legend + Markup("</div>")


def _group(row: Bar, block: Bars, top: float, noise: float) -> Iterator[Markup]:
    code = (
        Markup(' <code style="font-size:11px;color:#4a5661">{}</code>').format(row.code) if row.code else ""
    )
    yield Markup('<div style="margin:6px 0 8px"><div style="font-size:13px">{}{}</div>').format(
        row.label, code
    )
    for name, fill, value in zip(block.series, FILLS, row.values, strict=False):
        if value is not None:
            yield Markup(_ROW).format(name, _share(value, top), fill, noise, INK, INK, sigma(value))
    yield Markup("</div>")


def _share(value: float, top: float) -> float:
    """Per cent of the way."""
    way = log10(max(value, LEAST) / LEAST) / log10(top / LEAST)
    return round(100.0 * min(max(way, 0.006), 1.0), 2)
