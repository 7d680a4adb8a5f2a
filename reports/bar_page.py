"""The page of one bar: reads bar.json and the mode shapes beside it, solves nothing."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from reports import part_drawing, shapes, tables_bar, tables_record, turntable
from reports.blocks import Block, Bullets, Code, Column, Figure, Section, Table, Tables, Text, table
from reports.formats import entry_unit, named_entries, number, percent, symbol
from reports.load import Json
from reports.record_page import drawn

RECORD = "bar.json"
READING = (
    "Units are N, mm, rad and MPa; a 6x6 maps x y z rx ry rz of the tip point to Fx Fy Fz Mx My Mz, the base held. "
    "x points from the base point to the tip point.",
    "Under an axial force P, tension positive, the 6x6 is K_b + P K_g.",
    "Band by mesh: how far the entry may be from the limit of ever finer meshes. Band by tie: how far it moves when "
    "the ends are tied in another way, which no mesh decides.",
    "Every number is from bar.json beside this page.",
)


def draw(folder: Path) -> Path:
    """Write index.html beside bar.json; ReportError if that is missing or not laid out as the record of a bar."""
    return drawn(Path(folder) / RECORD, "the record of a bar", sections)


def sections(folder: Path, record: Json) -> list[Section]:
    """All of the page."""
    drawing = part_drawing.draw(folder, record)
    stiff: list[Block] = [Figure("part", "The bar to scale.", None, *drawing)] if drawing else []
    stiff += [stiffness(record), *([geometric(record)] if record["geometric"] else [])]
    if record["said"]:
        stiff.append(Bullets(record["said"]))
    facts = {"length_mm": record["length_mm"], **record["ends"]}
    small: list[Table] = [
        tables_bar.given("The bar", {**facts, "ties of the ends": record["tie"]}),
        tables_bar.given("Material", {k: v for k, v in record["material"].items() if v != ""}),
        tables_bar.values("Mesh", mesh(record["mesh"]), digits=3),
    ]
    return [
        Section("bar", "The bar and its stiffness", [*stiff, Tables(small)]),
        buckling(folder, record),
        *stressed(record),
        reading(record),
    ]


def mesh(found: Json) -> dict[str, Any]:
    """Counts and checks of the mesh by what they are called."""
    checks = {tables_bar.QUALITY.get(key, key): value for key, value in found["quality"].items()}
    study = ", ".join(str(n) for n in found["study_dofs"])
    return {
        "cells": found["cells"],
        "dofs": found["dofs"],
        **checks,
        "kind": found["kind"],
        "study, dofs": study,
    }


def stiffness(record: Json) -> Table:
    """K_b entry by entry with both bands, and what other ties of its ends give."""
    others = list(record["modelling"].items())
    columns = [
        Column("entry", numeric=False),
        Column("unit", numeric=False),
        Column("K_b"),
        Column("band by mesh", "±%"),
        Column("extrapolated"),
        Column("band by tie", "±%"),
        *(Column(name) for name, _ in others),
    ]
    rows = []
    for entry, (i, j) in named_entries(record["stiffness"]).items():
        rows.append(
            [
                symbol(entry),
                entry_unit(entry),
                number(record["stiffness"][i][j]),
                percent(record["numerical_band"].get(entry), 3).removeprefix("+"),
                number(record["extrapolated"][i][j]),
                percent(record["modelling_band"].get(entry)).removeprefix("+"),
                *(number(matrix[i][j]) for _, matrix in others),
            ]
        )
    return table(f"K_b, ends tied {record['tie']}", columns, rows)


def geometric(record: Json) -> Table:
    """K_g entry by entry with its bands."""
    columns = [
        Column("entry", numeric=False),
        Column("unit", numeric=False),
        Column("K_g"),
        Column("band by mesh", "±%"),
        Column("band by tie", "±%"),
    ]
    rows = []
    for entry, (i, j) in named_entries(record["geometric"]).items():
        unit = tables_bar.AXIAL_UNITS[entry_unit(entry)]
        other = percent(record["geometric_modelling_band"].get(entry)).removeprefix("+")
        value = number(record["geometric"][i][j])
        mesh = percent(record["geometric_numerical_band"].get(entry), 3).removeprefix("+")
        rows.append([symbol(entry), unit, value, mesh, other])
    return table("K_g, what 1 N of axial force adds to K_b", columns, rows)


def buckling(folder: Path, record: Json) -> Section:
    """Critical loads, and the modes to turn where their shapes are there."""
    limit = (record.get("stress") or {}).get("yield_MPa")
    blocks: list[Block] = [tables_bar.buckling({**record, "yield_MPa": limit})]
    names: Sequence[str] = shapes.supports_of(record)
    found = [s for name in names if (s := shapes.read(folder, record, name)) is not None]
    if found:
        caption = "The modes to turn and zoom: drag, scroll, choose above. Displacements enlarged."
        blocks.append(Figure("shapes", caption, turntable.figure(found)))
    return Section("buckling", "Buckling of the bar", blocks)


UNIT_LOADS = {"F": ("N", "MPa per kN", 1e3), "M": ("N·mm", "MPa per N·m", 1e3)}
"""Of forces and moments: unit, unit of the stress in the table, and how many units that is for."""


def stressed(record: Json) -> list[Section]:
    """Von Mises' stress under unit loads and what first yields; nothing for a record without it."""
    it = record.get("stress")
    if not it:
        return []
    limit = it["yield_MPa"] is not None
    columns = [Column("load", numeric=False), Column("unit", numeric=False)]
    for where in ("body", "ends"):
        columns += [Column(where), Column("at x, y, z", "mm", numeric=False), Column("to last mesh", "%")]
        columns += [Column("first yield")] if limit else []
    rows = []
    for load in it["loads"]:
        of, unit, factor = UNIT_LOADS[load["load"][0]]
        row = [load["load"], unit + (f"; yield in {of}" if limit else "")]
        for where in ("body", "ends"):
            peak = load[where]
            row += [
                number(peak["stress"] * factor, 4),
                ", ".join(f"{x:.3g}" for x in peak["at_mm"]),
                percent(peak["change"]),
            ]
            row += [number(peak["first_yield"], 4)] if limit else []
        rows.append(row)
    reach = ", ".join(f"{name} {far:.3g} mm" for name, far in it["ends_reach_mm"].items())
    notes = [
        f"Body: farther from the tied surfaces than half their largest extent ({reach}); ends: nearer. At the ends the "
        "stress is that of a rigid seat: at its edges it grows with every finer mesh.",
        "Linear elastic, the bar straight, base held, one unit load at the tip at a time; mean of the cells around "
        "each node. To last mesh: change of the peak from the mesh before.",
    ]
    if limit:
        notes.append(
            f"First yield: the load, of either sign, at which that point reaches {it['yield_MPa']:g} MPa."
        )
    return [
        Section(
            "stress", "Stress under unit loads", [table("Largest von Mises stress", columns, rows, *notes)]
        )
    ]


def reading(record: Mapping[str, Any]) -> Section:
    """How to read the page and how to make it again."""
    versions = {**record["versions"], "commit": record["commit"]}
    files = tables_record.pairs("Files it was made from", "file", "sha256", record["data"])
    return Section(
        "reading",
        "How to read this page",
        [
            Bullets(READING),
            Tables(
                [
                    tables_record.seconds(record),
                    tables_record.pairs("Versions", "package", "version", versions),
                ]
            ),
            files,
            Text("To make it again:"),
            Code(str(record["command"])),
        ],
    )
