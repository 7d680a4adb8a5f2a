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
from fem.rigid_motions import rigid_motions
from fem.slices.classes import Signs, along_x, class_basis, classes, mirrors, section
from fem.slices.condensed import (
    Prism,
    Slice,
    Stretch,
    cholesky,
    condensed,
    doubled,
    joined_to_base,
    rigid_at,
    solved,
)
from fem.slices.layer_matrix import LayerMatrix
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
    half = first_half(sweep)
    held = held_planes(half or sweep, material, views)
    last = views[int(sweep.shape_of[-1])]
    ends = [view.rigid[1] for view in last]
    if half is None:
        total = sum((r.T @ k @ r for k, r in zip(held, ends, strict=True)), np.zeros((6, 6)))
    else:
        # The rigid tip's motions as the middle plane would follow them.
        middle = [rigid_at(r, -0.5 * sweep.length) for r in ends]
        parts = zip(held, middle, last, strict=True)
        total = sum((in_series(k, r, along_x(v.bases[2])) for k, r, v in parts), np.zeros((6, 6)))
    return np.asarray(0.5 * (total + total.T))


def held_planes(sweep: Sweep, material: Isotropic, views: Sequence[Sequence[ClassOfLayer]]) -> list[Floats]:
    """Stiffness (k, k) of the last plane of a sweep fixed at its base, for each class; `views` by shape, then class."""
    matrices = [LayerMatrix.of(layer, material) for layer in sweep.shapes]
    held: list[Floats | None] = [None] * len(views[0])
    for run in sweep.runs():
        stiffness = matrices[run.shape].stiffness(run.thickness)
        for number, view in enumerate(views[run.shape]):
            unit = view.slice(stiffness, run.thickness).ends
            held[number] = run_joined(held[number], unit, run.count, view.rigid[0])
    return [k for k in held if k is not None]


def first_half(sweep: Sweep) -> Sweep | None:
    """The half at the base of a sweep that is its own mirror image along x; None where it is not."""
    count, odd = divmod(len(sweep.shape_of), 2)
    alike = (
        np.array_equal(sweep.shape_of, sweep.shape_of[::-1])
        and np.array_equal(sweep.thickness, sweep.thickness[::-1])
        and all(layer.even for layer in sweep.shapes)
    )
    return Sweep(sweep.shapes, sweep.shape_of[:count], sweep.thickness[:count]) if alike and not odd else None


def in_series(held: Floats, rigid: Floats, along: int) -> Floats:
    """(6, 6) of two mirrored halves in series: Rᵀ C (C + D C D)⁻¹ D C D R.

    held  : (k, k) C, of the middle plane with one half that is fixed at its far end; the first `along` unknowns along x
    rigid : (k, 6) R, the motions of the other half's far end, as a rigid body has them at the middle plane
    The sum has nothing between the unknowns along x and the others.
    """
    flip = np.where(np.arange(len(held)) < along, -1.0, 1.0)[:, None]
    here, there = held @ rigid, flip * (held @ (flip * rigid))
    total = np.zeros((6, 6))
    for own in (slice(None, along), slice(along, None)):
        total += here[own].T @ solved(cholesky(2.0 * held[own, own]), there[own])
    return total


def run_joined(held: Floats | None, unit: Stretch, count: int, rigid: Floats) -> Floats:
    """Stiffness (k, k) of the last plane of `count` equal stretches behind `held` (`joined_to_base`)."""
    for stretch in powers(unit, count, rigid):
        held = joined_to_base(held, stretch)[0]
    assert held is not None
    return held


def powers(unit: Stretch, count: int, rigid: Floats) -> Iterator[Stretch]:
    """The stretches of the binary digits of `count` layers, shortest first; what is no prism once for each layer.

    rigid: (k, 6) as for `condensed.without_rigid`.
    """
    if not isinstance(unit, Prism):
        yield from [unit] * count
        return
    while count:
        if count & 1:
            yield unit
        count >>= 1
        if count:
            unit = doubled(unit, rigid)[0]
