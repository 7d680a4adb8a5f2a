"""Marks and a table of loads beyond the yield stress of the material."""

from collections.abc import Mapping
from typing import Any

from reports.blocks import Cell, Column, Table, table
from reports.formats import DASH, fixed, held_label, number
from reports.load import Json
from reports.style import model_label

BRANCHES = {"straight": "straight", "buckled": "bent"}


def mark(item: Mapping[str, Any]) -> str:
    """What stands beside a load at which the material has yielded, or ""."""
    return f"{number(item['stress_MPa'], 4)} MPa, beyond yield" if item.get("beyond_yield") else ""


def marked(cell: Cell, item: Mapping[str, Any]) -> Cell:
    """A cell with that mark behind its own."""
    return Cell(cell.text, "; ".join(filter(None, (cell.mark, mark(item)))))


def note(result: Json) -> list[str]:
    """What the mark means, where the material has a yield stress."""
    limit = result.get("yield_MPa")
    if not limit:
        return []
    return [
        f"Beyond yield: the bars would be stressed above {limit:g} MPa; the loads are those of elastic models."
    ]


def travels(result: Json) -> Table:
    """Where each curve reaches the yield stress."""
    rows = [
        [
            model_label(curve),
            fixed(curve["q_deg"], 0),
            held_label(curve["held"]),
            f"{'tension' if max(curve['x_mm'], key=abs) > 0 else 'compression'}, {BRANCHES[curve['branch']]}",
            number(curve.get("yield_x_mm"), 4),
            number(None if curve.get("yield_fx_N") is None else curve["yield_fx_N"] / 1e3, 4),
            number(curve.get("largest_stress_MPa"), 4),
        ]
        for curve in result["curves"]
    ]
    columns = [Column("model", numeric=False), Column("q", "°"), Column("held", numeric=False)]
    columns += [Column("branch", numeric=False), Column("x at yield", "mm"), Column("Fx at yield", "kN")]
    columns.append(Column("largest stress", "MPa"))
    return table(
        f"Where the curves reach the yield stress, {result['yield_MPa']:g} MPa",
        columns,
        rows,
        "Compression negative. Stress: axial force over area; on the bent branches of solid FE, frame and VJM, "
        "distributed, with the bending of the lowest mode that takes up the rest of the travel. Lumped springs have no "
        "curvature.",
        f"{DASH}: the curve does not come so far.",
    )
