"""A plan on a terminal of 80 columns."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np
from rich.console import Console
from rich.markup import escape
from rich.table import Table
from rich.text import Text
from scipy.sparse.csgraph import connected_components

from pipeline.plan.record import Plan, Size
from pipeline.terminal import WIDTH, blocks, cell, lean, one_line, terminal
from reports.quantities import short

ALIKE = 0.95
PARAMETER, UNIT, RIVAL, EFFECT = 21, 10, 16, 29
"""Cells of names and units; longer ones go on below."""


def show(plan: Plan, quiet: bool, console: Console | None = None, full: bool = False) -> None:
    """One line of headline, what these tests do not show or tell apart, the next test. full: all sizes, the isolability
    matrix, and why an effect cannot be looked for."""
    out = terminal(console)
    if not quiet:
        out.print(Text(f"{headline(plan)}\n"))
        for part in _whole(plan, out.width) if full else _open(plan):
            out.print(part)
    for said in (plan.untested, *(f"{each}." for each in plan.not_done)):
        if said:
            out.print(escape(said))
    if plan.unmeasured:
        out.print(escape(f"Not measured yet, sensors as in [noise]: {', '.join(plan.unmeasured)}."))
    for sentence in following(plan):
        out.print(escape(sentence))


def headline(plan: Plan) -> str:
    """How many typical sizes these tests show and tell apart, in one line."""
    there = [size for size in plan.sizes if size.typical]
    shown, apart = (
        sum(value is not None and value <= size.typical for value, size in zip(values, there, strict=True))
        for values in ([s.detected for s in there], [s.apart for s in there])
    )
    said = f"of {len(there)} parameters these tests show {shown} at typical size, tell apart {apart}"
    return one_line(f"{plan.campaign}: {said}", said)


def _whole(plan: Plan, width: int) -> Iterator[Table | str]:
    for table in tables(plan, width):
        yield table
        yield ""
    for name, why in plan.refused.items():
        yield escape(f"{name} cannot be looked for: {why}")


def _open(plan: Plan) -> Iterator[Table | str]:
    """What is worth a look: sizes that are not enough, pairs that can hardly be told apart."""
    if missed := [
        size for size in plan.sizes if not (_enough(size.detected, size) and _enough(size.apart, size))
    ]:
        yield _sizes(missed, "parameters that these tests do not show, or not apart, at typical size")
        yield ""
    for group in _alike(plan):
        yield escape(
            f"Hardly to be told from another of these, {100 * ALIKE:.0f} % alike and more: {', '.join(group)}."
        )
    if plan.refused:
        yield escape(f"Not looked for here: {', '.join(plan.refused)}.")
    yield f"Every parameter and pair{', and why not' if plan.refused else ''}: see --full."
    yield ""


def _alike(plan: Plan) -> list[list[str]]:
    """Groups of effects, each of them like another one of its group."""
    count, group = connected_components(np.array(plan.alike) >= ALIKE) if plan.names else (0, np.array([]))
    every = ([plan.names[k] for k in np.flatnonzero(group == number)] for number in range(count))
    return [names for names in every if len(names) > 1]


def tables(plan: Plan, width: int = WIDTH) -> tuple[Table, ...]:
    """Sizes, and the isolability matrix in as many tables as it takes."""
    title = f"{plan.campaign}: smallest sizes that these tests show, from null"
    return (_sizes(plan.sizes, title), *_matrix(plan, width))


def _sizes(sizes: Sequence[Size], title: str) -> Table:
    table = lean("parameter", "typical", "detected", "told\napart", title=title)
    table.add_column("unit", overflow="fold")
    table.add_column("hardest rival", overflow="fold")
    table.add_column("ρ", justify="right", overflow="fold")
    effect = ""
    for size in sizes:
        if size.effect != effect:
            effect = size.effect
            table.add_row(cell(effect, PARAMETER, "bold"))
        table.add_row(
            cell(size.parameter, PARAMETER),
            short(size.typical, 2),
            _number(size.detected, size),
            _number(size.apart, size),
            cell("" if size.unit == "1" else size.unit, UNIT),
            cell(size.rival, RIVAL),
            f"{size.rho:.3f}",
        )
    table.caption = (
        "detected in 90 % of cases, told from the rival in 95 %; –: not below a thousand typical sizes; "
        "bold: a typical size is not enough"
    )
    return table


def _number(value: float | None, size: Size) -> str:
    text = short(value, 2)
    return text if value is None or _enough(value, size) else f"[bold]{text}[/bold]"


def _enough(value: float | None, size: Size) -> bool:
    return value is not None and value <= size.typical


def _matrix(plan: Plan, width: int = WIDTH) -> Iterator[Table]:
    """As many columns beside each other as fit, the others below."""
    title = "isolability: correlation of an effect (row) with another (column)"
    parts = blocks([3] * len(plan.names), width - EFFECT)
    for part in parts:
        table = lean("", *(str(k + 1) for k in part), title=title if part is parts[0] else "")
        for k, (name, row) in enumerate(zip(plan.names, plan.alike, strict=True)):
            cells = ["·" if j == k else _cell(row[j]) for j in part]
            table.add_row(cell(f"{k + 1} {name}", EFFECT), *cells)
        if part is parts[-1]:
            table.caption = "in hundredths; bold: 95 and more, hardly to be told apart; blank: below 30"
        yield table


def _cell(value: float) -> str:
    # Rounded down: 100 is for what cannot be told apart at all.
    text = "" if value < 0.3 else f"{int(100 * min(value, 1.0) + 1e-6)}"
    return f"[bold]{text}[/bold]" if value >= ALIKE else text


def following(plan: Plan) -> list[str]:
    """The next test in words, and what it is good for."""
    if plan.next_test is None:
        return ["No further test of the usual kinds adds anything to these."]
    newly = plan.next_test["newly"]
    gain = (
        f"It would tell apart, at typical size: {', '.join(newly)}."
        if newly
        else "It makes all sizes smaller."
    )
    return [f"Next test: {plan.next_test['why']}.", gain]
