"""A STEP, IGES or BREP file as a solid: read, judged and meshed with curved tetrahedra, or found to be a prism."""

from pathlib import Path
from typing import Any

import gmsh
import numpy as np

from meshes.brought.child import Arrays
from meshes.brought.found import packed, packed_prism
from meshes.brought.of_gmsh import raw_of_model, region_name
from meshes.brought.prism import swept
from meshes.brought.units import scale_of
from meshes.gmsh_session import session

OWN_UNIT = (".step", ".stp", ".iges", ".igs")
SUFFIXES = (".step", ".stp", ".iges", ".igs", ".brep")
AROUND = 12
"""Elements a turn of a curved wall."""
# Of volume over surface: a mesh size at which bar P has 12 000 unknowns.
COARSE = 6.0
# Of the sum of volumes: overlapping solids have less together.
SAME_VOLUME = 1e-6


def work(asked: dict[str, Any]) -> tuple[dict[str, Any], Arrays]:
    """In the child: mesh the file at `asked["path"]` on two nested meshes.

    Keys of asked: path, unit, size (mm or None), base and tip (tables of ends or None), y (of the bar, or None),
    tetrahedra (whether a prism is not to be swept). ValueError says what is wrong.
    """
    with session("brought"):
        gmsh.option.setNumber("General.Verbosity", 0)
        solids = read_solids(Path(asked["path"]), asked["unit"])
        size = asked["size"] or default_size(solids)
        complete = asked["base"] is not None and asked["tip"] is not None
        prism = swept(solids, asked, size) if complete and not asked.get("tetrahedra") else None
        if prism is not None:
            told, arrays = packed_prism(prism.drawn, prism.base, prism.tip)
        else:
            gmsh.model.mesh.clear()
            _mesh(size)
            raws = [raw_of_model(with_faces=True)]
            if complete:
                # Of linear cells, with the new nodes on the surface.
                gmsh.model.mesh.refine()
                gmsh.model.mesh.setOrder(2)
                raws.append(raw_of_model())
            told, arrays = packed(raws, asked)
    return {**told, "size_mm": size, "meshed": "a prism, swept" if prism else "curved tetrahedra"}, arrays


def read_solids(path: Path, unit: str | None) -> list[tuple[int, int]]:
    """Import the shapes in mm into the open model; ValueError for shells, bodies that are not joined, or overlap."""
    own = path.suffix.lower() in OWN_UNIT
    if own and unit is not None:
        raise ValueError(f"has its own unit in it, but unit = {unit!r} is declared; leave unit out")
    if not own and unit is None:
        raise ValueError('has no unit of its own; write unit = "mm" (or cm, m, um, inch)')
    if path.suffix.lower() in (".step", ".stp"):
        # Of IGES it is the reader's own default, which cannot be set before it is loaded.
        gmsh.option.setString("Geometry.OCCTargetUnit", "MM")
    shapes = gmsh.model.occ.importShapes(str(path), highestDimOnly=True)
    if not own and unit is not None and (scale := scale_of(unit)) != 1.0:
        gmsh.model.occ.dilate(shapes, 0.0, 0.0, 0.0, scale, scale, scale)
    gmsh.model.occ.synchronize()
    solids: list[tuple[int, int]] = gmsh.model.getEntities(3)
    if not solids and gmsh.model.getEntities(2):
        # IGES has the faces of a solid, and not that they are one.
        gmsh.model.occ.healShapes(sewFaces=True, makeSolids=True)
        gmsh.model.occ.synchronize()
        solids = gmsh.model.getEntities(3)
    if not solids:
        faces = len(gmsh.model.getEntities(2))
        raise ValueError(
            f"holds {faces} faces and no solid, allowed is a closed solid: shells and open surfaces have no thickness"
            if faces
            else "holds no solid"
        )
    return solids if len(solids) == 1 else joined(solids)


def joined(solids: list[tuple[int, int]]) -> list[tuple[int, int]]:
    """Several solids with common faces made one; ValueError names those that touch no other, or that overlap."""
    names = [region_name(s) for s in solids]
    before = sum(gmsh.model.occ.getMass(*s) for s in solids)
    _, parts = gmsh.model.occ.fragment(solids[:1], solids[1:])
    gmsh.model.occ.synchronize()
    after: list[tuple[int, int]] = gmsh.model.getEntities(3)
    volume = sum(gmsh.model.occ.getMass(*s) for s in after)
    if abs(volume - before) > SAME_VOLUME * before:
        raise ValueError(f"its solids {', '.join(names)} overlap, allowed are solids that touch")
    for name, own in zip(names, parts, strict=True):
        for part in own:
            gmsh.model.setEntityName(*part, name)
    faces = [{tag for _, tag in gmsh.model.getBoundary([s], oriented=False)} for s in after]
    reached, growing = {0}, True
    while growing:
        more = {
            k for k in range(len(after)) if k not in reached and any(faces[k] & faces[r] for r in reached)
        }
        growing = bool(more)
        reached |= more
    if len(reached) < len(after):
        left = ", ".join(region_name(after[k]) for k in range(len(after)) if k not in reached)
        raise ValueError(
            f"holds {len(after)} solids, and {left} shares no face with the others: allowed is one body; join them "
            "in the CAD system"
        )
    return after


def default_size(solids: list[tuple[int, int]]) -> float:
    """A mesh size by how thick the part is, mm."""
    volume = sum(gmsh.model.occ.getMass(*s) for s in solids)
    outer = gmsh.model.getBoundary(solids, combined=True, oriented=False)
    area = sum(gmsh.model.occ.getMass(*f) for f in outer)
    if not (np.isfinite(volume) and volume > 0.0 and area > 0.0):
        raise ValueError(f"has a volume of {volume:g} mm³, allowed is a closed solid")
    return COARSE * volume / area


def _mesh(size: float) -> None:
    """Curved tetrahedra: of second order from the start, so that they are mended where a wall folds them over."""
    option = gmsh.option.setNumber
    option("Mesh.ElementOrder", 2)
    option("Mesh.SecondOrderLinear", 0)
    option("Mesh.HighOrderOptimize", 2)
    option("Mesh.MeshSizeMax", size)
    option("Mesh.MeshSizeFromCurvature", AROUND)
    gmsh.model.mesh.generate(3)
