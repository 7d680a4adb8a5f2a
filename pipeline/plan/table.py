"""A plan on a terminal of 100 columns."""

from __future__ import annotations

from rich.box import SIMPLE_HEAD
from rich.console import Console
from rich.markup import escape
from rich.table import Table

from pipeline.add.table import WIDTH
from pipeline.plan.record import Plan, Size

ALIKE, CLOSE = 0.95, 0.8


def show(plan: Plan, quiet: bool) -> None:
    """Sizes, the isolability matrix, the next test."""
    out = Console(highlight=False)
    if out.width > WIDTH or not out.is_terminal:
        out.width = WIDTH
    if not quiet:
        out.print(_sizes(plan))
        out.print(_matrix(plan))
        for name, why in plan.refused.items():
            out.print(f"{name} cannot be looked for: {escape(why)}")
    if plan.unmeasured:
        out.print(
            escape(f"Not measured yet, sensors as in [noise]: {', '.join(plan.unmeasured)}."), soft_wrap=True
        )
    for sentence in following(plan):
        out.print(escape(sentence))


def _sizes(plan: Plan) -> Table:
    title = f"{escape(plan.campaign)}: smallest sizes that these tests show, from null"
    table = Table(title=title, title_justify="left", box=SIMPLE_HEAD, padding=(0, 1, 0, 0))
    table.add_column("number", no_wrap=True)
    for name in ("typical", "detected", "told apart"):
        table.add_column(name, justify="right", no_wrap=True, min_width=len(name))
    table.add_column("unit", no_wrap=True, min_width=11)
    table.add_column("hardest rival", no_wrap=True, max_width=20)
    table.add_column("ρ", justify="right", no_wrap=True, min_width=5)
    effect = ""
    for size in plan.sizes:
        if size.effect != effect:
            effect = size.effect
            table.add_row(f"[bold]{escape(effect)}")
        table.add_row(
            f"  {escape(size.parameter)}",
            f"{size.typical:.2g}",
            _number(size.detected, size),
            _number(size.apart, size),
            escape(size.unit),
            escape(size.rival),
            f"{size.rho:.3f}",
        )
    table.caption = (
        "detected in 90 % of cases, told from the rival in 95 %; –: not below a thousand typical sizes; "
        "bold: a typical size is not enough"
    )
    return table


def _number(value: float | None, size: Size) -> str:
    if value is None:
        return "–"
    text = f"{value:.2g}"
    return f"[bold]{text}[/bold]" if value > size.typical else text


def _matrix(plan: Plan) -> Table:
    title = "isolability: correlation of an effect (row) with another (column)"
    table = Table(title=title, title_justify="left", box=SIMPLE_HEAD, padding=(0, 1, 0, 0))
    table.add_column("", no_wrap=True, min_width=28)
    for k in range(len(plan.names)):
        table.add_column(str(k + 1), justify="right", no_wrap=True, min_width=2)
    for k, (name, row) in enumerate(zip(plan.names, plan.alike, strict=True)):
        cells = ["·" if j == k else _cell(value) for j, value in enumerate(row)]
        table.add_row(f"{k + 1} {escape(name)}", *cells)
    table.caption = "in hundredths; bold: 95 and more, hardly to be told apart; blank: below 30"
    return table


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
