"""K_b of a sweep as a chain of slices: no matrix of the whole mesh is made, equal layers are doubled.

n equal layers take log2(n) doublings: of the powers of two as they come up, those of n's binary digits are joined to
what is already fixed at the base. A sweep with layers of several thicknesses is one such run after the other.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import scipy.sparse as sp

from fem.material import Isotropic
from fem.slices.classes import Signs, along_x, class_basis, classes, mirrors, section
from fem.slices.condensed import Prism, Slice, Stretch, condensed, doubled, joined_to_base
from fem.slices.layer_matrix import LayerMatrix
from fem.virtual_experiments import rigid_motions
from meshes.layers import Layer, Sweep
from meshes.solid import Floats


@dataclass(frozen=True)
class ClassOfLayer:
    """What one symmetry class needs of a layer: bases of its planes and rigid motions (k, 6) of the planes."""

    layer: Layer
    signs: Signs

    @cached_property
    def bases(self) -> tuple[sp.csc_matrix, sp.csc_matrix, sp.csc_matrix]:
        x = self.layer
        places = (x.first_places, x.middle_places, x.last_places)
        first, middle, last = (class_basis(p, self.signs) for p in places)
        return first, middle, last

    @cached_property
    def rigid(self) -> tuple[Floats, Floats]:
        """Of the plane before and of the plane behind, about the origin of y and z."""
        x, (first, _, last) = self.layer, self.bases
        return rigid_in_class(x.first_places, first), rigid_in_class(x.last_places, last)

    def slice(self, stiffness: sp.csr_matrix, thickness: float) -> Slice:
        """The layer condensed."""
        along = along_x(self.bases[0])
        return condensed(self.layer, stiffness, self.bases, self.rigid[0], along, thickness)


def rigid_in_class(places: Floats, basis: sp.csc_matrix) -> Floats:
    """Rigid motions (k, 6) of nodes at (n, 2) places, mm, in a class; those that belong to other classes are zero."""
    motions = rigid_motions(section(places))
    kept = np.asarray(basis.T @ motions)
    shares = np.linalg.norm(kept, axis=0) / np.linalg.norm(motions, axis=0)
    return kept * (shares > 1e-6)


def chain_stiffness(sweep: Sweep, material: Isotropic, axes: Sequence[int] | None = None) -> Floats:
    """(6, 6) stiffness at the middle of the tip face, base face fixed, tip face rigid; bar frame, N, mm, rad.

    axes : mirrors of the section to use, by default all it has (`fem.slices.classes.mirrors`)
    Equals `fem.stiffness.bar_stiffness` on the same mesh. Raises SolveError if a slice is not held, ValueError if the
    section has no such mirror.
    """
    kinds = classes(mirrors(sweep) if axes is None else axes)
    views = [[ClassOfLayer(layer, signs) for signs in kinds] for layer in sweep.shapes]
    matrices = [LayerMatrix.of(layer, material) for layer in sweep.shapes]
    held: list[Floats | None] = [None] * len(kinds)
    for run in sweep.runs():
        stiffness = matrices[run.shape].stiffness(run.thickness)
        for number, view in enumerate(views[run.shape]):
            unit = view.slice(stiffness, run.thickness).ends
            held[number] = run_joined(held[number], unit, run.count, view.rigid[0])
    total = np.zeros((6, 6))
    for tip, view in zip(held, views[int(sweep.shape_of[-1])], strict=True):
        assert tip is not None
        total += view.rigid[1].T @ tip @ view.rigid[1]
    return 0.5 * (total + total.T)


def run_joined(held: Floats | None, unit: Stretch, count: int, rigid: Floats) -> Floats:
    """Stiffness (k, k) of the last plane of `count` equal stretches behind `held` (`joined_to_base`)."""
    for stretch in powers(unit, count, rigid):
        held = joined_to_base(held, stretch)[0]
    assert held is not None
    return held


def powers(unit: Stretch, count: int, rigid: Floats) -> Iterator[Stretch]:
    """The stretches of `count` layers' binary digits, shortest first; a stretch that is no prism once for each layer."""
    if not isinstance(unit, Prism):
        yield from [unit] * count
        return
    while count:
        if count & 1:
            yield unit
        count >>= 1
        if count:
            unit = doubled(unit, rigid)[0]
