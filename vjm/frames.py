"""Frames, rotations and the moving of 6x6 matrices. Every other module follows the conventions stated here.

Units: N, mm, rad (moments N·mm); nothing else inside the program.
Order of a pose, displacement or twist: x y z rx ry rz. Order of a wrench: Fx Fy Fz Mx My Mz.
A 6x6 stiffness maps the first to the second; a wrench is the one exerted *on* the platform at its point.
Base frame: x along the bars of the linkage at q = 0, y normal to its plane, z along its width.
Bar frame: the base frame turned by R_y(q).
Orientations are rotation vectors phi in the base frame, R = exp(phi), measured from the unloaded orientation.
The spatial angular velocity is omega = A(phi) phi_dot. A multiplier lambda = (f, mu) is conjugate to
(p, phi), so f·dp + mu·dphi is work; the moment itself is m = A(phi)^-T mu, equal to mu at phi = 0.

All functions broadcast over leading axes. Formulas: J. Solà, J. Deray, D. Atchuthan, "A micro Lie theory for
state estimation in robotics", 2018, eqs. 134, 145, 146 (left Jacobian of SO(3) and its inverse).
"""

from __future__ import annotations

from math import factorial, prod

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.special import bernoulli

Array = NDArray[np.float64]

POSE_NAMES = ("x", "y", "z", "rx", "ry", "rz")
WRENCH_NAMES = ("Fx", "Fy", "Fz", "Mx", "My", "Mz")

# Below this squared angle the coefficient functions are summed as series: the closed forms cancel there.
# `vjm.kernels` compiles the first and the last two in: what it keeps on disk does not see a change here.
SERIES_LIMIT = 1.0
_TERMS = 12
_A_CUBIC = np.array([(-1.0) ** k / factorial(2 * k + 3) for k in range(_TERMS)])
B_SQUARE: Array = np.array([abs(bernoulli(2 * k)[-1]) / factorial(2 * k) for k in range(1, _TERMS + 1)])
B_SQUARE_SLOPE: Array = B_SQUARE[1:] * np.arange(1.0, _TERMS)


def skew(v: ArrayLike) -> Array:
    """Matrix S with S w = v x w; v (..., 3) gives (..., 3, 3)."""
    v = np.asarray(v, dtype=float)
    s = np.zeros((*v.shape, 3))
    s[..., 2, 1], s[..., 1, 2] = v[..., 0], -v[..., 0]
    s[..., 0, 2], s[..., 2, 0] = v[..., 1], -v[..., 1]
    s[..., 1, 0], s[..., 0, 1] = v[..., 2], -v[..., 2]
    return s


def exp(phi: ArrayLike) -> Array:
    """Rotation matrix (..., 3, 3) of the rotation vector phi (..., 3), rad."""
    phi = np.asarray(phi, dtype=float)
    angle = np.linalg.norm(phi, axis=-1)[..., None, None]
    s = skew(phi)
    return np.eye(3) + np.sinc(angle / np.pi) * s + 0.5 * np.sinc(angle / (2 * np.pi)) ** 2 * (s @ s)


def log(rotation: ArrayLike) -> Array:
    """Rotation vector (..., 3), rad, of length at most pi, of the rotation matrix (..., 3, 3).

    Passes through the unit quaternion, largest component first, which is accurate at 0 and at pi alike.
    """
    r = np.asarray(rotation, dtype=float)
    quaternion = _quaternion(r)
    w, v = quaternion[..., 0], quaternion[..., 1:]
    sine = np.linalg.norm(v, axis=-1)
    half = np.arctan2(sine, w)
    return 2.0 * v / np.sinc(half / np.pi)[..., None]


def rotation_jacobian(phi: ArrayLike) -> Array:
    """A(phi) (..., 3, 3): spatial angular velocity = A(phi) phi_dot."""
    phi = np.asarray(phi, dtype=float)
    square = np.sum(phi * phi, axis=-1)
    s = skew(phi)
    quadratic = 0.5 * np.sinc(np.sqrt(square) / (2 * np.pi)) ** 2
    return np.eye(3) + quadratic[..., None, None] * s + _cubic(square)[..., None, None] * (s @ s)


def inverse_rotation_jacobian(phi: ArrayLike) -> Array:
    """B(phi) = A(phi)^-1 (..., 3, 3): phi_dot = B(phi) omega. Regular for abs(phi) < 2 pi."""
    phi = np.asarray(phi, dtype=float)
    square = np.sum(phi * phi, axis=-1)
    c = _inverse_coefficient(square)
    b = -0.5 * skew(phi) + c[..., None, None] * _outer(phi, phi)
    b[..., range(3), range(3)] += (1.0 - c * square)[..., None]
    return b


def moment(phi: ArrayLike, mu: ArrayLike) -> Array:
    """Moment m = B(phi)^T mu (..., 3), N·mm, of the multiplier mu conjugate to the rotation vector."""
    return np.einsum("...ji,...j->...i", inverse_rotation_jacobian(phi), np.asarray(mu, dtype=float))


def moment_gradient(phi: ArrayLike, mu: ArrayLike) -> Array:
    """Derivative of `moment` by phi at fixed mu: (..., 3, 3), last axis the component of phi.

    From B^T mu = mu + phi x mu / 2 + c(phi²) (phi (phi·mu) - mu phi²).
    """
    phi, mu = np.broadcast_arrays(np.asarray(phi, dtype=float), np.asarray(mu, dtype=float))
    square = np.sum(phi * phi, axis=-1)
    product = np.sum(phi * mu, axis=-1)
    c, slope = _inverse_coefficient(square), _inverse_coefficient_slope(square)
    double_cross = phi * product[..., None] - mu * square[..., None]
    inner = product[..., None, None] * np.eye(3) + _outer(phi, mu) - 2.0 * _outer(mu, phi)
    return (
        -0.5 * skew(mu)
        + c[..., None, None] * inner
        + 2.0 * slope[..., None, None] * _outer(double_cross, phi)
    )


def rotation_y(angle: ArrayLike) -> Array:
    """Elementary rotation R_y (..., 3, 3)."""
    angle = np.asarray(angle, dtype=float)
    return exp(angle[..., None] * np.array([0.0, 1.0, 0.0]))


def adjoint(r: ArrayLike) -> Array:
    """X (..., 6, 6) that gives the twist at P from the twist at P' = P + r: v_P = v_P' + r x omega."""
    r = np.asarray(r, dtype=float)
    x = np.broadcast_to(np.eye(6), (*r.shape[:-1], 6, 6)).copy()
    x[..., :3, 3:] = skew(r)
    return x


def move_stiffness(stiffness: ArrayLike, r: ArrayLike) -> Array:
    """The 6x6 at P moved to P' = P + r of the same rigid body: X^T K X with the full adjoint."""
    x = adjoint(r)
    return np.swapaxes(x, -1, -2) @ np.asarray(stiffness, dtype=float) @ x


def rotate_stiffness(stiffness: ArrayLike, rotation: ArrayLike) -> Array:
    """Components of a 6x6 in the frame A, given those in B; `rotation` (..., 3, 3) takes B to A."""
    rotation = np.asarray(rotation, dtype=float)
    q = np.zeros((*rotation.shape[:-2], 6, 6))
    q[..., :3, :3] = q[..., 3:, 3:] = rotation
    return q @ np.asarray(stiffness, dtype=float) @ np.swapaxes(q, -1, -2)


def _outer(a: Array, b: Array) -> Array:
    return a[..., :, None] * b[..., None, :]


def _quaternion(r: Array) -> Array:
    """Unit quaternion (..., 4), scalar first and not negative, from 4 q q^T written with the entries of R."""
    xx, yy, zz = r[..., 0, 0], r[..., 1, 1], r[..., 2, 2]
    trace = xx + yy + zz
    wx, wy, wz = r[..., 2, 1] - r[..., 1, 2], r[..., 0, 2] - r[..., 2, 0], r[..., 1, 0] - r[..., 0, 1]
    if np.all(trace > 0.0):
        # The scalar is more than a half: what is divided by it is accurate.
        scalar = 0.5 * np.sqrt(1.0 + trace)
        return _unit(np.stack([scalar, *(0.25 / scalar * part for part in (wx, wy, wz))], axis=-1))
    xy, xz, yz = r[..., 0, 1] + r[..., 1, 0], r[..., 0, 2] + r[..., 2, 0], r[..., 1, 2] + r[..., 2, 1]
    rows = (
        (1 + trace, wx, wy, wz),
        (wx, 1 + xx - yy - zz, xy, xz),
        (wy, xy, 1 - xx + yy - zz, yz),
        (wz, xz, yz, 1 - xx - yy + zz),
    )
    square = np.stack([np.stack(row, axis=-1) for row in rows], axis=-2)
    largest = np.argmax(np.diagonal(square, axis1=-2, axis2=-1), axis=-1)
    row = np.take_along_axis(square, largest[..., None, None], axis=-2)[..., 0, :]
    row = _unit(row)
    return np.where(row[..., :1] < 0, -row, row)


def _unit(vectors: Array) -> Array:
    return np.asarray(vectors / np.linalg.norm(vectors, axis=-1, keepdims=True))


def _cubic(square: Array) -> Array:
    """(t - sin t) / t³ as a function of t²."""
    t = np.sqrt(np.maximum(square, SERIES_LIMIT))
    return np.where(
        square < SERIES_LIMIT,
        _series(square, _A_CUBIC),
        (t - np.sin(t)) / t**3,
    )


def _series(square: Array, coefficients: Array) -> Array:
    """The power series in t², with its argument kept within its range."""
    small = np.minimum(square, SERIES_LIMIT)
    # In place: of numpy's polyval most is bookkeeping at the size of these arrays.
    total: Array = np.full_like(small, coefficients[-1])
    for coefficient in coefficients[-2::-1]:
        total *= small
        total += coefficient
    return total


def _inverse_coefficient(square: Array) -> Array:
    """c = (1 - (t/2) cot(t/2)) / t² as a function of t²."""
    series = _series(square, B_SQUARE)
    near = square < SERIES_LIMIT
    return series if np.all(near) else np.where(near, series, _inverse_closed(square)[0])


def _inverse_coefficient_slope(square: Array) -> Array:
    """dc/d(t²) of `_inverse_coefficient`."""
    series = _series(square, B_SQUARE_SLOPE)
    near = square < SERIES_LIMIT
    return series if np.all(near) else np.where(near, series, _inverse_closed(square)[1])


def _inverse_closed(square: Array) -> tuple[Array, Array]:
    """c and dc/d(t²) in closed form, t² kept off zero."""
    s = np.maximum(square, SERIES_LIMIT)
    t = np.sqrt(s)
    cot = 1.0 / np.tan(t / 2)
    c = (1.0 - 0.5 * t * cot) / s
    h_slope = (0.5 * cot - 0.25 * t * (1.0 + cot * cot)) / (2.0 * t)
    return c, -(h_slope + c) / s


def flat(rows: Array) -> Array:
    """(..., n) as a contiguous (B, n) of floats that can be written to, as compiled functions are made for."""
    whole = np.require(rows, dtype=float, requirements=("C", "W"))
    return whole.reshape(prod(rows.shape[:-1]), rows.shape[-1])
