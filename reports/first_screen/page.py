"""The first screen as HTML: verdict, picture, what is certain, what to do next, and the numbers in a table."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from html import escape

from reports.quantities import short
from reports.style import ACCENT, FAINT, GRID, INK

ROWS, CELL, LINES, LETTERS = 40, 90, 8, 600
"""Rows of the table, letters of a cell, sentences of a list and letters of a sentence, at most."""
SAID = {
    "identified": "#00734f",
    "within_noise": "#00734f",
    "ambiguous": "#8a5a00",
    "unknown": "#a63d00",
    "nothing_tested": "#5b6570",
}
"""Colours of verdicts, each at a contrast of 4.5 or more on white."""


@dataclass(frozen=True)
class Screen:
    """What is shown. verdict: one word or "". sure, beyond, following: sentences. rows: cells by columns.
    picture: a PNG in base64; picture_says: the same in words."""

    headline: str
    verdict: str
    sure: tuple[str, ...]
    beyond: tuple[str, ...]
    following: tuple[str, ...]
    columns: tuple[str, ...]
    rows: tuple[tuple[object, ...], ...]
    picture: str
    picture_says: str


def screen(it: Screen) -> str:
    """A piece of HTML that needs no script, no style sheet and nothing from outside."""
    return (
        f'<div style="max-width:960px;color:{INK};background:#fff;font-family:system-ui,sans-serif;padding:12px;'
        f'border:1px solid {GRID};border-radius:6px">{"".join(_parts(it))}</div>'
    )


def document(title: str, body: str) -> str:
    """The same as a page of its own."""
    return (
        f'<!doctype html><html lang="en"><head><meta charset="utf-8"><title>{escape(title)}</title></head>'
        f"<body>{body}</body></html>\n"
    )


def _parts(it: Screen) -> Iterator[str]:
    head = _limited(it.headline, LETTERS)
    if it.verdict:
        head = head.removeprefix(f"{it.verdict}: ")
        yield (
            f'<span style="background:{SAID.get(it.verdict, INK)};color:#fff;padding:2px 8px;border-radius:4px">'
            f"{escape(it.verdict.replace('_', ' '))}</span>"
        )
    yield f'<p style="font-size:1.15em;margin:8px 0">{escape(head)}</p>'
    if it.picture:
        says = escape(_limited(it.picture_says, LETTERS), quote=True)
        yield f'<img style="max-width:100%" alt="{says}" src="data:image/png;base64,{it.picture}">'
    lists = (
        ("What is certain", it.sure),
        ("Laws beyond the catalogue", it.beyond),
        ("Next", it.following),
    )
    for title, sentences in lists:
        if sentences:
            yield f'<h4 style="margin:10px 0 2px">{title}</h4><ul style="margin:0">{"".join(_items(sentences))}</ul>'
    if it.rows:
        yield _table(it)


def _items(sentences: tuple[str, ...]) -> Iterator[str]:
    for said in sentences[:LINES]:
        yield f"<li>{escape(_limited(said, LETTERS))}</li>"
    if len(sentences) > LINES:
        yield f"<li>and {len(sentences) - LINES} more</li>"


def _table(it: Screen) -> str:
    head = "".join(
        f'<th style="text-align:left;padding:2px 8px;border-bottom:1px solid {FAINT}">{escape(c)}</th>'
        for c in it.columns
    )
    body = "".join(f"<tr>{''.join(_cells(row))}</tr>" for row in it.rows[:ROWS])
    rest = len(it.rows) - ROWS
    more = f'<p style="margin:4px 8px">and {rest} more rows, see to_frame()</p>' if rest > 0 else ""
    style = f"border-collapse:collapse;margin-top:10px;font-size:0.9em;border-top:2px solid {ACCENT}"
    return (
        f'<div style="overflow-x:auto"><table style="{style}"><thead><tr>{head}</tr></thead>'
        f"<tbody>{body}</tbody></table>{more}</div>"
    )


def _cells(row: Iterable[object]) -> Iterator[str]:
    for value in row:
        number = isinstance(value, int | float) and not isinstance(value, bool)
        side = "right;white-space:nowrap" if number else "left"
        yield f'<td style="text-align:{side};padding:2px 8px">{escape(_limited(_said(value), CELL))}</td>'


def _said(value: object) -> str:
    if value is None or value != value:
        return "–"
    return short(value, 4) if isinstance(value, float) else str(value)


def _limited(text: str, letters: int) -> str:
    return text if len(text) <= letters else f"{text[: letters - 4]} ..."
