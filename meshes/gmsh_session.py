"""One quiet, repeatable gmsh session at a time."""

from collections.abc import Iterator
from contextlib import contextmanager

import gmsh


@contextmanager
def session(name: str) -> Iterator[None]:
    """Open a gmsh model that meshes the same way every time and leave nothing behind."""
    if gmsh.isInitialized():
        raise RuntimeError("gmsh is already in use in this process, which can hold one session at a time")
    # A user's own configuration would change the mesh behind the cache's back.
    gmsh.initialize(readConfigFiles=False, interruptible=False)
    try:
        gmsh.option.setNumber("General.Terminal", 0)
        # meshio writes several cell types to one file only in version 2.2: one version both ways.
        gmsh.option.setNumber("Mesh.MshFileVersion", 2.2)
        # More than one thread changes the node order from run to run.
        gmsh.option.setNumber("General.NumThreads", 1)
        gmsh.model.add(name)
        yield
    finally:
        gmsh.finalize()
