"""One beam element: forces and consistent symmetric tangent at its two ends."""

from collections.abc import Callable

import numpy as np

from fem.frame.batch import Bools
from fem.frame.local import Reference, curvature_of_strains, elastic, membrane, planes, strains
from fem.frame.motion import geometric, rates, relative, to_ends
from fem.frame.so3 import dot, transpose
from meshes.solid import Floats

LEAST_COSINE = 0.5
"""Of the angle between an element and the axis of either end; its chord slopes are sines, small by assumption."""

Correction = Callable[[Floats, Floats, Floats], tuple[Floats, Floats]]
"""What yielding takes from the elastic gradient and Hessian, for strain, membrane strain and its rate."""


def force_and_tangent(
    x: Floats, R: Floats, ref: Reference, yielding: Correction | None = None
) -> tuple[Floats, Floats]:
    """Forces (..., n, 12) at the ends of n elements in a row and their tangents (..., n, 12, 12), base frame.

    x: (..., n + 1, 3) nodes, mm; R: (..., n + 1, 3, 3) triads. Order x1, w1, x2, w2; the forces are those that hold
    the element, conjugate to displacements and spatial spins; the tangent is the Hessian along exp(w) R.
    """
    motion = relative(x[..., :-1, :], R[..., :-1, :, :], x[..., 1:, :], R[..., 1:, :, :])
    strain, slopes, length = strains(motion.d, motion.phi)
    eps, rate = membrane(strain, ref)
    g, k = elastic(strain, ref, eps, rate)
    if yielding is not None:
        less, softer = yielding(strain, eps, rate)
        g, k = g - less, k - softer
    b, spin, turn = rates(motion)
    curvature = curvature_of_strains(motion.d, length, strain, g)
    bent = b.copy()
    bent[..., :3, :] = slopes @ b[..., :3, :]
    force = (transpose(slopes) @ g[..., :3, None])[..., 0]
    hessian = transpose(bent) @ k @ bent
    hessian += transpose(b[..., :3, :]) @ curvature @ b[..., :3, :]
    hessian += geometric(motion, force, g[..., 3:], spin, turn)
    gradient = (g[..., None, :] @ bent)[..., 0, :]
    return to_ends(motion, np.asarray(gradient), hessian)


def turned_over(x: Floats, R: Floats) -> Bools:
    """(..., n) whether an element lies across the axis of one of its ends or points backwards.

    The strains are the same for an element that points backwards: it is without energy there, and no such bar.
    """
    along = x[..., 1:, :] - x[..., :-1, :]
    least = LEAST_COSINE * np.sqrt(dot(along, along))
    first, second = dot(along, R[..., :-1, :, 0]), dot(along, R[..., 1:, :, 0])
    return np.asarray(np.minimum(first, second) < least)


def energy(x: Floats, R: Floats, ref: Reference) -> Floats:
    """Elastic energy (...,) of a row of elements, N mm."""
    motion = relative(x[..., :-1, :], R[..., :-1, :, :], x[..., 1:, :], R[..., 1:, :, :])
    strain, _, _ = strains(motion.d, motion.phi)
    eps, _ = membrane(strain, ref)
    pair = planes(strain[..., 1:3] - ref.slope, strain[..., 3:] - ref.turn, ref.h)
    bending = np.einsum("...i,...ij,...j->...", pair, ref.bend, pair).sum(-1)
    twist = ref.GJ / ref.h * (strain[..., 3] - ref.turn[..., 0]) ** 2
    return np.asarray(0.5 * (ref.EA * ref.h * eps**2 + bending + twist).sum(-1))
