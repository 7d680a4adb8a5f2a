"""Quadratic tetrahedra: the fallback where the bar cannot be swept, and an independent check where it can."""

import gmsh

from meshes.bar import Bar
from meshes.resolution import Resolution
from meshes.sweep import add_patch, name_faces


def build_tetrahedra(bar: Bar, resolution: Resolution) -> None:
    """Fill the open gmsh model with the bar united to one solid, meshed with 10-node tetrahedra."""
    occ = gmsh.model.occ
    surfaces = [(2, add_patch(patch, 0.0)) for patch in bar.section.patches()]
    a = 0.0 if bar.lug is None else bar.lug.length
    occ.translate(surfaces, a, 0.0, 0.0)
    made = occ.extrude(surfaces, bar.length - 2 * a, 0.0, 0.0)
    parts = [entity for entity in made if entity[0] == 3]
    if bar.lug is not None:
        w, h = bar.lug.width, bar.lug.height
        parts += [(3, occ.addBox(x, -w / 2, -h / 2, a, w, h)) for x in (0.0, bar.length - a)]
    if len(parts) > 1:
        occ.fuse(parts[:1], parts[1:])
    occ.synchronize()
    name_faces(bar.length)
    gmsh.option.setNumber("Mesh.MeshSizeMax", resolution.size / resolution.level)
    gmsh.option.setNumber("Mesh.MeshSizeMin", resolution.size / resolution.level / 4.0)
    # A coarse quadratic cell on a curved wall folds over: follow the curvature, then straighten what still folds.
    gmsh.option.setNumber("Mesh.MeshSizeFromCurvature", 12)
    gmsh.option.setNumber("Mesh.HighOrderOptimize", 1)
    gmsh.model.mesh.generate(3)
    gmsh.model.mesh.setOrder(2)
