"""Inner nodes of bars eliminated pair by pair: two neighbouring elements become one, until a bar is one element.

The tangent of 2^m elements in a row shrinks to its two ends in m vectorised steps, with any number of right-hand
sides. The inertia of the whole is the sum of those of the eliminated blocks and of what is left (E. V. Haynsworth,
Linear Algebra Appl. 1 (1968) 73-81).
"""

from dataclasses import dataclass

import numpy as np

from fem.frame.so3 import transpose
from meshes.solid import Floats


def solve(matrix: Floats, sides: Floats) -> Floats:
    """Solutions of square systems (..., n, n); NaN for those that are singular."""
    try:
        return np.asarray(np.linalg.solve(matrix, sides))
    except np.linalg.LinAlgError:
        regular = np.linalg.cond(matrix) < 1.0 / np.finfo(float).eps
        out = np.full(sides.shape, np.nan)
        out[regular] = np.linalg.solve(matrix[regular], sides[regular])
        return out


@dataclass(frozen=True, eq=False)
class Level:
    """One halving: pivots (..., m, 6, 6) and their solutions (..., m, 6, 12 + C) for the outer ends and right sides."""

    pivot: Floats
    solved: Floats


@dataclass(frozen=True, eq=False)
class Condensed:
    """A row of elements as one: stiffness (..., 12, 12), right sides (..., 12, C), and the levels, finest first.

    products (..., C): gᵀ K⁻¹ r over the eliminated nodes, of each right side g with the first, r.
    """

    stiffness: Floats
    sides: Floats
    products: Floats
    levels: tuple[Level, ...]


def condense(stiffness: Floats, sides: Floats) -> Condensed:
    """Condense elements (..., n, 12, 12) with right sides (..., n, 12, C); n is a power of two."""
    levels = []
    products = np.zeros((*sides.shape[:-3], sides.shape[-1]))
    while stiffness.shape[-3] > 1:
        left, right = stiffness[..., 0::2, :, :], stiffness[..., 1::2, :, :]
        s_left, s_right = sides[..., 0::2, :, :], sides[..., 1::2, :, :]
        pivot = left[..., 6:, 6:] + right[..., :6, :6]
        outer = np.concatenate((left[..., 6:, :6], right[..., :6, 6:]), axis=-1)
        middle = s_left[..., 6:, :] + s_right[..., :6, :]
        solved = solve(pivot, np.concatenate((outer, middle), axis=-1))
        levels.append(Level(pivot, solved))
        products = products + np.einsum("...mic,...mi->...c", middle, solved[..., 12])
        stiffness = -transpose(outer) @ solved[..., :12]
        stiffness[..., :6, :6] += left[..., :6, :6]
        stiffness[..., 6:, 6:] += right[..., 6:, 6:]
        sides = np.concatenate((s_left[..., :6, :], s_right[..., 6:, :]), axis=-2)
        sides = sides - transpose(outer) @ solved[..., 12:]
    return Condensed(stiffness[..., 0, :, :], sides[..., 0, :, :], products, tuple(levels))


def inner_motion(condensed: Condensed, ends: Floats) -> Floats:
    """(..., n - 1, 6) motion of the inner nodes with K u = -r, for the motion (..., 12) of the two ends."""
    nodes = np.stack((ends[..., :6], ends[..., 6:]), axis=-2)
    for level in reversed(condensed.levels):
        pair = np.concatenate((nodes[..., :-1, :], nodes[..., 1:, :]), axis=-1)
        middle = -(level.solved[..., :12] @ pair[..., None])[..., 0] - level.solved[..., 12]
        merged = np.empty((*nodes.shape[:-2], 2 * nodes.shape[-2] - 1, 6))
        merged[..., 0::2, :], merged[..., 1::2, :] = nodes, middle
        nodes = merged
    return np.asarray(nodes[..., 1:-1, :])


def negative_pivots(condensed: Condensed) -> Floats:
    """Number of negative eigenvalues (...) among all eliminated blocks."""
    counts = [(np.linalg.eigvalsh(level.pivot) < 0.0).sum((-1, -2)) for level in condensed.levels]
    return np.asarray(sum(counts), float)
