"""Symmetry classes of a sweep whose section is its own mirror image in y, in z or in both.

A displacement field of such a body is the sum of fields that each keep or change their sign in each mirror; to a load
of one class the body answers in that class. Two mirrors part the unknowns in four classes, each about a quarter.
Source: A. Bossavit, Comput. Methods Appl. Mech. Engrg 56 (1986) 167-215 (symmetry and group characters).
"""

from collections.abc import Sequence
from itertools import product

import numpy as np
import scipy.sparse as sp

from meshes.layers import SAME_PLACE, Layer, Sweep, clusters
from meshes.solid import Floats, Ints

Y, Z = 1, 2
# For each mirror, by the axis it reverses: +1 where the field is its own mirror image, -1 where it is the reverse.
Signs = dict[int, int]


def mirrors(sweep: Sweep) -> tuple[int, ...]:
    """The axes, 1 for y and 2 for z, in whose direction every layer is its own mirror image about zero."""
    return tuple(axis for axis in (Y, Z) if all(is_mirrored(layer, axis) for layer in sweep.shapes))


def classes(axes: Sequence[int]) -> list[Signs]:
    """Every combination of signs: one class for no mirror, two for one, four for two."""
    return [dict(zip(axes, signs, strict=True)) for signs in product((1, -1), repeat=len(axes))]


def said(axes: Sequence[int]) -> str:
    """In words, how much of the section is solved at a time."""
    return {0: "whole section", 1: "half section", 2: "quarter section"}[len(axes)]


def is_mirrored(layer: Layer, axis: int) -> bool:
    """Whether a layer's nodes and cells are their own mirror images."""
    image = mirror_images(layer.mesh.points, (axis,))
    if image is None:
        return False
    for nodes in (layer.first, layer.last):
        own = np.sort(nodes[nodes >= 0])
        if not np.array_equal(np.sort(image[own]), own):
            return False
    if any(mirror_images(section(p), (axis,)) is None for p in (layer.first_places, layer.last_places)):
        return False
    return np.array_equal(sorted_rows(image[layer.mesh.cells]), sorted_rows(layer.mesh.cells))


def sorted_rows(cells: Ints) -> Ints:
    """Cells (m, k) as sets of nodes in one order."""
    inside = np.sort(cells, axis=1)
    return np.asarray(inside[np.lexsort(inside.T[::-1])])


def section(places: Floats) -> Floats:
    """Places (n, 2) of y and z as points (n, 3) at x = 0."""
    return np.insert(places, 0, 0.0, axis=1)


def mirror_images(points: Floats, axes: Sequence[int]) -> Ints | None:
    """(n,) number of the point that stands where each point (n, 3) is mirrored to; None if one stands alone."""
    flipped = points.copy()
    flipped[:, list(axes)] *= -1.0
    # Of the length of a bar ten times as long as its section is wide.
    near = 10.0 * SAME_PLACE * float(np.ptp(points[:, 1:], axis=0).max(initial=0.0))
    both = np.concatenate((points, flipped))
    places = np.stack([clusters(both[:, a], near)[0] for a in range(3)], axis=1)
    place = np.unique(places, axis=0, return_inverse=True)[1].ravel()
    own, image = np.split(place, 2)
    standing, number = np.unique(own, return_index=True)
    if len(standing) < len(points) or not np.array_equal(standing, np.unique(image)):
        return None
    return np.asarray(number[np.searchsorted(standing, image)])


def class_basis(places: Floats, signs: Signs) -> sp.csc_matrix:
    """Sparse (3 n, k) orthonormal fields of one class on nodes at (n, 2) y and z, mm; unknown 3 node + axis.

    Columns are sorted by axis, those along x first. Raises ValueError if the places are not their mirror images.
    """
    count = len(places)
    members, values = [], []
    for turned in product((False, True), repeat=len(signs)):
        axes = [axis for axis, yes in zip(signs, turned, strict=True) if yes]
        image = mirror_images(section(places), axes) if axes else np.arange(count)
        if image is None:
            raise ValueError("the places of a plane are not their own mirror images")
        members.append(image)
        sign = np.prod([signs[axis] for axis in axes])
        values.append([sign * (-1.0) ** (axis in axes) for axis in range(3)])
    images = np.stack(members)
    first = np.flatnonzero(images.min(axis=0) == np.arange(count))
    blocks = []
    for axis in range(3):
        rows = (3 * images[:, first] + axis).ravel()
        columns = np.tile(np.arange(len(first)), len(images))
        data = np.repeat([v[axis] for v in values], len(first))
        block = sp.csc_matrix((data, (rows, columns)), shape=(3 * count, len(first)))
        size = np.sqrt(np.asarray(block.multiply(block).sum(axis=0)).ravel())
        kept = np.flatnonzero(size > 0.5)
        blocks.append(block[:, kept] @ sp.diags(1.0 / size[kept]))
    return sp.csc_matrix(sp.hstack(blocks))


def along_x(basis: sp.csc_matrix) -> int:
    """Number of the basis's columns that are displacements along x; they are the first."""
    starts = basis.indices[basis.indptr[:-1]]
    return int(np.count_nonzero(starts % 3 == 0))
