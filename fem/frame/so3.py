"""Finite rotations, vectorised over leading axes.

Rotation matrices act on column vectors; rotation vectors are in rad. Source of the formulas: A. Ibrahimbegovic,
"On the choice of finite rotation parameters", Comput. Methods Appl. Mech. Engrg. 149 (1997) 49-71.
"""

import numpy as np

from meshes.solid import Floats

IDENTITY = np.eye(3)


def hat(v: Floats) -> Floats:
    """(..., 3, 3) with hat(v) w = v x w."""
    out = np.zeros((*v.shape, 3))
    out[..., 0, 1], out[..., 0, 2], out[..., 1, 2] = -v[..., 2], v[..., 1], -v[..., 0]
    out[..., 1, 0], out[..., 2, 0], out[..., 2, 1] = v[..., 2], -v[..., 1], v[..., 0]
    return out


def cross(a: Floats, b: Floats) -> Floats:
    """a x b (..., 3) of vectors (..., 3)."""
    a0, a1, a2 = a[..., 0], a[..., 1], a[..., 2]
    b0, b1, b2 = b[..., 0], b[..., 1], b[..., 2]
    return np.stack((a1 * b2 - a2 * b1, a2 * b0 - a0 * b2, a0 * b1 - a1 * b0), axis=-1)


def outer(a: Floats, b: Floats) -> Floats:
    """(..., 3, 3) a bᵀ."""
    return a[..., :, None] * b[..., None, :]


def dot(a: Floats, b: Floats) -> Floats:
    """Scalar product (...) of vectors (..., n)."""
    return np.asarray(np.einsum("...i,...i->...", a, b))


def apply(matrix: Floats, vector: Floats) -> Floats:
    """Matrix (..., m, n) times vector (..., n)."""
    return np.asarray((matrix @ vector[..., None])[..., 0])


def transpose(matrix: Floats) -> Floats:
    """Transpose (..., n, m) of matrices (..., m, n)."""
    return np.swapaxes(matrix, -1, -2)


def exp(v: Floats) -> Floats:
    """Rotation matrices of rotation vectors (..., 3)."""
    angle = np.sqrt(dot(v, v))[..., None, None]
    w = hat(v)
    return IDENTITY + np.sinc(angle / np.pi) * w + 0.5 * np.sinc(angle / (2 * np.pi)) ** 2 * (w @ w)


def log(matrix: Floats) -> Floats:
    """Rotation vectors (..., 3) of rotations by less than π."""
    m = matrix
    axis = 0.5 * np.stack(
        (m[..., 2, 1] - m[..., 1, 2], m[..., 0, 2] - m[..., 2, 0], m[..., 1, 0] - m[..., 0, 1]), axis=-1
    )
    sine = np.sqrt(dot(axis, axis))
    angle = np.arctan2(sine, 0.5 * (m[..., 0, 0] + m[..., 1, 1] + m[..., 2, 2] - 1.0))
    small = sine < 1e-9
    return axis * np.where(small, 1.0, angle / np.where(small, 1.0, sine))[..., None]


def log_rate(v: Floats) -> Floats:
    """(..., 3, 3) M with δv = M w when a rotation exp(v) is followed by the small spatial rotation w."""
    square = dot(v, v)[..., None, None]
    angle = np.sqrt(square)
    small = angle < 0.05
    safe = np.where(small, 1.0, angle)
    exact = (1.0 - 0.5 * safe / np.tan(0.5 * safe)) / safe**2
    series = 1.0 / 12.0 + square / 720.0 + square**2 / 30240.0
    w = hat(v)
    return IDENTITY - 0.5 * w + np.where(small, series, exact) * (w @ w)


def orthonormal(matrix: Floats) -> Floats:
    """The nearest rotation (..., 3, 3) of an almost orthonormal matrix, to second order in its defect."""
    return matrix @ (1.5 * IDENTITY - 0.5 * transpose(matrix) @ matrix)
