"""Table 1 of the paper beside ours, as a record: JSON in and out, Markdown for a page or a terminal."""

from typing import Literal

from pipeline.record import Record

Quantity = Literal["K_tran", "K_rot"]
UNITS: dict[Quantity, str] = {"K_tran": "N/mm", "K_rot": "N·mm/rad"}


class Unknown(Record):
    """A number that the paper does not give."""

    name: str
    """What it is."""
    value: float
    """As fitted."""
    unit: str
    """Its unit."""
    low: float
    """Least plausible value."""
    high: float
    """Greatest plausible value."""
    at_bound: bool
    """Whether it ends at one of these."""
    cell: str
    """Cells that it is fitted to."""


class Cell(Record):
    """One cell of the table."""

    linkage: str
    """Kind of linkage."""
    model: Literal["vjm", "fea"]
    """Virtual springs or finite elements."""
    quantity: Quantity
    """Translational or rotational stiffness, N/mm or N·mm/rad."""
    ours: float
    """As computed here."""
    paper: float | None
    """As printed; None where the paper has none."""
    deviation: float | None
    """ours / paper - 1."""
    fitted: bool
    """Whether the cell was used to find an unknown."""


class ReadingRow(Record):
    """What one reading of "2x-bar linkage" gives: against the parallelogram with solid axes (the paper prints +3.7 %
    for K_tran and 1/33 for K_rot), platform free to turn, or held against turning (K_tran_held)."""

    reading: str
    """How the words of the paper are read."""
    moves: bool
    """Whether the machine can move then."""
    K_tran: float
    """Translational stiffness, platform free to turn, N/mm."""
    K_tran_held: float
    """The same with the platform held against turning."""
    K_rot: float
    """Rotational stiffness, N·mm/rad."""
    K_tran_over_parallelogram: float
    """K_tran over that of the parallelogram with solid axes."""
    K_tran_held_over_parallelogram: float
    """K_tran_held over the same."""
    parallelogram_over_K_rot: float
    """Rotational stiffness of the parallelogram over this."""


class Agreement(Record):
    """Worst difference of the principal K_tran and K_rot between the two models, over postures."""

    linkage: str
    """Kind of linkage."""
    postures: int
    """Number of postures."""
    K_tran: float
    """Worst relative difference of the principal translational stiffness."""
    K_rot: float
    """The same of the rotational one."""


class Finding(Record):
    """A qualitative statement of the paper, and whether it comes out without being fitted."""

    statement: str
    """What the paper says."""
    holds: bool
    """Whether it comes out."""
    found: str
    """What was found."""


class Table1(Record):
    """The answer of table: Table 1 of the paper computed again."""

    unknowns: list[Unknown]
    """Numbers that the paper does not give."""
    cells: list[Cell]
    """The cells of the table."""
    readings: list[ReadingRow]
    """What each reading of ‘2x-bar linkage’ gives."""
    agreement: list[Agreement]
    """How far the two models are apart."""
    findings: list[Finding]
    """Statements of the paper."""
    source: str
    """The publication."""

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
