"""A prism as its child process hands it over: the section's plane meshes and how thick the layers are."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from meshes.brought.child import Arrays
from meshes.extrusion import drawn, solid
from meshes.layers import Sweep
from meshes.part import FACETS, PartMesh
from meshes.plane import PlaneMesh
from meshes.solid import Floats

KIND = "hexahedron27"
"""The full 27 nodes, for curved walls carry rigid motions exactly by these alone."""


@dataclass(frozen=True, eq=False)
class Drawn:
    """A section drawn through layers of hexahedra along x of the bar, on nested levels, coarse to fine.

    flats     : the section's meshes, y and z about the base point, mm
    thickness : (n,) mm of every layer, base first, of each level
    origin    : (3,) mm, the base point in the file's frame; `turn` (3, 3): rows x, y, z of the bar there
    region    : name of the solid
    """

    flats: tuple[PlaneMesh, ...]
    thickness: tuple[Floats, ...]
    origin: Floats
    turn: Floats
    region: str

    @property
    def sweeps(self) -> tuple[Sweep, ...]:
        """Of every level: what a chain of slices needs, without a mesh of the whole bar."""
        return tuple(drawn(f, KIND, t.tolist()) for f, t in zip(self.flats, self.thickness, strict=True))

    @property
    def meshes(self) -> tuple[PartMesh, ...]:
        """Of every level the solid mesh in the file's frame, with the facets "base" and "tip"."""
        return tuple(self._mesh(f, t) for f, t in zip(self.flats, self.thickness, strict=True))

    def _mesh(self, flat: PlaneMesh, thickness: Floats) -> PartMesh:
        mesh = solid(flat, KIND, thickness.tolist()).mesh
        count = len(flat.cells)
        before, behind = (np.array(FACETS[KIND]["quad9"][k]) for k in (0, 1))
        facets = {
            "base": {"quad9": mesh.cells[:count][:, before]},
            "tip": {"quad9": mesh.cells[-count:][:, behind]},
        }
        points = self.origin + mesh.points @ self.turn
        region_of = np.zeros(len(mesh.cells), dtype=np.int64)
        return PartMesh.of(points, ((KIND, mesh.cells),), region_of, (self.region,), facets)

    def packed(self) -> Arrays:
        """As plain arrays; the region's name travels beside them."""
        arrays: Arrays = {"origin": self.origin, "turn": self.turn}
        for level, (flat, thickness) in enumerate(zip(self.flats, self.thickness, strict=True)):
            arrays |= {
                f"{level} flat": flat.points,
                f"{level} quads": flat.cells,
                f"{level} thickness": thickness,
            }
        return arrays

    @staticmethod
    def unpacked(told: Mapping[str, Any], arrays: Arrays) -> "Drawn":
        """What `packed` made."""
        levels = range(sum(key.endswith(" flat") for key in arrays))
        flats = tuple(PlaneMesh(arrays[f"{k} flat"], arrays[f"{k} quads"]) for k in levels)
        thickness = tuple(arrays[f"{k} thickness"] for k in levels)
        return Drawn(flats, thickness, arrays["origin"], arrays["turn"], told["regions"][0])
