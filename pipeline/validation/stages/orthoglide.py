"""Table 1 of the paper: the parallelogram inside the whole manipulator."""

import numpy as np

from pipeline.manipulator.description import SHIPPED
from pipeline.manipulator.table import table_1
from pipeline.manipulator.table_record import Table1
from pipeline.validation.case import Case
from pipeline.validation.workshop import Workshop
from vjm import paper

FILE = SHIPPED / "orthoglide.toml"


def whole_manipulator(case: Case, workshop: Workshop) -> list[Table1]:
    """The table for the paper's own case, whose bar has to meet Eq. 12; nothing for another, which has no Table 1."""
    if not of_the_paper(case):
        return []
    inputs = [FILE.read_text(encoding="utf-8")]
    return workshop.reuse("Table 1", inputs, list[Table1], lambda _: [table_1()])


def of_the_paper(case: Case) -> bool:
    """Whether the case has the paper's bars."""
    if case.paper is None or case.linkage.length_mm != paper.LENGTH:
        return False
    return bool(np.array_equal(case.paper.bar_stiffness, paper.BAR_STIFFNESS))


def table_sentences(tables: list[Table1]) -> list[str]:
    """What the table shows, in a sentence each."""
    sentences = []
    for table in tables:
        known = [c for c in table.cells if c.deviation is not None and not c.fitted]
        linkage = [c for c in known if c.linkage != "2x-bar"]
        nearest = max(abs(c.deviation or 0.0) for c in linkage)
        rest = max(known, key=lambda c: abs(c.deviation or 0.0))
        worst = max(max(a.K_tran, a.K_rot) for a in table.agreement)
        sentences.append(
            f"Table 1, the whole Orthoglide: {len(table.unknowns)} numbers that the paper does not give are fitted to "
            f"{table.fitted} cells, {table.predicted} cells are predicted: those of the parallelogram within "
            f"{100 * nearest:.0f} %, {rest.quantity} of the {rest.linkage} by {100 * (rest.deviation or 0.0):+.0f} %. "
            f"Springs and frame elements agree within {max(100 * worst, 1e-3):.1g} %."
        )
        sentences.append("Unfitted: " + " ".join(_answered(f.statement, f.holds) for f in table.findings))
    return sentences


def _answered(statement: str, holds: bool) -> str:
    return f"{statement} {'Yes.' if holds else 'No.'}"
