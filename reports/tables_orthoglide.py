"""Table 1 of the paper: the whole manipulator, each cell beside the paper's."""

from reports.blocks import Block, Bullets, Cell, Column, Table, Text, table
from reports.formats import DASH, number, percent
from reports.load import Json

UNITS = {"K_tran": "N/mm", "K_rot": "N·mm/rad"}
MODELS = {"vjm": "VJM", "fea": "frame FE"}


def blocks(item: Json) -> list[Block]:
    """All that the section shows of one table."""
    return [Text(opening(item)), cells(item), unknowns(item), readings(item), Bullets(findings(item))]


def opening(item: Json) -> str:
    """What was done, and what was fitted."""
    fitted = sum(c["fitted"] for c in item["cells"])
    predicted = sum(c["paper"] is not None and not c["fitted"] for c in item["cells"])
    return (
        "Three orthogonal drives, each with foot and parallelogram, in the isotropic posture. K_tran is what a force "
        "meets while the platform may turn, K_rot what a moment meets while it may shift; means over the principal "
        f"directions. Drive, foot and axes are not in the paper: {len(item['unknowns'])} numbers are fitted to "
        f"{fitted} of its cells, the other {predicted} are predicted."
    )


def cells(item: Json) -> Table:
    """Each cell beside the paper's."""
    columns = [
        Column("linkage", numeric=False),
        Column("model", numeric=False),
        Column("quantity", numeric=False),
        Column("unit", numeric=False),
        Column("paper"),
        Column("here"),
        Column("here / paper − 1", "%"),
        Column("", numeric=False),
    ]
    rows, before = [], ""
    for c in item["cells"]:
        name = "" if c["linkage"] == before else c["linkage"]
        before = c["linkage"]
        role = "fitted" if c["fitted"] else "predicted" if c["paper"] is not None else "not in the paper"
        # What was fitted meets its cell: a deviation would be rounding.
        off = "" if c["fitted"] else percent(c["deviation"], 1)
        rows.append(
            [
                name,
                MODELS[c["model"]],
                c["quantity"],
                UNITS[c["quantity"]],
                number(c["paper"], 3) if c["paper"] is not None else DASH,
                number(c["ours"], 4),
                off,
                Cell(role),
            ]
        )
    worst = max(max(a["K_tran"], a["K_rot"]) for a in item["agreement"])
    postures = max(a["postures"] for a in item["agreement"])
    note = (
        f"Frame elements and virtual springs have the same bars (Eq. 12) and no code in common; over {postures} "
        f"postures of all linkages they differ by {number(100 * worst, 2)} %. The paper's finite elements are solids "
        "whose joints and mesh it does not give, and differ from its springs by up to 7 %."
    )
    return table("Table 1", columns, rows, note)


def unknowns(item: Json) -> Table:
    """What was fitted, with its plausible range."""
    columns = [
        Column("not in the paper", numeric=False),
        Column("value"),
        Column("unit", numeric=False),
        Column("plausible from"),
        Column("to"),
        Column("fixed by the cell", numeric=False),
    ]
    rows = [
        [
            u["name"] + (" (at its bound)" if u["at_bound"] else ""),
            number(u["value"], 4),
            u["unit"],
            number(u["low"], 1),
            number(u["high"], 1),
            u["cell"],
        ]
        for u in item["unknowns"]
    ]
    return table("Fitted numbers", columns, rows)


def readings(item: Json) -> Table:
    """What the first row may mean."""
    columns = [
        Column('"2x-bar linkage" read as', numeric=False),
        Column("moves", numeric=False),
        Column("K_tran", "N/mm"),
        Column("/ parallelogram − 1", "%"),
        Column("with turning held", "%"),
        Column("K_rot", "N·mm/rad"),
        Column("parallelogram / it"),
    ]
    rows = [
        [
            r["reading"],
            "yes" if r["moves"] else "no",
            number(r["K_tran"], 4),
            shown(r["K_tran_over_parallelogram"]),
            shown(r["K_tran_held_over_parallelogram"]),
            number(r["K_rot"], 3),
            number(r["parallelogram_over_K_rot"], 3),
        ]
        for r in item["readings"]
    ]
    note = (
        "The paper prints a K_tran of the 2x-bar 3.7 % above that of the parallelogram and a K_rot of 1/33 of it. A "
        "second bar with the same pins adds a stiffness and cannot take one away, so the loss is none of the linkage."
    )
    return table("Readings of the first row", columns, rows, note)


def shown(ratio: float) -> str:
    """A ratio as its distance to one."""
    return percent(ratio - 1.0 if abs(ratio - 1.0) > 1e-9 else 0.0)


def findings(item: Json) -> list[str]:
    """The paper's statements and whether they come out."""
    return [
        f"{f['statement']} {'Yes, without being fitted' if f['holds'] else 'No'}: {f['found']}."
        for f in item["findings"]
    ]
