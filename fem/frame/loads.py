"""A dead line load along a bar, consistent with the cubic between two nodes.

The potential of w (N/mm, base frame) on an element is -w·∫x ds = -w·[h (x1 + x2)/2 + h² (t1 - t2)/12], t the
tangents; forces and tangent follow along exp(w) R.
"""

import numpy as np

from fem.frame.so3 import IDENTITY, cross, dot, outer
from meshes.solid import Floats


def line_load(h: Floats, R: Floats, load: Floats) -> tuple[Floats, Floats]:
    """Gradient (..., n, 12) and Hessian (..., n, 12, 12) of the potential of `load` (..., 1, 3) on n elements.

    h: (..., n) lengths mm; R: (..., n + 1, 3, 3) node triads.
    """
    force = np.broadcast_to(load, (*h.shape, 3))
    gradient, hessian = np.zeros((*h.shape, 12)), np.zeros((*h.shape, 12, 12))
    half, arm = h[..., None] / 2.0, h[..., None] ** 2 / 12.0
    for start, sign, tangent in ((0, 1.0, R[..., :-1, :, 0]), (6, -1.0, R[..., 1:, :, 0])):
        gradient[..., start : start + 3] = -half * force
        gradient[..., start + 3 : start + 6] = -sign * arm * cross(tangent, force)
        mixed = outer(force, tangent)
        turn = 0.5 * (mixed + np.swapaxes(mixed, -1, -2)) - dot(force, tangent)[..., None, None] * IDENTITY
        rows = slice(start + 3, start + 6)
        hessian[..., rows, rows] = -sign * arm[..., None] * turn
    return gradient, hessian


def point_on_axis(h: Floats, share: Floats, x: Floats, R: Floats, direction: Floats) -> tuple[Floats, Floats]:
    """Coordinate (...,) of a point of an element along `direction` (..., 3), and its (..., 12) rate.

    share (...,): from 0 to 1 along the element; x (..., 2, 3), R (..., 2, 3, 3): its ends. A cubic through both ends.
    """
    s = share
    ends = (1 - 3 * s**2 + 2 * s**3, 3 * s**2 - 2 * s**3)
    tangents = (h * (s - 2 * s**2 + s**3), h * (s**3 - s**2))
    value, rate = np.zeros_like(h), np.zeros((*h.shape, 12))
    for i in (0, 1):
        t = R[..., i, :, 0]
        value += ends[i] * dot(direction, x[..., i, :]) + tangents[i] * dot(direction, t)
        rate[..., 6 * i : 6 * i + 3] = ends[i][..., None] * direction
        rate[..., 6 * i + 3 : 6 * i + 6] = tangents[i][..., None] * cross(t, direction)
    return value, rate
