"""A brought part as a bar: K_b by three ways to tie its ends, K_g, and the study of nested meshes."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import scipy.sparse as sp

from fem.anisotropic import Regional
from fem.axial import AxialStiffness, axial_stiffness
from fem.distributed import distributed_stiffness
from fem.elasticity import stiffness_matrix
from fem.end_states import EndStates
from fem.linear import LinearModel
from fem.linkage import single_bar
from fem.material import Isotropic
from fem.part_space import part_space
from fem.slices.solver import SolverOf, by_chain
from fem.space import Space
from meshes.facets import facet_normals
from meshes.part import CORNERS, PartMesh
from meshes.solid import Floats, Ints

TIES = ("rigid", "half", "distributed")


@dataclass(frozen=True, eq=False)
class PartBar:
    """A part in the bar's frame: base point at the origin, tip point at (`length`, 0, 0) mm, ends facets of the mesh.

    bores : whether base and tip are bores, of which a pin presses one half
    """

    mesh: PartMesh
    length: float
    material: Isotropic | Regional
    bores: tuple[bool, bool]

    @cached_property
    def space(self) -> Space:
        return part_space(self.mesh)

    def model(self, tie: str) -> LinearModel:
        """The bar clamped at its base with rigid ends, "rigid" or "half", or "pinned" at both; kept for the first."""
        if tie == "rigid":
            return self._rigid
        if tie == "pinned":
            return self._model(pinned=True)
        half = single_bar(self._half, self.length)
        return LinearModel(half, self.material, known=self._elastic, states=self._states)

    @cached_property
    def _rigid(self) -> LinearModel:
        return self._model(pinned=False)

    def _model(self, pinned: bool) -> LinearModel:
        linkage = single_bar(self.space, self.length, pinned)
        return LinearModel(linkage, self.material, self.solver_of(linkage), self._elastic, self._states)

    @cached_property
    def solver_of(self) -> SolverOf:
        """Of linkages of parts like this one with rigid ends."""
        return by_chain(self.mesh, self.material)

    @cached_property
    def _states(self) -> EndStates:
        return EndStates()

    @cached_property
    def _elastic(self) -> sp.csr_matrix:
        """(dofs, dofs) stiffness of the part, nothing held: what all ties and supports share."""
        return stiffness_matrix(self.space, self.material)

    @cached_property
    def _half(self) -> Space:
        """The same space with only the pressed facets of its bores as ends."""
        ends = {
            which: pressed(self.mesh.points, self.mesh.facets[which], pull)
            if bore
            else self.mesh.facets[which]
            for which, bore, pull in zip(("base", "tip"), self.bores, (-1.0, 1.0), strict=True)
        }
        s = self.space
        return Space(self.mesh.named(ends), s.gradients, s.weights, s.connectivity)

    @property
    def ties(self) -> tuple[str, ...]:
        """Ways to tie the ends that differ: a plane end has no half that is pressed."""
        return TIES if any(self.bores) else ("rigid", "distributed")

    def stiffness(self, tie: str) -> Floats:
        """(6, 6) K_b, N, mm, rad. ValueError for an unknown tie, SolveError if it cannot be solved."""
        if tie not in TIES:
            raise ValueError(f"tie is {tie!r}, allowed are {', '.join(TIES)}")
        if tie != "distributed":
            return self.model(tie).stiffness
        points = (np.zeros(3), np.array([self.length, 0.0, 0.0]))
        facets = (self.mesh.facets["base"], self.mesh.facets["tip"])
        return distributed_stiffness(self.mesh, self._elastic, facets, points)

    def axial(self, tie: str) -> AxialStiffness:
        """K_b and K_g by rigid ends."""
        return axial_stiffness(self.model(tie))


def pressed(points: Floats, facets: Mapping[str, Ints], pull: float) -> dict[str, Ints]:
    """The facets of a bore (or of a shaft's end) that a pin presses when it pulls along `pull` x: those facing it.

    points: (n, 3). facets: numbers (m, k) of nodes by their kind.
    """
    found = {}
    for kind, own in facets.items():
        _, normals, _ = facet_normals(points, own[:, : CORNERS[kind]])
        if (facing := normals[:, 0] * pull < 0.0).any():
            found[kind] = own[facing]
    return found
