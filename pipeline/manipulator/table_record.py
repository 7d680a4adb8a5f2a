"""Table 1 of the paper beside ours, as a record: JSON in and out, Markdown for a page or a terminal."""

from typing import Literal

from pipeline.record import Record

Quantity = Literal["K_tran", "K_rot"]
UNITS: dict[Quantity, str] = {"K_tran": "N/mm", "K_rot": "N·mm/rad"}


class Unknown(Record):
    """A number that the paper does not give: fitted within [low, high] to the cells named."""

    name: str
    value: float
    unit: str
    low: float
    high: float
    at_bound: bool
    cell: str


class Cell(Record):
    """One cell; deviation is ours / paper - 1, None where the paper has none. fitted: used to find an unknown."""

    linkage: str
    model: Literal["vjm", "fea"]
    quantity: Quantity
    ours: float
    paper: float | None
    deviation: float | None
    fitted: bool


class ReadingRow(Record):
    """What one reading of "2x-bar linkage" gives: against the parallelogram with solid axes (the paper prints +3.7 %
    for K_tran and 1/33 for K_rot), platform free to turn, or held against turning (K_tran_held)."""

    reading: str
    moves: bool
    K_tran: float
    K_tran_held: float
    K_rot: float
    K_tran_over_parallelogram: float
    K_tran_held_over_parallelogram: float
    parallelogram_over_K_rot: float


class Agreement(Record):
    """Worst difference of the principal K_tran and K_rot between the two models, over postures."""

    linkage: str
    postures: int
    K_tran: float
    K_rot: float


class Finding(Record):
    """A qualitative statement of the paper, and whether it comes out without being fitted."""

    statement: str
    holds: bool
    found: str


class Table1(Record):
    """Table 1 of the paper computed again."""

    unknowns: list[Unknown]
    cells: list[Cell]
    readings: list[ReadingRow]
    agreement: list[Agreement]
    findings: list[Finding]
    source: str

    @property
    def fitted(self) -> int:
        """Number of cells that fixed an unknown."""
        return sum(cell.fitted for cell in self.cells)

    @property
    def predicted(self) -> int:
        """Number of the paper's cells that were not used."""
        return sum(cell.paper is not None and not cell.fitted for cell in self.cells)


def markdown(table: Table1) -> str:
    """The table with its unknowns, readings and findings, for a report or a terminal."""
    lines = [
        f"{len(table.unknowns)} numbers fitted to {table.fitted} cells, {table.predicted} cells predicted.",
        "",
        "| linkage | model | quantity | paper | ours | deviation | |",
        "|---|---|---|---|---|---|---|",
        *(_cell(cell) for cell in table.cells),
        "",
        "| unknown | value | plausible | fixed by |",
        "|---|---|---|---|",
        *(_unknown(u) for u in table.unknowns),
        "",
        '| reading of "2x-bar linkage" | K_tran | against the parallelogram | with turning held | K_rot '
        "| parallelogram / it |",
        "|---|---|---|---|---|---|",
        *(_reading(r) for r in table.readings),
        "",
        *(f"- {f.statement} {'Yes' if f.holds else 'No'}: {f.found}" for f in table.findings),
        *(_agreement(a) for a in table.agreement),
    ]
    return "\n".join(lines) + "\n"


def _cell(c: Cell) -> str:
    paper = "-" if c.paper is None else f"{c.paper:.3g}"
    deviation = "" if c.deviation is None else f"{100 * c.deviation:+.1f} %"
    role = "fitted" if c.fitted else "predicted" if c.paper is not None else ""
    what = f"{c.linkage} | {c.model.upper()} | {c.quantity}, {UNITS[c.quantity]}"
    return f"| {what} | {paper} | {c.ours:.4g} | {deviation} | {role} |"


def _unknown(u: Unknown) -> str:
    bound = ", at its bound" if u.at_bound else ""
    return f"| {u.name} | {u.value:.4g} {u.unit}{bound} | {u.low:.1g} to {u.high:.1g} | {u.cell} |"


def _reading(r: ReadingRow) -> str:
    moves = "" if r.moves else " (cannot move)"
    return (
        f"| {r.reading}{moves} | {r.K_tran:.4g} | {100 * (r.K_tran_over_parallelogram - 1):+.2f} % | "
        f"{100 * (r.K_tran_held_over_parallelogram - 1):+.2f} % | {r.K_rot:.3g} | {r.parallelogram_over_K_rot:.1f} |"
    )


def _agreement(a: Agreement) -> str:
    where = f"{a.linkage}, {a.postures} postures"
    return f"- VJM against FEA, {where}: K_tran within {a.K_tran:.1e}, K_rot within {a.K_rot:.1e}."
