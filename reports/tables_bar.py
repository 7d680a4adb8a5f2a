"""Tables of the bar: geometry, stiffness and buckling, straight from the result."""

from collections.abc import Mapping
from typing import Any

from reports.blocks import Cell, Column, Table, table
from reports.formats import (
    DASH,
    ENTRIES,
    count,
    entry_of,
    entry_unit,
    fixed,
    name_and_unit,
    number,
    percent,
    plain,
    symbol,
    trimmed,
)
from reports.load import Json
from reports.style import model_label
from reports.tables_yield import marked, note

SUPPORTS = {
    "free": "base clamped, tip free",
    "guided": "base clamped, tip free to move sideways but not to rotate",
    "clamped": "both ends clamped",
    "pinned": "both ends turn about y, held about z",
}
"""What the supports' names mean."""

AXIAL_UNITS = {"N/mm": "1/mm", "N": "1", "N·mm": "mm"}
"""Units of an entry of K_b divided by a force."""

SOLVE = {
    "setup_seconds": "factorisation_s",
    "solve_seconds": "all solutions together_s",
    "residual": "largest residual / largest load",
}
"""What the record of a solution says, with its unit."""

QUALITY = {
    "volume": "relative error of the volume",
    "moment_y": "relative error of ∫z² dV",
    "moment_z": "relative error of ∫y² dV",
    "worst_cell": "smallest / largest Jacobian, worst cell",
    "longest_aspect": "longest / shortest edge, worst cell",
}
"""What the mesh's checks measure."""


def values(caption: str, quantities: Mapping[str, Any], *notes: str, digits: int = 5) -> Table:
    """Quantities by name, with unit and value; what is text stands below the table."""
    rows, words = [], []
    for key, value in quantities.items():
        name, unit = name_and_unit(key)
        if isinstance(value, int | float):
            rows.append(
                [name, unit or DASH, count(value) if isinstance(value, int) else number(value, digits)]
            )
        else:
            words.append(f"{name}: {plain(str(value))}")
    columns = [Column("quantity", numeric=False), Column("unit", numeric=False), Column("value")]
    return table(caption, columns, rows, *words, *notes)


def given(caption: str, quantities: Mapping[str, Any]) -> Table:
    """Quantities that the case or the search has set."""
    plain_table = values(caption, quantities)
    rows = [[name, unit, Cell(trimmed(value.text))] for name, unit, value in plain_table.rows]
    return table(caption, plain_table.columns, rows, *plain_table.notes)


def geometry(bar: Json) -> Table:
    """Section, length, lugs."""
    quantities = {**bar["section"], "length_mm": bar["length_mm"]}
    quantities |= {f"lug {key}": value for key, value in (bar["lug"] or {}).items()}
    return given("Geometry", quantities)


def material(bar: Json) -> Table:
    """Elastic constants and where they are from."""
    return given("Material", bar["material"])


def constants(bar: Json) -> Table:
    """Constants of the section between the lugs."""
    return values("Section between the lugs", bar["constants"])


def stiffness(bar: Json) -> Table:
    """K_b entry by entry: solid FE against every reference there is."""
    routes = [("beam oracle", bar["oracle"])]
    if bar["paper"] is not None:
        routes.insert(0, ("paper, Eq. 12", bar["paper"]))
    columns = [Column("entry", numeric=False), Column("unit", numeric=False), Column("solid FE")]
    for title, _ in routes:
        columns += [Column(title), Column("deviation", "%")]
    columns.insert(3, Column("its mesh error", "±%"))
    columns += [Column("second route"), Column("deviation", "%")]
    rows = []
    for entry in ENTRIES:
        solid = entry_of(bar["stiffness"], entry)
        band = percent(bar["convergence"]["band"].get(entry)).removeprefix("+")
        row = [symbol(entry), entry_unit(entry), number(solid), band]
        for _, matrix in routes:
            reference = entry_of(matrix, entry)
            row += [number(reference), percent(solid / reference - 1.0) if reference else DASH]
        second = entry_of(bar["second_route"]["stiffness"], entry)
        rows.append([*row, number(second), percent(second / solid - 1.0) if solid else DASH])
    notes = [
        "Deviation: solid FE from Eq. 12 and from the oracle; the second route from solid FE.",
        "An entry in N couples a force with a rotation in rad.",
    ]
    if bar["worst_entry_error"] is not None:
        notes.append(f"Worst entry against Eq. 12: {fixed(100 * abs(bar['worst_entry_error']), 2)} %.")
    return table("Stiffness K_b of the bar at its tip", columns, rows, *notes)


def axial(bar: Json) -> Table:
    """Derivative of K_b by axial force: identified from the solid, by formula, and as the refined springs have it."""
    record = bar["axial"]
    rows = []
    for entry in ENTRIES:
        solid = entry_of(record["solid"], entry)
        row = [symbol(entry), AXIAL_UNITS[entry_unit(entry)], number(solid)]
        row.append(percent(record["band"].get(entry)).removeprefix("+"))
        for key in ("formula", "vjm"):
            other = entry_of(record[key], entry)
            row += [number(other), percent(other / solid - 1.0) if solid else DASH]
        rows.append(row)
    columns = [Column("entry", numeric=False), Column("unit", numeric=False), Column("solid FE")]
    columns += [Column("its mesh error", "±%"), Column("uniform beam"), Column("deviation", "%")]
    columns += [Column("VJM, refined"), Column("deviation", "%")]
    note = "Under an axial force P the bar's 6x6 is K_b + P times this, tension positive. Deviation: from solid FE."
    return table("K_g, what 1 N of axial force adds to K_b", columns, rows, note)


def fit(bar: Json) -> Table:
    """Where the search for the reference bar began and ended."""
    record = bar["fit"]
    rows = []
    for key, found in record["found"].items():
        name, unit = name_and_unit(key)
        start = record["start"].get(key)
        rows.append([name, unit, number(start, 4), number(found, 4)])
    columns = [
        Column("dimension", numeric=False),
        Column("unit", numeric=False),
        Column("start"),
        Column("found"),
    ]
    rms = fixed(100 * record["rms"], 2)
    note = f"Root mean square deviation of the entries: {rms} %, after {record['solves']} solves."
    return table("Search for the reference bar", columns, rows, note)


def laws(bar: Json) -> Table:
    """What K_b and its mesh must satisfy whatever the bar is."""
    return values("Laws that K_b must obey", bar["laws"], digits=3)


def quality(bar: Json) -> Table:
    """Mesh against exact geometry."""
    checks = {QUALITY.get(key, key): value for key, value in bar["quality"].items()}
    return values("Mesh quality", {"cells": bar["cells"], "dofs": bar["dofs"], **checks}, digits=3)


def solve(bar: Json) -> Table:
    """How the six right-hand sides of K_b were solved."""
    return values(
        "Solution for K_b", {SOLVE.get(key, key): value for key, value in bar["solve"].items()}, digits=3
    )


def leftover(bar: Json) -> Table:
    """What the rigid-motion fit of the second route leaves over."""
    rows = [
        [load, percent(share, 3).removeprefix("+")] for load, share in bar["second_route"]["leftover"].items()
    ]
    columns = [Column("load on the tip", numeric=False), Column("share", "%")]
    note = "Part of the tip face's displacement that is no rigid motion, root mean square."
    return table("Second route: what the fit leaves over", columns, rows, note)


def convergence(bar: Json) -> Table:
    """Observed order, extrapolated value and error band of the working mesh."""
    record = bar["convergence"]
    rows = [
        [
            symbol(entry),
            entry_unit(entry),
            *(number(value, 6) for value in found),
            number(entry_of(record["extrapolated"], entry), 6),
            fixed(record["orders"].get(entry) or None, 2),
            percent(record["band"].get(entry), 3).removeprefix("+"),
        ]
        for entry, found in record["entries"].items()
    ]
    columns = [Column("entry", numeric=False), Column("unit", numeric=False)]
    columns += [Column(f"{count(dofs)} dofs") for dofs in record["dofs"]]
    columns += [Column("extrapolated"), Column("order in h"), Column("band", "%")]
    return table(
        "K_b over nested meshes",
        columns,
        rows,
        f"Band: error of the working mesh ({count(bar['dofs'])} dofs).",
    )


def buckling(result: Json) -> Table:
    """Critical compression loads of the bar by supports and mode."""
    rows, previous = [], None
    items = [item for item in result["buckling"] if item["body"] == "bar"]
    for item in items:
        group = (item["supports"], model_label(item))
        head = [*group] if group != previous else ["", ""]
        previous = group
        rows.append(
            [
                *head,
                str(item["mode"]),
                item["plane"],
                marked(Cell(number(item["load_N"])), item),
                percent(item.get("band")).removeprefix("+"),
                number(item.get("formula_N")),
                percent(item.get("deviation")),
                fixed(item.get("mac"), 3),
                formula_cell(item),
            ]
        )
    columns = [
        Column("supports", numeric=False),
        Column("model", numeric=False),
        Column("mode", numeric=False),
        Column("plane", numeric=False),
        Column("load", "N"),
        Column("its mesh error", "±%"),
        Column("formula value", "N"),
        Column("deviation", "%"),
        Column("MAC"),
        Column("formula", numeric=False),
    ]
    used = dict.fromkeys(item["supports"] for item in items)
    notes = [f"{name}: {SUPPORTS[name]}." for name in used if name in SUPPORTS]
    notes.append(
        "Mesh error: from the same mode on a second mesh and the order of K_b's entries; an upper estimate, for waves "
        "along the bar converge faster than its corners do. The formula takes EI from the K_b of the same mesh, so the "
        "deviation of the first modes holds less of it."
    )
    notes.append(
        "Solid and formula are matched by the shape of their modes; MAC: how alike the two shapes are, 1 is the same."
    )
    if any(item.get("formula_N") is None for item in items):
        notes.append(f"{DASH}: the run holds no closed form for this mode.")
    notes += note(result)
    return table("Critical loads of the bar, compression positive", columns, rows, *notes)


def formula_cell(item: Json) -> Cell:
    """The formula of a mode's shape; without one, the nearest, marked as none."""
    if item.get("missing"):
        return Cell(item["formula"], "no solid mode has its shape")
    if item.get("nearest"):
        return Cell(
            f"none; nearest: {item['nearest']}, {number(item['nearest_N'])} N", "no formula of its shape"
        )
    return Cell(item.get("formula") or DASH)


def labels(result: Json) -> list[str]:
    """Names that the run gives to configurations, such as those of the paper's Fig. 2."""
    names = []
    for item in result["buckling"]:
        label = item.get("picture")
        if label and not label.endswith((".png", ".vtu", ".svg")):
            names.append(f"{label}: {item['supports']}, mode {item['mode']}, {number(item['load_N'])} N")
    return names
