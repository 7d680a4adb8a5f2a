"""Linear buckling of the bar under named supports, beside the formulas, with the mode shapes as files."""

from pathlib import Path

import numpy as np

from fem.axis_shape import AxisShape, axis_shape
from fem.buckling import Mode, buckling
from fem.convergence import limit_of_two
from fem.euler import bending_of
from fem.linear import LinearModel
from fem.linkage import single_bar
from fem.mode_formulas import FormulaMode, bending_modes, torsion_modes
from fem.space import Space
from meshes.files import replacing
from meshes.solid import SolidMesh
from pipeline.progress import Stage
from pipeline.validation.bands import MODE
from pipeline.validation.result import Buckling, Convergence
from pipeline.validation.stages.mode_matching import Match, with_formulas, with_shapes
from pipeline.validation.stages.specimen import Specimen

ALL_BUT_X = ("y", "z", "rx", "ry", "rz")
HELD: dict[str, tuple[str, ...]] = {
    "free": (),
    "guided": ("rx", "ry", "rz"),
    "clamped": ALL_BUT_X,
    "pinned": ALL_BUT_X,
}
MODES = 6
# On the second mesh, where the order of modes may be another one.
MORE_MODES = MODES + 2

# Entry of K_b whose order of convergence a mode in each plane has: that of its bending, or of the twist.
ORDER_OF = {"xy": "K66", "xz": "K55", "torsion": "K44"}
# Where the mesh study found no order.
SLOWEST = 1.0
TORSION = "(GJ + (n π/L)² EIw) / r₀²"


def mode_files() -> tuple[str, ...]:
    """Names of the files with the mode shapes."""
    return tuple(f"{name}.vtu" for name in HELD)


def buckle_bar(s: Specimen, study: Convergence, folder: Path, stage: Stage) -> list[Buckling]:
    """Modes of all supports with their mesh errors and formulas; the shapes go to `folder`, a file for each support."""
    other = s.detail.companion
    space = Space.of(s.mesh(other))
    second = LinearModel(single_bar(space, s.bar.length), s.material)
    records = []
    for supports in HELD:
        stage.say(f"{supports} tip")
        modes = modes_of(s.model, s.bar.length, supports, MODES)
        write_modes(s.space.mesh, modes, folder / f"{supports}.vtu")
        beside = modes_of(second, s.bar.length, supports, MORE_MODES)
        formulas = formulas_of(s, supports)
        shapes = shapes_of(s, s.space.mesh, modes)
        by_formula = with_formulas(shapes, formulas)
        by_mesh = with_shapes(shapes, shapes_of(s, space.mesh, beside))
        for number, mode in enumerate(modes, 1):
            record = solid_record(supports, number, mode)
            record = with_band(record, by_mesh[number - 1], beside, (s.detail.working, other), study)
            records.append(with_formula(record, by_formula[number - 1], formulas))
        records += missing_records(supports, by_formula, formulas)
        torsion = next(f for f in formulas if f.plane == "torsion")
        records.append(torsion_record(supports, torsion.load))
    return records


def missing_records(supports: str, found: list[Match], formulas: list[FormulaMode]) -> list[Buckling]:
    """Formulas whose shape no mode of the solid has, though it has that of a clearly higher one."""
    taken = {match.partner for match in found if match.partner is not None}
    highest = max((formulas[index].load for index in taken), default=0.0)
    return [
        Buckling(
            body="bar",
            model="formula",
            supports=supports,
            plane=formula.plane,
            mode=formula.number,
            load_N=formula.load,
            formula=named(formula),
            missing=True,
        )
        for index, formula in enumerate(formulas)
        if index not in taken and formula.load * (1.0 + MODE.value) < highest
    ]


def modes_of(clamped: LinearModel, length: float, supports: str, count: int) -> tuple[Mode, ...]:
    """The lowest modes of a bar of a length, mm, under named supports; `clamped` is its model, whose matrix is kept."""
    if supports != "pinned":
        return buckling(clamped, HELD[supports], count)
    (member,) = clamped.linkage.members
    pinned = single_bar(member.space, length, True)
    return buckling(LinearModel(pinned, clamped.material, states=clamped.states), HELD[supports], count)


def shapes_of(s: Specimen, mesh: SolidMesh, modes: tuple[Mode, ...]) -> list[AxisShape]:
    """Axis and twist of each mode."""
    radius = float(np.sqrt(polar_radius_squared(s)))
    return [axis_shape(mesh, mode.displacements[0], radius) for mode in modes]


def polar_radius_squared(s: Specimen) -> float:
    """r₀² = (Iy + Iz) / A of the section between the lugs, mm²."""
    return (s.constants.Iy + s.constants.Iz) / s.constants.area


def formulas_of(s: Specimen, supports: str) -> list[FormulaMode]:
    """As many modes by formula in each plane, and in torsion, as the solid has in all."""
    body, length = s.segments[len(s.segments) // 2], s.bar.length
    found = []
    for plane, shear in (("xy", body.GAy), ("xz", body.GAz)):
        # A bar pinned about y is clamped sideways.
        effective = "clamped" if (supports, plane) == ("pinned", "xy") else supports
        found += bending_modes(bending_of(s.model.stiffness, length, plane, shear), plane, effective, MODES)
    return [*found, *torsion_modes(body, length, supports, polar_radius_squared(s), MODES)]


def named(formula: FormulaMode) -> str:
    """A formula and its mode in words."""
    if formula.plane == "torsion":
        return f"torsion, mode {formula.number}, {TORSION}"
    return f"{formula.supports}, mode {formula.number} in {formula.plane}, Euler with shear and soft ends"


def with_band(
    record: Buckling, match: Match, beside: tuple[Mode, ...], levels: tuple[int, int], study: Convergence
) -> Buckling:
    """The record with its limit and error band, from the mode of the same shape on a second mesh and the study's order.

    Without such a mode there is neither.
    """
    if match.partner is None:
        return record.model_copy(update={"mesh_mac": match.mac})
    order = study.orders[ORDER_OF[record.plane]] or SLOWEST
    loads = (record.load_N, beside[match.partner].load)
    found = limit_of_two((1 / levels[0], 1 / levels[1]), loads, order)
    update = {"limit_N": found.limit, "band": found.band(record.load_N), "mesh_mac": match.mac}
    return record.model_copy(update=update)


def torsion_record(supports: str, load: float) -> Buckling:
    """The torsional load by formula."""
    return Buckling(
        body="bar", model="formula", supports=supports, plane="torsion", mode=1, load_N=load, formula=TORSION
    )


def solid_record(supports: str, number: int, mode: Mode) -> Buckling:
    """A mode of the solid as a record."""
    return Buckling(
        body="bar", model="solid", supports=supports, plane=mode.plane, mode=number, load_N=mode.load
    )


def with_formula(record: Buckling, match: Match, formulas: list[FormulaMode]) -> Buckling:
    """The record with the load of the formula of the same shape beside it; without one, which is nearest."""
    if match.partner is None:
        nearest = formulas[match.nearest]
        update = {"nearest": named(nearest), "nearest_N": nearest.load, "mac": match.mac}
        return record.model_copy(update=update)
    formula = formulas[match.partner]
    update = {
        "formula_N": formula.load,
        "formula": named(formula),
        "deviation": record.load_N / formula.load - 1.0,
        "mac": match.mac,
    }
    return record.model_copy(update=update)


def write_modes(mesh: SolidMesh, modes: tuple[Mode, ...], path: Path) -> None:
    """Mode shapes of one bar as point data mode_1 .. of a VTU file, largest displacement 1 mm."""
    import meshio

    fields = {
        f"mode_{n}": mode.displacements[0].reshape(-1, 3).astype(np.float32)
        for n, mode in enumerate(modes, 1)
    }
    with replacing(path) as part:
        body = meshio.Mesh(mesh.points, [(mesh.kind, mesh.cells)], point_data=fields)
        meshio.write(part, body, file_format="vtu")
