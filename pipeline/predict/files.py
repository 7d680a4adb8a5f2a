"""Predicted readings as files: a table of every reading, and the correction table of a machine."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable

from pipeline.campaign.names import DISPLACEMENTS, PLACES, TEMPERATURE, WRENCHES
from pipeline.errors import InputError
from pipeline.predict.bands import Z
from pipeline.predict.record import PredictedRow, Predictions

HEAD = (
    *("test", "step", "role", "q_deg", *PLACES, "column", "value", "low95", "high95"),
    *("parameters", "tolerances", "noise", "measured", "inside", "sampled", "beyond"),
)


def readings_table(it: Predictions) -> str:
    """CSV, one line a reading; prescribed columns as they were prescribed stand beside."""
    head, lines = reading_lines(it)
    return _written([head, *lines])


def reading_lines(it: Predictions) -> tuple[list[str], list[list[object]]]:
    """Heads and one line a reading, None for what is not there; numbers in the unit of the reading's column."""
    given = list(dict.fromkeys(column for row in it.rows for column in row.inputs))
    changed = list(dict.fromkeys(key for row in it.rows for key in row.values))
    lines: list[list[object]] = []
    for row in it.rows:
        beside = [row.inputs.get(column) for column in given] + [row.values.get(key) for key in changed]
        where = [row.test, row.step, row.role, row.q_deg, *(row.at_mm or (None, None, None))]
        last = [int(row.sampled), "; ".join(row.beyond)]
        for each in row.readings:
            numbers = [each.value, each.low95, each.high95, each.parameters, each.tolerances, each.noise]
            seen = [each.measured, None if each.inside is None else int(each.inside)]
            lines.append([*where, each.column, *numbers, *seen, *last, *beside])
    return [*HEAD, *(f"given.{column}" for column in given), *changed], lines


def compensation_table(it: Predictions) -> str:
    """CSV, one line a row: posture, wrench, and the deflection that the wrench makes, to be subtracted from what is
    commanded, with half the width of its 95 % interval without the noise of a reading.

    InputError for a row of which a coordinate of the platform is prescribed, or that has no stable state.
    """
    loads = [*WRENCHES, TEMPERATURE]
    moved = [f"d{column}" for column in DISPLACEMENTS]
    lines: list[list[object]] = [
        ["test", "step", "q_deg", *PLACES, *loads, *moved, *(f"{name}_half95" for name in moved), "beyond"]
    ]
    for row in it.rows:
        found = {each.column: each for each in row.readings}
        _compensable(row, found)
        values = [_number(found[column].value) for column in DISPLACEMENTS]
        halves = [
            _number(Z * (found[column].parameters ** 2 + found[column].tolerances ** 2) ** 0.5)
            for column in DISPLACEMENTS
        ]
        where = [row.test, row.step, row.q_deg, *(row.at_mm or ("", "", ""))]
        lines.append(
            [*where, *(row.inputs.get(c, "") for c in loads), *values, *halves, "; ".join(row.beyond)]
        )
    return _written(lines)


def _compensable(row: PredictedRow, found: Iterable[str]) -> None:
    place = f"--compensation: {row.test}, step {row.step}"
    if row.lost:
        raise InputError(f"{place}: has no prediction: {row.lost}; allowed are loads that the machine bears")
    held = [column for column in DISPLACEMENTS if column in row.inputs]
    if held or not set(DISPLACEMENTS) <= set(found):
        named = ", ".join(held) or "a coordinate"
        raise InputError(
            f"{place}: {named} is prescribed, allowed are rows of which all six coordinates are loaded: give them by "
            "--at, with at_x_mm, at_y_mm, at_z_mm and the columns of forces and moments, and without test"
        )


def _number(value: float) -> str:
    return f"{value:.9g}"


def _written(lines: Iterable[Iterable[object]]) -> str:
    text = io.StringIO(newline="")
    csv.writer(text, lineterminator="\n").writerows(lines)
    return text.getvalue()
