"""The report's story: which sections it has, in which order, and what each of them shows."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

from reports import plots, tables_bar, tables_linkage, tables_orthoglide, tables_record, tables_yield
from reports.blocks import (
    Block,
    Bullets,
    Code,
    Columns,
    Details,
    Figure,
    Gallery,
    Section,
    Table,
    Tables,
    Text,
)
from reports.load import Json
from reports.shapes import supports_of

Drawing = tuple[str, bytes]
FIRST = 5
"""Findings that are seen at once."""
AGREEMENT = (
    "Solid, frame, refined springs and LIN under the same conditions at one angle, tension to the left; below, the "
    "difference of each to the solid. The grey band is the mesh error of the solid past its critical load."
)
WARNED = "Figures of this report that belong together are farther apart than their stated band. Do not rely on them."


def build(result: Json, drawings: Mapping[str, Drawing], shapes: Any, stressed: Any = None) -> list[Section]:
    """All sections. `drawings`: (SVG, PNG) by name; `shapes`: plot of the modes and its supports, or None;
    `stressed`: plot of the bent linkages, or None."""
    parts = [
        *warnings(result),
        findings(result, drawings),
        linkage(result, drawings),
        bar(result, drawings),
        convergence(result, drawings),
        buckling(result, drawings, shapes),
        parallelogram(result),
        critical(result, drawings, stressed),
        force_deflection(result, drawings),
    ]
    if result["orthoglide"]:
        parts.append(orthoglide(result))
    if result["errata"]:
        parts.append(errata(result))
    return [_named(part, bool(result["errata"])) for part in (*parts, record(result))]


def _named(part: Section, paper: bool) -> Section:
    """Figures and equations of the paper are named where the case is the paper's."""
    return part if paper else without_paper(part)


def without_paper(part: Section) -> Section:
    """The section without the figure or equation of the paper in its title."""
    return replace(part, title=part.title.partition(" (")[0])


def findings(result: Json, drawings: Mapping[str, Drawing]) -> Section:
    """What is to be seen without scrolling: the first findings and a picture; the others are folded."""
    story = result["story"]
    right: list[Block] = [drawn("agreement", AGREEMENT, drawings)] if "agreement" in drawings else []
    more: list[Block] = [Tables([tables_record.run(result)])]
    if story[FIRST:]:
        more.insert(0, Bullets(story[FIRST:]))
    first: list[Block] = [Bullets(story[:FIRST])]
    shown = Columns(first, right) if right else first[0]
    return Section("findings", "Findings", [shown, Details("All findings, and the run", more)])


def warnings(result: Json) -> list[Section]:
    """Where the models of this report are too far apart, before anything else; nothing where they agree."""
    said = result.get("warnings")
    return [Section("warnings", "Warnings", [Text(WARNED), Bullets(said)])] if said else []


def drawn(name: str, caption: str, drawings: Mapping[str, Drawing], plot: Any = None) -> Figure:
    """A figure with whatever exists of it."""
    svg, png = drawings.get(name, ("", b""))
    return Figure(name, caption, plot, svg, png)


def linkage(result: Json, drawings: Mapping[str, Drawing]) -> Section:
    """The paper's Fig. 1."""
    caption = (
        "The parallelogram at q = 0 and q = 30°, to scale. The base frame x, y, z sits in the middle between "
        "the base hinges. The unloaded platform point is at (L cos q, 0, −L sin q). Bar 1 starts at "
        "z = −d/2, bar 2 at +d/2. A wrench is the one exerted on the platform at its point."
    )
    return Section("linkage", "The linkage (Fig. 1)", [drawn("linkage", caption, drawings)])


def bar(result: Json, drawings: Mapping[str, Drawing]) -> Section:
    """Geometry and stiffness of the bar."""
    part = result["bar"]
    blocks: list[Block] = [drawn("bar", "The bar and its section, each to scale.", drawings)]
    blocks.append(tables_bar.stiffness(part))
    blocks.append(Text(part["second_route"]["explanation"]))
    if part.get("axial"):
        blocks += [tables_bar.axial(part), Bullets(part["axial"]["explanation"])]
    small: list[Table] = [tables_bar.geometry(part), tables_bar.material(part), tables_bar.constants(part)]
    if part["fit"] is not None:
        small.append(tables_bar.fit(part))
    small += [tables_bar.laws(part), tables_bar.quality(part), tables_bar.leftover(part)]
    if part.get("solve"):
        small.append(tables_bar.solve(part))
    more = Details("Geometry, material and quality of the mesh", [Tables(small)])
    return Section("bar", "The bar and its stiffness (Eq. 12)", [*blocks, more])


def convergence(result: Json, drawings: Mapping[str, Drawing]) -> Section:
    """How far the mesh is from the limit."""
    caption = (
        "Relative distance of the eight entries of K_b to their extrapolated values against the degrees of "
        "freedom, with the observed order in the element size; the dashed line is the working mesh."
    )
    figure = drawn("convergence", caption, drawings, plots.convergence(result))
    more: list[Block] = [tables_bar.convergence(result["bar"])]
    if result.get("refinement"):
        more.append(tables_linkage.refinement(result))
    return Section("convergence", "Convergence", [figure, Details("Meshes, values and orders", more)])


def buckling(result: Json, drawings: Mapping[str, Drawing], shapes: Any) -> Section:
    """The paper's Fig. 2."""
    blocks: list[Block] = [tables_bar.buckling(result)]
    names = tables_bar.labels(result)
    if names:
        blocks.append(Bullets(names))
    absent, stacked = [], []
    for supports in supports_of(result):
        meaning = tables_bar.SUPPORTS.get(supports, supports)
        name = f"modes_{supports}"
        if name in drawings:
            caption = f"{supports.capitalize()}: {meaning}. Displacements enlarged, unloaded bar in outline."
            stacked.append(drawn(name, caption, drawings))
        if shapes is None or supports not in shapes[1]:
            absent.append(supports)
    blocks.append(Gallery(stacked))
    if shapes is not None:
        blocks.append(Figure("shapes", "The modes to turn and zoom: drag, scroll, choose above.", shapes[0]))
    if absent:
        files = ", ".join(f"modes/{supports}.vtu" for supports in absent)
        blocks.append(Text(f"The shapes are not stored beside this result ({files}); a new run writes them."))
    return Section("buckling", "Buckling of the bar (Fig. 2)", blocks)


def parallelogram(result: Json) -> Section:
    """Stiffness of the linkage."""
    items = result["parallelogram"]
    blocks: list[Block] = [
        Text(
            "Entries of half the matrix, K_p / 2, as Eqs. 11 and 13 print it with the factor 2 before it; "
            "entries that are zero in all models are left out. The paper's own reference is 2 K_b, two bars "
            "side by side without hinges: half of it is K_b."
        )
    ]
    blocks += [tables_linkage.stiffness(item) for item in items]
    blocks.append(tables_linkage.ranks(items))
    return Section("parallelogram", "Stiffness of the parallelogram (Eqs. 11 and 13)", blocks)


STRESS = (
    "The bent linkage at its critical load, where the straight one and every slightly bent one are in balance: pushed "
    "by that load and bent by its lowest mode with a largest displacement of L/100, drawn larger; von Mises stress of "
    "both together, linear elastic. Fully held, each bar buckles by itself and either one may be drawn. The platform "
    "is rigid and not drawn. Drag to turn, scroll, choose above."
)


def critical(result: Json, drawings: Mapping[str, Drawing], stressed: Any) -> Section:
    """Critical loads by every model."""
    caption = "Critical loads on a logarithmic axis. Hatched: an instability in tension."
    blocks: list[Block] = [
        tables_linkage.critical(result),
        Figure("critical", caption, plots.critical(result)),
        Text("Why they differ:"),
        Bullets(tables_linkage.reasons(result)),
    ]
    if "stress" in drawings:
        blocks.append(drawn("stress", STRESS, drawings, stressed))
    checks = tables_linkage.closed_forms(result)
    return Section("critical", "Critical loads of the parallelogram", blocks + ([checks] if checks else []))


def force_deflection(result: Json, drawings: Mapping[str, Drawing]) -> Section:
    """The paper's Fig. 3 and the range of the linear model."""
    blocks: list[Block] = [
        Text(
            "Compression is drawn to the right and up: the abscissa is −x, the ordinate −Fx; in result.json "
            "both are negative in compression. Dashed horizontal lines are critical loads. The linkage is a "
            "mechanism in z, so every curve says which platform coordinates are held; the others are free."
        )
    ]
    angles = list(dict.fromkeys(curve["q_deg"] for curve in result["curves"]))
    for index, q in enumerate(angles):
        caption = (
            f"Force-deflection at q = {q:g}°. The drop-down chooses what is held, the legend the models."
        )
        plot = plots.force_deflection(result, q)
        name = "force_deflection" if index == 0 else f"force_deflection_{index + 1}"
        blocks.append(drawn(name, caption, drawings if index == 0 else {}, plot))
    if "agreement" in drawings:
        blocks.append(Bullets(result["agreement"]))
    notes = list(dict.fromkeys(curve["note"] for curve in result["curves"] if curve["note"]))
    if notes:
        blocks.append(Bullets(notes))
    if result.get("yield_MPa"):
        blocks.append(tables_yield.travels(result))
    blocks.append(tables_linkage.validity(result))
    return Section("force-deflection", "Force and deflection (Fig. 3)", blocks)


def orthoglide(result: Json) -> Section:
    """The paper's Table 1."""
    blocks = [block for item in result["orthoglide"] for block in tables_orthoglide.blocks(item)]
    return Section("orthoglide", "Whole Orthoglide (Table 1)", blocks)


def errata(result: Json) -> Section:
    """Slips of the paper."""
    return Section("errata", "Errata of the paper", [tables_record.errata(result)])


READING: Sequence[str] = (
    "Units are N, mm, rad and MPa; a 6x6 maps x y z rx ry rz to Fx Fy Fz Mx My Mz.",
    "Solid FE is the finite-element solid; the frame is made of beam elements with the rigidities of its K_b; VJM is "
    "the virtual-joint model of Eq. 1; LIN is the straight line of Eq. 11.",
    "Stiffness is that of the unloaded linkage; at a critical load the loaded tangent becomes singular.",
    "Held coordinates keep their unloaded value, the others are free of load.",
    "Every number is from result.json beside this page; this page computes nothing but ratios.",
)


def record(result: Json) -> Section:
    """How to read the report, and how to make it again."""
    program = str(result["command"]).partition(" run")[0]
    commands = f"{result['command']}\n{program} report DIR"
    return Section(
        "reading",
        "How to read this report",
        [
            Bullets(READING),
            Text("Sources:"),
            Bullets(result["sources"]),
            Tables([tables_record.seconds(result), tables_record.versions(result)]),
            Text("To make it again; DIR is the folder of a saved result:"),
            Code(commands),
        ],
    )
