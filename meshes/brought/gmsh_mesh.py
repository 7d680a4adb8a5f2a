"""Meshes that gmsh reads: its own, those of I-deas (UNV) and of Salome (MED)."""

from pathlib import Path
from typing import Any

import gmsh

from meshes.brought.as_found import found_on_one_mesh
from meshes.brought.child import Arrays
from meshes.brought.of_gmsh import raw_of_model
from meshes.gmsh_session import session

SUFFIXES = (".msh", ".unv", ".med")


def work(asked: dict[str, Any]) -> tuple[dict[str, Any], Arrays]:
    """In the child: the mesh at `asked["path"]` as it is; keys as in `meshes.brought.cad.work`."""
    path = Path(asked["path"])
    with session("brought"):
        gmsh.option.setNumber("General.Verbosity", 0)
        gmsh.merge(str(path))
        gmsh.model.mesh.removeDuplicateNodes()
        raw = raw_of_model()
    return found_on_one_mesh(raw, asked)
