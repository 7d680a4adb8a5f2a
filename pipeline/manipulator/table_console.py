"""Table 1 on a terminal of 80 columns."""

from rich.console import Console
from rich.markup import escape
from rich.table import Table

from pipeline.manipulator.table_record import UNITS, Cell, Table1, Unknown
from pipeline.terminal import lean, terminal
from reports.quantities import AT_BOUND, percent, short


def show(result: Table1, quiet: bool = False, console: Console | None = None) -> None:
    """Print the cells beside the paper's; unless quiet, also what was fitted, the readings and the findings."""
    out = terminal(console)
    out.print(f"{counts(result)}\n")
    out.print(_cells(result))
    if quiet:
        return
    out.print("", _unknowns(result), "")
    out.print(_readings(result), "")
    for finding in result.findings:
        answer = "yes" if finding.holds else "no"
        out.print(f"{escape(finding.statement)} [bold]{answer}[/bold]: {escape(finding.found)}")
    worst = max(max(a.K_tran, a.K_rot) for a in result.agreement)
    postures = max(a.postures for a in result.agreement)
    out.print(
        f"VJM against finite elements: within {short(100 * worst, 2)} % at {postures} postures, all linkages."
    )


def counts(result: Table1) -> str:
    """How many numbers were fitted and how many cells predicted."""
    worst = max(abs(c.deviation) for c in result.cells if c.deviation is not None and not c.fitted)
    return (
        f"{len(result.unknowns)} numbers fitted to {result.fitted} cells, {result.predicted} cells predicted, "
        f"worst {percent(worst)}."
    )


def _cells(result: Table1) -> Table:
    table = lean(title="Table 1, isotropic posture")
    for name in ("linkage", "model", "quantity"):
        table.add_column(name, overflow="fold")
    for name in ("paper", "here", "deviation"):
        table.add_column(name, justify="right", overflow="fold")
    table.add_column("", overflow="fold")
    for cell in result.cells:
        table.add_row(*_cell(cell))
    return table


def _cell(c: Cell) -> tuple[str, ...]:
    paper = "" if c.paper is None else _number(c.paper)
    deviation = "" if c.deviation is None else f"{100 * c.deviation:+.1f} %".replace("-0.0", "+0.0")
    role = "fitted" if c.fitted else "predicted" if c.paper is not None else "not in the paper"
    what = (escape(c.linkage), c.model.upper(), f"{c.quantity}, {UNITS[c.quantity]}")
    return (*what, paper, _number(c.ours), deviation, role)


def _number(value: float) -> str:
    """The three digits that the paper prints, four where they are whole."""
    return f"{value:.0f}" if abs(value) < 1e4 else f"{value:.2e}"


def _unknowns(result: Table1) -> Table:
    table = lean("unknown", "value", title="Numbers that the paper does not give")
    table.add_column("plausible", overflow="fold")
    table.add_column("fixed by the cell", overflow="fold")
    for u in result.unknowns:
        table.add_row(escape(u.name), _value(u), f"{u.low:.0e} to {u.high:.0e}", escape(u.cell))
    return table


def _value(u: Unknown) -> str:
    return f"{short(u.value, 4)} {u.unit}" + (f", {AT_BOUND}" if u.at_bound else "")


def _readings(result: Table1) -> Table:
    title = 'Readings of "2x-bar linkage", the parallelogram being 1'
    table = lean("reading", "K_tran", "turning held", "1 / K_rot", title=title)
    table.add_column("moves", overflow="fold")
    for r in result.readings:
        numbers = (r.K_tran_over_parallelogram, r.K_tran_held_over_parallelogram)
        shown = [*(f"{n:.3f}" for n in numbers), f"{r.parallelogram_over_K_rot:.3g}"]
        table.add_row(escape(r.reading), *shown, "yes" if r.moves else "no")
    return table
