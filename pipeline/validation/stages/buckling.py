"""Linear buckling of the bar under named supports, beside the formulas, with the mode shapes as files."""

from pathlib import Path

import meshio
import numpy as np

from fem.buckling import Mode, buckling
from fem.convergence import limit_of_two
from fem.euler import bending_of, critical_compression, torsional_load
from fem.linear import LinearModel
from fem.linkage import single_bar
from fem.space import Space
from meshes.files import replacing
from meshes.solid import SolidMesh
from pipeline.progress import Stage
from pipeline.validation.result import Buckling, Convergence
from pipeline.validation.stages.specimen import Specimen

ALL_BUT_X = ("y", "z", "rx", "ry", "rz")
HELD: dict[str, tuple[str, ...]] = {
    "free": (),
    "guided": ("rx", "ry", "rz"),
    "clamped": ALL_BUT_X,
    "pinned": ALL_BUT_X,
}
MODES = 6
# Half waves of warping for the torsional formula: a free tip warps and turns, all others neither.
WARPING_WAVES = {"free": 0.5, "guided": 2.0, "clamped": 2.0, "pinned": 2.0}


# Entry of K_b whose order of convergence a mode in each plane has: that of its bending, or of the twist.
ORDER_OF = {"xy": "K66", "xz": "K55", "torsion": "K44"}
# Where the mesh study found no order.
SLOWEST = 1.0


def mode_files() -> tuple[str, ...]:
    """Names of the files with the mode shapes."""
    return tuple(f"{name}.vtu" for name in HELD)


def buckle_bar(s: Specimen, study: Convergence, folder: Path, stage: Stage) -> list[Buckling]:
    """Modes of all supports with their mesh errors and formulas; the shapes go to `folder`, a file for each support."""
    stiffness = s.model.stiffness
    body = s.segments[len(s.segments) // 2]
    planes = {
        "xy": bending_of(stiffness, s.bar.length, "xy", body.GAy),
        "xz": bending_of(stiffness, s.bar.length, "xz", body.GAz),
    }
    polar = (s.constants.Iy + s.constants.Iz) / s.constants.area
    other = s.detail.companion
    space = Space.of(s.mesh(other))
    records = []
    for supports in HELD:
        stage.say(f"{supports} tip")
        modes = modes_of(s, s.space, supports)
        write_modes(s.space.mesh, modes, folder / f"{supports}.vtu")
        beside = by_plane(modes_of(s, space, supports))
        seen = {"xy": 0, "xz": 0, "torsion": 0}
        for number, mode in enumerate(modes, 1):
            seen[mode.plane] += 1
            record = solid_record(supports, number, mode)
            if len(beside[mode.plane]) >= seen[mode.plane]:
                twin = beside[mode.plane][seen[mode.plane] - 1].load
                record = with_band(record, twin, (s.detail.working, other), study)
            if mode.plane != "torsion":
                # A bar pinned about y is clamped sideways.
                effective = "clamped" if (supports, mode.plane) == ("pinned", "xy") else supports
                load = critical_compression(planes[mode.plane], effective, seen[mode.plane])
                name = f"{effective}, mode {seen[mode.plane]} in {mode.plane}, Euler with shear and soft ends"
                record = with_formula(record, load, name)
            records.append(record)
        torsion = torsional_load(body, WARPING_WAVES[supports], polar)
        records.append(torsion_record(supports, torsion))
    return records


def modes_of(s: Specimen, space: Space, supports: str) -> tuple[Mode, ...]:
    """The lowest modes of the bar under named supports, on the working mesh or another one."""
    if supports != "pinned" and space is s.space:
        return buckling(s.model, HELD[supports], MODES)
    model = LinearModel(single_bar(space, s.bar.length, supports == "pinned"), s.material)
    return buckling(model, HELD[supports], MODES)


def by_plane(modes: tuple[Mode, ...]) -> dict[str, list[Mode]]:
    """The modes of each plane, lowest first."""
    return {plane: [m for m in modes if m.plane == plane] for plane in ORDER_OF}


def with_band(record: Buckling, twin: float, levels: tuple[int, int], study: Convergence) -> Buckling:
    """The record with its limit and error band, from the same mode on a second mesh and the study's order."""
    order = study.orders[ORDER_OF[record.plane]] or SLOWEST
    found = limit_of_two((1 / levels[0], 1 / levels[1]), (record.load_N, twin), order)
    return record.model_copy(update={"limit_N": found.limit, "band": found.band(record.load_N)})


def torsion_record(supports: str, load: float) -> Buckling:
    """The torsional load by formula."""
    return Buckling(
        body="bar",
        model="formula",
        supports=supports,
        plane="torsion",
        mode=1,
        load_N=load,
        formula="(GJ + (n π/L)² EIw) / r₀²",
    )


def solid_record(supports: str, number: int, mode: Mode) -> Buckling:
    """A mode of the solid as a record."""
    return Buckling(
        body="bar", model="solid", supports=supports, plane=mode.plane, mode=number, load_N=mode.load
    )


def with_formula(record: Buckling, load: float, name: str) -> Buckling:
    """The record with a formula's load beside it."""
    update = {"formula_N": load, "formula": name, "deviation": record.load_N / load - 1.0}
    return record.model_copy(update=update)


def write_modes(mesh: SolidMesh, modes: tuple[Mode, ...], path: Path) -> None:
    """Mode shapes of one bar as point data mode_1 .. of a VTU file, largest displacement 1 mm."""
    fields = {
        f"mode_{n}": mode.displacements[0].reshape(-1, 3).astype(np.float32)
        for n, mode in enumerate(modes, 1)
    }
    with replacing(path) as part:
        body = meshio.Mesh(mesh.points, [(mesh.kind, mesh.cells)], point_data=fields)
        meshio.write(part, body, file_format="vtu")
