"""Linear buckling of the bar under named supports, beside the formulas, with the mode shapes as files."""

from pathlib import Path

import meshio
import numpy as np

from fem.buckling import Mode, buckling
from fem.euler import bending_of, critical_compression, torsional_load
from fem.linear import LinearModel
from fem.linkage import single_bar
from meshes.files import replacing
from meshes.solid import SolidMesh
from pipeline.progress import Stage
from pipeline.validation.result import Buckling
from pipeline.validation.stages.bar import Specimen, working_stiffness

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


def mode_files() -> tuple[str, ...]:
    """Names of the files with the mode shapes."""
    return tuple(f"{name}.vtu" for name in HELD)


def buckle_bar(s: Specimen, folder: Path, stage: Stage) -> list[Buckling]:
    """Modes of all supports with their formulas; the shapes go to `folder`, a file for each support."""
    stiffness = working_stiffness(s)
    body = s.segments[len(s.segments) // 2]
    planes = {
        "xy": bending_of(stiffness, s.bar.length, "xy", body.GAy),
        "xz": bending_of(stiffness, s.bar.length, "xz", body.GAz),
    }
    records = []
    for supports, held in HELD.items():
        stage.say(f"{supports} tip")
        model = LinearModel(single_bar(s.space, s.bar.length, supports == "pinned"), s.material)
        modes = buckling(model, held, MODES)
        write_modes(s.space.mesh, modes, folder / f"{supports}.vtu")
        seen = {"xy": 0, "xz": 0, "torsion": 0}
        for number, mode in enumerate(modes, 1):
            seen[mode.plane] += 1
            records.append(solid_record(supports, number, mode))
            if mode.plane != "torsion":
                # A bar pinned about y is clamped sideways.
                effective = "clamped" if (supports, mode.plane) == ("pinned", "xy") else supports
                load = critical_compression(planes[mode.plane], effective, seen[mode.plane])
                name = f"{effective}, mode {seen[mode.plane]} in {mode.plane}, Euler with shear and soft ends"
                records[-1] = with_formula(records[-1], load, name)
        polar = (s.constants.Iy + s.constants.Iz) / s.constants.area
        records.append(
            Buckling(
                body="bar",
                model="formula",
                supports=supports,
                plane="torsion",
                mode=1,
                load_N=torsional_load(body, WARPING_WAVES[supports], polar),
                formula="(GJ + (n π/L)² EIw) / r₀²",
            )
        )
    return records


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
