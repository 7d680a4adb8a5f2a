"""Predicted readings with their bands, one history."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from reports.first_screen.drawn import Picture
from reports.prediction import draw, histories
from reports.style import INK

Json = Mapping[str, Any]


def predictions(record: Json, test: str | None = None) -> Picture:
    """A history by name, or the first that was not fitted; histories of one load step each together, as rows."""
    named = {name: rows for name, rows in histories(record).items() if any(row["readings"] for row in rows)}
    figure = Picture()
    if test is None and len(named) > 1 and all(len(rows) == 1 for rows in named.values()):
        rows: list[Json] = [{**row, "step": k} for k, (row,) in enumerate(named.values(), start=1)]
        draw(figure, f"{record['campaign']}: {len(rows)} load cases", rows, "number of the load case")
    elif named and (test is None or test in named):
        name = next(iter(named)) if test is None else test
        draw(figure, f"{record['campaign']}: {name}", named[name])
    else:
        figure.text(0.5, 0.5, "the model has no state to predict", ha="center", va="center", color=INK)
    return figure
