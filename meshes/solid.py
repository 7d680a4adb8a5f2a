"""The solid mesh that the finite elements take: quadratic cells and named faces, frozen arrays."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

# Corners at the ends of each edge of a hexahedron, in the order of its mid-edge nodes.
EDGES = np.array(
    [[0, 1], [1, 2], [2, 3], [3, 0], [4, 5], [5, 6], [6, 7], [7, 4], [0, 4], [1, 5], [2, 6], [3, 7]]
)
FACET_OF = {"hexahedron20": "quad8", "hexahedron27": "quad9", "tetra10": "triangle6"}


@dataclass(frozen=True)
class SolidMesh:
    """Quadratic solid mesh.

    points : (n, 3) mm, in the bar's own frame (x along the bar, origin at the base point)
    cells  : (m, k) node numbers in the order of meshio
    kind   : meshio's name of the cell type, a key of `FACET_OF`
    faces  : named sets of boundary facets, each (f, 8 | 9 | 6) node numbers
    """

    points: Floats
    cells: Ints
    kind: str
    faces: Mapping[str, Ints]

    def __post_init__(self) -> None:
        if self.kind not in FACET_OF:
            raise ValueError(f"cell kind is {self.kind!r}, allowed are {', '.join(FACET_OF)}")
        for array in (self.points, self.cells, *self.faces.values()):
            array.setflags(write=False)

    @property
    def dofs(self) -> int:
        """Number of displacement degrees of freedom."""
        return 3 * len(self.points)

    def face_nodes(self, name: str) -> Ints:
        """Sorted node numbers of a named face; KeyError with the known names if there is none."""
        if name not in self.faces:
            raise KeyError(f"face {name!r} is not in this mesh, known are {', '.join(self.faces)}")
        return np.unique(self.faces[name])

    def moved(self, displacement: Floats) -> "SolidMesh":
        """The same mesh with its nodes moved by `displacement`, (n, 3) mm; edges of 20-node cells stay straight."""
        points = self.points + displacement
        if self.kind == "hexahedron20":
            ends = self.cells[:, EDGES]
            points[self.cells[:, 8:]] = points[ends].mean(axis=2)
        return SolidMesh(points, self.cells, self.kind, self.faces)
