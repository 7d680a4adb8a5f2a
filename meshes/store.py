"""Solid meshes to and from files through meshio, and a cache of meshes by the hash of their input."""

import hashlib
import tempfile
from pathlib import Path

import numpy as np

from meshes.bar import Bar
from meshes.files import replacing
from meshes.resolution import Resolution
from meshes.solid import FACET_OF, SolidMesh
from meshes.workable import require_workable

# Part of the cache key: raise it when the same input would give another mesh.
MESHER = 2
FACES = ("base", "tip", "side")


def mesh_bar(bar: Bar, resolution: Resolution, tetrahedra: bool = False) -> SolidMesh:
    """Mesh a bar: swept hexahedra where its shape allows, else (or on request) tetrahedra.

    Raises ValueError if the mesh size cannot work, RuntimeError if gmsh fails.
    """
    require_workable(bar, resolution)
    # Late: gmsh needs libraries of the system that most commands do without.
    import gmsh

    from meshes.gmsh_session import session
    from meshes.sweep import build_swept
    from meshes.tets import build_tetrahedra

    with session("bar"), tempfile.TemporaryDirectory() as folder:
        try:
            (build_tetrahedra if tetrahedra or not bar.sweepable else build_swept)(bar, resolution)
        except Exception as error:
            if type(error) is not Exception:  # gmsh raises the bare class
                raise
            raise RuntimeError(f"gmsh could not mesh the bar: {error}") from error
        path = Path(folder) / "bar.msh"
        gmsh.write(str(path))
        return read_mesh(path)


def read_mesh(path: Path) -> SolidMesh:
    """Read a mesh with the named faces base, tip and side; ValueError if a face or the body is missing."""
    import meshio

    # meshio.read would end the process on a file that is no gmsh file; its reader raises.
    try:
        raw = meshio.gmsh.read(path)
    except (meshio.ReadError, ValueError, IndexError, KeyError, AssertionError, EOFError) as error:
        raise ValueError(f"{path}: not a readable gmsh mesh: {error}") from error
    kind = next((k for k in FACET_OF if k in raw.cells_dict), None)
    if kind is None:
        raise ValueError(f"{path}: no quadratic solid cells found, allowed are {', '.join(FACET_OF)}")
    facets = raw.cells_dict[FACET_OF[kind]]
    tags = raw.cell_data_dict["gmsh:physical"][FACET_OF[kind]]
    faces = {}
    for name in FACES:
        if name not in raw.field_data:
            raise ValueError(f"{path}: face {name!r} is missing, needed are {', '.join(FACES)}")
        faces[name] = facets[tags == raw.field_data[name][0]].astype(np.int64)
    return SolidMesh(np.asarray(raw.points, float), raw.cells_dict[kind].astype(np.int64), kind, faces)


def write_mesh(mesh: SolidMesh, path: Path) -> None:
    """Write the mesh with its named faces as a gmsh file; whole or not at all."""
    import meshio

    names = {name: np.array([i + 1, 2]) for i, name in enumerate(FACES)}
    names["body"] = np.array([len(FACES) + 1, 3])
    cells = [(FACET_OF[mesh.kind], mesh.faces[name]) for name in FACES] + [(mesh.kind, mesh.cells)]
    tags = [np.full(len(block), i + 1) for i, (_, block) in enumerate(cells)]
    data = {"gmsh:physical": tags, "gmsh:geometrical": tags}
    out = meshio.Mesh(mesh.points, cells, cell_data=data, field_data=names)
    with replacing(path) as part:
        meshio.write(part, out, file_format="gmsh22")


def cached_mesh(bar: Bar, resolution: Resolution, folder: Path, tetrahedra: bool = False) -> SolidMesh:
    """The mesh of this input, from `folder` if it has been made before; a damaged file is made again."""
    import gmsh

    key = repr((MESHER, gmsh.__version__, bar, resolution, tetrahedra))
    path = folder / f"bar-{hashlib.sha256(key.encode()).hexdigest()[:20]}.msh"
    if path.exists():
        try:
            return read_mesh(path)
        except ValueError:
            path.unlink(missing_ok=True)
    mesh = mesh_bar(bar, resolution, tetrahedra)
    write_mesh(mesh, path)
    return mesh
