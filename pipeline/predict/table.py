"""Predicted readings on a terminal of 80 columns."""

from __future__ import annotations

from collections.abc import Iterable

from rich.console import Console
from rich.markup import escape
from rich.table import Table
from rich.text import Text

from pipeline.predict.record import Counted, PredictedRow, Predictions
from pipeline.terminal import cell, lean, one_line, terminal
from reports.quantities import short

FEW = 12
"""Readings of a table of load cases that are listed one by one, at most."""
NAME = 18
ROUNDING = 1e-6
"""Of the width of an interval: a reading that is no larger is zero but for rounding."""


def show(it: Predictions, following: Iterable[str], quiet: bool, console: Console | None = None) -> None:
    """Print the headline; unless quiet also the intervals by column, few readings one by one, and all sentences."""
    out = terminal(console)
    out.print(escape(it.sentences[0]))
    if quiet:
        return
    out.print("")
    for table in listed(it):
        out.print(table, "")
    for sentence in it.sentences[1:]:
        out.print(escape(sentence))
    for said in following:
        out.print(escape(said), soft_wrap=True)


def headline(it: Predictions) -> str:
    """How many readings are predicted, and how many of those that were made lie inside, in one line."""
    count, rows = sum(len(row.readings) for row in it.rows), len(it.rows)
    said = f"{count} {'reading' if count == 1 else 'readings'} at {rows} {'row' if rows == 1 else 'rows'}"
    counts, name = (it.held_out, "not fitted") if it.held_out.of else (it.fitted, "fitted")
    if not counts.of:
        return one_line(f"{it.campaign}: {said} predicted", f"{said} predicted")
    inside = f"95 % intervals hold {_inside(counts)} {name}"
    return one_line(f"{it.campaign}: {said}, {inside}", f"{said}, {inside}", inside)


def listed(it: Predictions) -> tuple[Table, ...]:
    """The tables: intervals by column, and few readings of load cases one by one."""
    if not it.columns:
        return ()
    asked = [row for row in it.rows if row.role == "asked"]
    few = 0 < sum(len(row.readings) for row in asked) <= FEW * 6
    return (by_column(it), one_by_one(asked)) if few else (by_column(it),)


def by_column(it: Predictions) -> Table:
    """Half width of the intervals and its parts, each as a standard deviation, and how many readings lie inside."""
    title = f"{it.campaign}: 95 % interval of a reading; parts as standard deviations"
    table = lean("column", "± 95 %", "parameters", "tolerances", "noise", "inside, not fitted", title=title)
    for each in it.columns:
        parts = (each.half_width, each.parameters, each.tolerances, each.noise)
        table.add_row(
            cell(each.column, NAME), *(f"  {short(value)}" for value in parts), _inside(each.held_out)
        )
    return table


def _inside(it: Counted) -> str:
    return f"{100.0 * it.inside / it.of:.1f} % of {it.of}" if it.of else "–"


def one_by_one(rows: Iterable[PredictedRow]) -> Table:
    """Every predicted reading with its interval."""
    table = lean("test", "step", "column", "predicted", "from", "to", title="predicted readings")
    for row in rows:
        for k, each in enumerate(row.readings):
            name = cell(f"{row.test}{' (beyond)' if row.beyond else ''}", NAME) if k == 0 else Text("")
            step = str(row.step) if k == 0 else ""
            small = ROUNDING * (each.high95 - each.low95)
            told = (0.0 if abs(value) < small else value for value in (each.value, each.low95, each.high95))
            ends = (f"  {short(value, 4)}" for value in told)
            table.add_row(name, step, f" {each.column}", *ends)
    return table
