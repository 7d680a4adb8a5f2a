"""Stressed states of bodies that are loaded at their two rigid ends alone, as combinations of a few.

How such a body is stressed follows from the motion of its tip against its base, six numbers. As many loads of both ends
are in equilibrium by themselves: of twelve components six balance the others. They are the axial force, the torque, and
in either plane the moments at both ends, from whose difference the shear force follows. Stress is linear in them, and
K_g is linear in stress: what was put together for some states gives that of every combination of them. A bar that is
symmetric about two planes is in the same state under all supports when it is pushed along its axis.
"""

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from fem.anisotropic import Regional
from fem.elasticity import internal_forces, nodal_geometric_stiffness, stress
from fem.material import Isotropic
from fem.rigid_motions import rigid_motions
from fem.space import Space
from meshes.solid import Floats

# Share of the strains of a state that others leave: below the first it is the solver's rounding; above the second it is
# a state of its own, from which others can be combined without loss.
SAME, OWN = 1e-10, 1e-3


@dataclass(frozen=True, eq=False)
class EndState:
    """One state. ends: (6,) as of `end_strains`. geometric: K_g between nodes, sparse (nodes, nodes)
    N/mm, alike in all three directions. forces: (dofs,) of the nodes, N."""

    ends: Floats
    geometric: sp.csr_matrix
    forces: Floats


class EndStates:
    """States of bodies of one material, those put together so far."""

    def __init__(self) -> None:
        self._known: dict[int, tuple[Space, list[EndState]]] = {}

    def of(self, space: Space, material: Isotropic | Regional, u: Floats) -> EndState:
        """The state of node displacements `u` (dofs,), mm, whose inner nodes are free of load."""
        ends = end_strains(space, u)
        known = self._known.setdefault(id(space), (space, []))[1]
        left = 1.0
        if known:
            every = np.column_stack([state.ends for state in known])
            shares = np.asarray(np.linalg.lstsq(every, ends)[0], dtype=np.float64)
            left = float(np.linalg.norm(every @ shares - ends) / np.linalg.norm(ends))
            if left <= SAME:
                return combined(known, shares, ends)
        sigma = stress(space, material, u)
        state = EndState(ends, nodal_geometric_stiffness(space, sigma), internal_forces(space, sigma))
        if left > OWN:
            known.append(state)
        return state


def combined(states: list[EndState], shares: Floats, ends: Floats) -> EndState:
    """The state of so much of each, shares (k,): their matrices have one pattern."""
    first = states[0].geometric
    data = sum(share * state.geometric.data for share, state in zip(shares, states, strict=True))
    geometric = sp.csr_matrix((data, first.indices, first.indptr), shape=first.shape)
    return EndState(ends, geometric, sum(s * state.forces for s, state in zip(shares, states, strict=True)))


def end_strains(space: Space, u: Floats) -> Floats:
    """(6,) motion of the tip less that of the base, in bar coordinates and about the middle of the base, as the strain
    that it makes, about: a shift along x over the length l; with h of the section, one across it and the turns by
    h / l."""
    mesh, nodal = space.mesh, u.reshape(-1, 3)
    base, tip = (mesh.face_nodes(which) for which in ("base", "tip"))
    middle = mesh.points[base].mean(axis=0)
    length = float(np.linalg.norm(mesh.points[tip].mean(axis=0) - middle))
    motions = [
        np.linalg.lstsq(rigid_motions((mesh.points[nodes] - middle) / length), nodal[nodes].ravel())[0]
        for nodes in (base, tip)
    ]
    slim = float(np.abs(mesh.points[base] - middle).max()) / length
    return np.asarray((motions[1] - motions[0]) / length * np.array([1.0, slim, slim, slim, slim, slim]))
