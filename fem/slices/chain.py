"""A swept mesh as a chain of slices that is kept: displacements for loads on its nodes and motions of its tip face."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import scipy.sparse as sp

from fem.material import Isotropic
from fem.reduction import node_dofs
from fem.slices.classes import classes, mirrors, said
from fem.slices.condensed import Slice
from fem.slices.layer_matrix import LayerMatrix
from fem.slices.pieces import ClassChain, Piece, pieces_of_run
from fem.slices.stiffness import ClassOfLayer
from meshes.layers import SweptMesh
from meshes.solid import Floats, Ints


@dataclass(frozen=True, eq=False)
class Coordinates:
    """Unknowns of one class over the whole mesh: all planes, then all middles.

    spread : sparse (dofs, k), orthonormal; node displacements for unknowns, and its transpose for loads
    bounds : where the second part starts, the third one, ..
    """

    spread: sp.csr_matrix
    bounds: Ints

    @staticmethod
    def of(
        swept: SweptMesh, planes: Sequence[sp.csc_matrix], middles: Sequence[sp.csc_matrix]
    ) -> "Coordinates":
        """From the bases of every plane and every middle."""
        rows, columns, values, start = [], [], [], [0]
        for basis, nodes in zip((*planes, *middles), (*swept.planes, *swept.middles), strict=True):
            entries = basis.tocoo()
            rows.append(node_dofs(nodes)[entries.row])
            columns.append(start[-1] + entries.col)
            values.append(entries.data)
            start.append(start[-1] + basis.shape[1])
        parts = (np.concatenate(values), (np.concatenate(rows), np.concatenate(columns)))
        spread = sp.csr_matrix(parts, shape=(swept.mesh.dofs, start[-1]))
        return Coordinates(spread, np.array(start[1:-1]))


@dataclass(frozen=True, eq=False)
class Chain:
    """A sweep with both end faces held, ready to solve.

    views    : for each class, the view of every shape of layer
    chains   : for each class, its pieces
    matrices : of every shape of layer
    """

    swept: SweptMesh
    axes: tuple[int, ...]
    views: tuple[tuple[ClassOfLayer, ...], ...]
    chains: tuple[ClassChain, ...]
    matrices: tuple[LayerMatrix, ...]

    @staticmethod
    def of(swept: SweptMesh, material: Isotropic, axes: Sequence[int] | None = None) -> "Chain":
        """The chain of a mesh, by the mirrors `axes` of its section, by default all it has (`mirrors`).

        Keeps four matrices of the size of a plane for every doubling and joint. Raises SolveError if a slice is not
        held, ValueError if the section has no such mirror.
        """
        sweep = swept.sweep
        axes = mirrors(sweep) if axes is None else tuple(axes)
        matrices = tuple(LayerMatrix.of(layer, material) for layer in sweep.shapes)
        views = tuple(tuple(ClassOfLayer(layer, signs) for layer in sweep.shapes) for signs in classes(axes))
        pieces: list[list[Piece]] = [[] for _ in views]
        known: list[dict[tuple[int, float], Slice]] = [{} for _ in views]
        for run in sweep.runs():
            key = (run.shape, run.thickness)
            stiffness = None if key in known[0] else matrices[run.shape].stiffness(run.thickness)
            for view, slices, found in zip(views, known, pieces, strict=True):
                if stiffness is not None:
                    slices[key] = view[run.shape].slice(stiffness, run.thickness)
                found += pieces_of_run(slices[key], run.start, run.count, view[run.shape].rigid[0])
        return Chain(swept, axes, views, tuple(ClassChain.of(p) for p in pieces), matrices)

    @property
    def name(self) -> str:
        """What it is, for results."""
        return f"slice chain, {said(self.axes)}"

    @cached_property
    def coordinates(self) -> tuple["Coordinates", ...]:
        """The unknowns of each class."""
        shapes = self.swept.sweep.shape_of
        found = []
        for view in self.views:
            planes = [view[shape].bases[0] for shape in shapes] + [view[shapes[-1]].bases[2]]
            middles = [view[shape].bases[1] for shape in shapes]
            found.append(Coordinates.of(self.swept, planes, middles))
        return tuple(found)

    def solve(self, loads: Floats, tip: Floats | None = None) -> Floats:
        """Node displacements (dofs, r) for nodal forces (dofs, r), N; base face at rest, tip face at rest or moved.

        tip : (3 f, r) displacements of the last plane's nodes, in the order of `swept.planes[-1]`
        Forces on the two faces have no effect.
        """
        out = np.zeros_like(loads)
        end = np.zeros((3 * len(self.swept.planes[-1]), loads.shape[1])) if tip is None else tip
        last = self.swept.sweep.shape_of[-1]
        for view, chain, own in zip(self.views, self.chains, self.coordinates, strict=True):
            parts = np.split(own.spread.T @ loads, own.bounds)
            count = len(self.swept.planes)
            planes, middles = chain.solve(parts[:count], parts[count:], view[last].bases[2].T @ end)
            out += own.spread @ np.concatenate((*planes, *middles))
        return out

    def product(self, u: Floats) -> Floats:
        """Nodal forces (dofs, r) of node displacements `u`: the stiffness of the whole mesh, layer by layer."""
        out = np.zeros_like(u)
        for stiffness, dofs in self._runs:
            moved = u[dofs]
            forces = (stiffness @ moved.reshape(len(dofs), -1)).reshape(moved.shape)
            # Of every other layer, no two of which have a node in common.
            for own in (slice(0, None, 2), slice(1, None, 2)):
                out[dofs[:, own]] += forces[:, own]
        return out

    @cached_property
    def _runs(self) -> list[tuple[sp.csr_matrix, Ints]]:
        """For each run of equal layers the stiffness of one, and the mesh's unknowns (n, layers) of its own."""
        return [
            (
                self.matrices[run.shape].stiffness(run.thickness),
                np.stack([self._layer_dofs(i) for i in range(run.start, run.start + run.count)], axis=1),
            )
            for run in self.swept.sweep.runs()
        ]

    def _layer_dofs(self, number: int) -> Ints:
        """The mesh's unknown for each of a layer's own."""
        s = self.swept
        layer = s.sweep.shapes[s.sweep.shape_of[number]]
        node = np.empty(len(layer.mesh.points), dtype=np.int64)
        parts = (s.planes[number], s.middles[number], s.planes[number + 1])
        for own, nodes in zip((layer.first, layer.middle, layer.last), parts, strict=True):
            node[own[own >= 0]] = nodes[own >= 0]
        return node_dofs(node)
