"""Compiled kinematics of a chain: what closures, dead loads and gauges need of it, state by state.

The same as `vjm.chain.Kinematics`, which is written with whole arrays and is what this is tested against. A chain has
some tens of joints, each a few products of three numbers: with whole arrays most of the time goes into calls. numba
compiles these functions at their first use and keeps them on disk.

A frame is kept as rows (4, 3): its three axes and its origin, in the base frame, mm. Arrays are contiguous, of floats;
their sizes have to fit, nothing here looks after that.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple, TypeVar, cast

import numpy as np
from numba import njit

from vjm.frames import B_SQUARE, B_SQUARE_SLOPE, SERIES_LIMIT, Array

Function = TypeVar("Function", bound=Callable[..., Any])
SHIFT, FIXED, SLIDE, TURN = 0, 1, 2, 3
"""Kinds of elements: a constant translation, any other constant transform, a joint that slides, one that turns."""
NO_COLUMN = -1
"""Of a coordinate that does not move."""


class Program(NamedTuple):
    """A chain as arrays, E elements with J joints.

    kinds: (E,). along: (E,) number of the own axis that a joint has, -1 for any other direction. vectors: (E, 3)
    translation, or axis of the joint. rotations: (E, 3, 3) of constant transforms. coordinate: (J,) that moves a joint,
    share: (J,) by which. turns: (J,) of bool. reference: (3, 3) from which the rotation vector counts.
    """

    kinds: np.ndarray
    along: np.ndarray
    vectors: Array
    rotations: Array
    coordinate: np.ndarray
    share: Array
    turns: np.ndarray
    reference: Array


class Marks(NamedTuple):
    """Points of a chain, those nearer the base first.

    elements: (s,) before each. offsets: (s, 3) in the frame there, mm.
    """

    elements: np.ndarray
    offsets: Array


def _compiled(function: Function) -> Function:
    """The function compiled at its first use; kept on disk where there is a place for it."""
    try:
        return cast(Function, njit(cache=True)(function))
    except RuntimeError:
        # Neither the folder of the program nor that of the user can be written to.
        return cast(Function, njit(function))


@_compiled
def _in_base(vector: Array, frame: Array) -> tuple[float, float, float]:
    """A vector (3,) of a frame in the base frame."""
    return (
        vector[0] * frame[0, 0] + vector[1] * frame[1, 0] + vector[2] * frame[2, 0],
        vector[0] * frame[0, 1] + vector[1] * frame[1, 1] + vector[2] * frame[2, 1],
        vector[0] * frame[0, 2] + vector[1] * frame[1, 2] + vector[2] * frame[2, 2],
    )


@_compiled
def _cross(a: Array, b: Array) -> tuple[float, float, float]:
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


@_compiled
def _rotate(frame: Array, rotation: Array) -> None:
    """Turn a frame by a constant rotation, in its own axes."""
    for i in range(3):
        a, b, c = frame[0, i], frame[1, i], frame[2, i]
        for k in range(3):
            frame[k, i] = rotation[0, k] * a + rotation[1, k] * b + rotation[2, k] * c


@_compiled
def _turn(frame: Array, along: int, own: Array, axis: Array, angle: float) -> None:
    """Turn a frame about an axis (3,) of the base frame, which has the number `along` or the components `own` in it."""
    sine, cosine = np.sin(angle), np.cos(angle)
    if along >= 0:
        i, j = (along + 1) % 3, (along + 2) % 3
        for k in range(3):
            a, b = frame[i, k], frame[j, k]
            frame[i, k] = cosine * a + sine * b
            frame[j, k] = cosine * b - sine * a
        return
    # Rodrigues' formula, on each of the frame's own axes.
    for i in range(3):
        x, y, z = _cross(axis, frame[i])
        part = (1.0 - cosine) * own[i]
        frame[i, 0] = cosine * frame[i, 0] + sine * x + part * axis[0]
        frame[i, 1] = cosine * frame[i, 1] + sine * y + part * axis[1]
        frame[i, 2] = cosine * frame[i, 2] + sine * z + part * axis[2]


@_compiled
def _walk(
    p: Program, marks: Marks, x: Array, frame: Array, axes: Array, origins: Array, places: Array
) -> None:
    """Last frame, axes (J, 3) and origins (J, 3) of the joints and places (s, 3) of the marks, at coordinates (n,)."""
    frame[:] = 0.0
    frame[0, 0] = frame[1, 1] = frame[2, 2] = 1.0
    joint = mark = 0
    for e in range(p.kinds.size + 1):
        while mark < marks.elements.size and marks.elements[mark] == e:
            there = _in_base(marks.offsets[mark], frame)
            for i in range(3):
                places[mark, i] = frame[3, i] + there[i]
            mark += 1
        if e == p.kinds.size:
            break
        along = _in_base(p.vectors[e], frame)
        if p.kinds[e] <= FIXED:
            for i in range(3):
                frame[3, i] += along[i]
            if p.kinds[e] == FIXED:
                _rotate(frame, p.rotations[e])
            continue
        axis, value = axes[joint], x[p.coordinate[joint]] * p.share[joint]
        axis[0], axis[1], axis[2] = along
        origins[joint] = frame[3]
        if p.kinds[e] == TURN:
            _turn(frame, p.along[e], p.vectors[e], axis, value)
        else:
            for i in range(3):
                frame[3, i] += axis[i] * value
        joint += 1


@_compiled
def _rotation_vector(frame: Array, reference: Array, phi: Array) -> None:
    """`vjm.frames.log` of the frame's rotation from the reference."""
    r, q, s = np.empty((3, 3)), np.empty(4), np.empty((4, 4))
    for i in range(3):
        for j in range(3):
            r[i, j] = (
                frame[0, i] * reference[j, 0] + frame[1, i] * reference[j, 1] + frame[2, i] * reference[j, 2]
            )
    # 4 q q^T, scalar first; its row with the largest square is accurate.
    s[0, 0] = 1.0 + r[0, 0] + r[1, 1] + r[2, 2]
    for i in range(3):
        j, k = (i + 1) % 3, (i + 2) % 3
        s[i + 1, i + 1] = 1.0 + r[i, i] - r[j, j] - r[k, k]
        s[0, i + 1] = s[i + 1, 0] = r[k, j] - r[j, k]
        s[j + 1, k + 1] = s[k + 1, j + 1] = r[j, k] + r[k, j]
    row = 0
    if s[0, 0] <= 1.0:
        for i in range(1, 4):
            if s[i, i] > s[row, row]:
                row = i
    size = np.sqrt(s[row, 0] ** 2 + s[row, 1] ** 2 + s[row, 2] ** 2 + s[row, 3] ** 2)
    if s[row, 0] < 0.0:
        size = -size
    for i in range(4):
        q[i] = s[row, i] / size
    sine = np.sqrt(q[1] ** 2 + q[2] ** 2 + q[3] ** 2)
    half = np.arctan2(sine, q[0])
    factor = 2.0 if half == 0.0 else 2.0 * half / np.sin(half)
    for i in range(3):
        phi[i] = factor * q[i + 1]


# The series of `vjm.frames` are compiled in: where they change this file has to change as well, or what is kept on disk
# stays (tests/vjm/test_kernels.py is red then).
@_compiled
def _coefficients(square: float) -> tuple[float, float]:
    """c = (1 - (t/2) cot(t/2)) / t² of t², and dc/d(t²), as in `vjm.frames`."""
    if square < SERIES_LIMIT:
        c, slope = B_SQUARE[-1], B_SQUARE_SLOPE[-1]
        for k in range(B_SQUARE.size - 2, -1, -1):
            c = c * square + B_SQUARE[k]
        for k in range(B_SQUARE_SLOPE.size - 2, -1, -1):
            slope = slope * square + B_SQUARE_SLOPE[k]
        return c, slope
    t = np.sqrt(square)
    cot = 1.0 / np.tan(t / 2.0)
    c = (1.0 - 0.5 * t * cot) / square
    return c, -((0.5 * cot - 0.25 * t * (1.0 + cot * cot)) / (2.0 * t) + c) / square


@_compiled
def _rate(phi: Array, mu: Array, rate: Array, turned: Array) -> None:
    """B (3, 3) of the rotation vector, and what second derivatives need of the multiplier mu: as `turned` (3, 3) the
    transposed d(B^T mu)/dphi B less the cross product with the moment B^T mu; see `Kinematics.hessian`."""
    square = phi[0] ** 2 + phi[1] ** 2 + phi[2] ** 2
    along = phi[0] * mu[0] + phi[1] * mu[1] + phi[2] * mu[2]
    c, slope = _coefficients(square)
    gradient, moment = np.empty((3, 3)), np.empty(3)
    for i in range(3):
        for j in range(3):
            unit = 1.0 if i == j else 0.0
            rate[i, j] = c * phi[i] * phi[j] + (1.0 - c * square) * unit
            inner = along * unit + phi[i] * mu[j] - 2.0 * mu[i] * phi[j]
            bent = phi[i] * along - mu[i] * square
            gradient[i, j] = c * inner + 2.0 * slope * bent * phi[j]
    for i in range(3):
        j, k = (i + 1) % 3, (i + 2) % 3
        rate[j, k] += 0.5 * phi[i]
        rate[k, j] -= 0.5 * phi[i]
        gradient[j, k] += 0.5 * mu[i]
        gradient[k, j] -= 0.5 * mu[i]
    for i in range(3):
        moment[i] = rate[0, i] * mu[0] + rate[1, i] * mu[1] + rate[2, i] * mu[2]
        for j in range(3):
            turned[j, i] = (
                gradient[i, 0] * rate[0, j] + gradient[i, 1] * rate[1, j] + gradient[i, 2] * rate[2, j]
            )
    for i in range(3):
        j, k = (i + 1) % 3, (i + 2) % 3
        turned[j, k] += moment[i]
        turned[k, j] -= moment[i]


@_compiled
def _ordered(p: Program, columns: np.ndarray, w: Array, z: Array, sign: float, matrix: Array) -> None:
    """Add sign x what is w_i·z_j for joints i up to j, and symmetric, by the coordinates, to the matrix (., .)."""
    for i in range(p.turns.size):
        row = columns[p.coordinate[i]]
        if not p.turns[i] or row == NO_COLUMN:
            continue
        for j in range(i, p.turns.size):
            column = columns[p.coordinate[j]]
            if column == NO_COLUMN:
                continue
            entry = w[i, 0] * z[j, 0] + w[i, 1] * z[j, 1] + w[i, 2] * z[j, 2]
            entry *= sign * p.share[i] * p.share[j]
            matrix[row, column] += entry
            if i != j:
                matrix[column, row] += entry


@_compiled
def poses(p: Program, coordinates: Array, out: Array) -> None:
    """(B, 6) of the last frame at coordinates (B, n), into `out`."""
    joints, marks = p.coordinate.size, Marks(np.empty(0, dtype=np.int64), np.empty((0, 3)))
    frame, places, phi = np.empty((4, 3)), np.empty((0, 3)), np.empty(3)
    axes, origins = np.empty((joints, 3)), np.empty((joints, 3))
    for b in range(coordinates.shape[0]):
        _walk(p, marks, coordinates[b], frame, axes, origins, places)
        _rotation_vector(frame, p.reference, phi)
        out[b, :3], out[b, 3:] = frame[3], phi


@_compiled
def close(
    p: Program,
    columns: np.ndarray,
    coordinates: Array,
    multipliers: Array,
    dual: int,
    sign: float,
    moving: int,
    gap: Array,
    balance: Array,
    matrix: Array,
) -> None:
    """A path's share of a closure of a leg with m = `moving` coordinates, at the path's own (B, n).

    dual: where the six multipliers of the closure begin among all (B, c). Adds sign x pose to the gap (B, c), sign x
    Jacobian^T multipliers to the balance (B, m) and, unless it is empty, sign x Jacobian, its transpose and the
    curvature to the matrix (B, m + c, m + c). columns: (n,) of the path's coordinates among the moving ones,
    `NO_COLUMN` where one does not move.
    """
    joints, row, marks = (
        p.coordinate.size,
        moving + dual,
        Marks(np.empty(0, dtype=np.int64), np.empty((0, 3))),
    )
    frame, places, phi = np.empty((4, 3)), np.empty((0, 3)), np.empty(3)
    axes, origins, linear = np.empty((joints, 3)), np.empty((joints, 3)), np.empty((joints, 3))
    z, rate, turned = np.empty((joints, 3)), np.empty((3, 3)), np.empty((3, 3))
    for b in range(coordinates.shape[0]):
        _walk(p, marks, coordinates[b], frame, axes, origins, places)
        _rotation_vector(frame, p.reference, phi)
        for i in range(3):
            gap[b, dual + i] += sign * frame[3, i]
            gap[b, dual + i + 3] += sign * phi[i]
        multiplier = multipliers[b, dual : dual + 6]
        _rate(phi, multiplier[3:], rate, turned)
        for k in range(joints):
            linear[k] = axes[k]
            if p.turns[k]:
                linear[k, 0], linear[k, 1], linear[k, 2] = _cross(axes[k], frame[3] - origins[k])
            column = columns[p.coordinate[k]]
            if column != NO_COLUMN:
                _column(p, k, column, axes[k], linear[k], rate, multiplier, sign, row, balance[b], matrix, b)
        if matrix.size:
            _pulled(p, axes, linear, turned, multiplier, z)
            _ordered(p, columns, axes, z, sign, matrix[b])


@_compiled
def _column(
    p: Program,
    k: int,
    column: int,
    axis: Array,
    linear: Array,
    rate: Array,
    multiplier: Array,
    sign: float,
    row: int,
    balance: Array,
    matrix: Array,
    b: int,
) -> None:
    """Add what joint k has of sign x Jacobian: its product with the multiplier (6,), and, in the matrix of state b, the
    column and the row."""
    share, pull = sign * p.share[k], 0.0
    for i in range(6):
        entry = linear[i] if i < 3 else 0.0
        if i >= 3 and p.turns[k]:
            entry = rate[i - 3, 0] * axis[0] + rate[i - 3, 1] * axis[1] + rate[i - 3, 2] * axis[2]
        pull += entry * multiplier[i]
        if matrix.size:
            matrix[b, row + i, column] += share * entry
            matrix[b, column, row + i] += share * entry
    balance[column] += share * pull


@_compiled
def _pulled(p: Program, axes: Array, linear: Array, turned: Array, multiplier: Array, z: Array) -> None:
    """z (J, 3) of `Kinematics.hessian`."""
    for k in range(p.turns.size):
        x, y, w = _cross(multiplier[:3], linear[k])
        z[k, 0], z[k, 1], z[k, 2] = -x, -y, -w
        if p.turns[k]:
            for i in range(3):
                z[k, i] += turned[i, 0] * axes[k, 0] + turned[i, 1] * axes[k, 1] + turned[i, 2] * axes[k, 2]


@_compiled
def load(
    p: Program,
    marks: Marks,
    joints_before: np.ndarray,
    forces: Array,
    columns: np.ndarray,
    coordinates: Array,
    sign: float,
    balance: Array,
    matrix: Array,
) -> None:
    """Dead loads (s, 3) at the marks, which so many joints (s,) move, at coordinates (B, n) of the path.

    Adds sign x the generalised force to the balance (B, m) and, unless it is empty, sign x its derivative to the matrix
    (B, ., .); columns: as in `close`. The formulas are those of `vjm.loads.DeadLoads.pull`.
    """
    joints, count = p.coordinate.size, marks.elements.size
    frame, places = np.empty((4, 3)), np.empty((count, 3))
    axes, origins, z = np.empty((joints, 3)), np.empty((joints, 3)), np.empty((joints, 3))
    beyond, whole, spread = np.empty(3), np.empty((3, 3)), np.empty((3, 3))
    for b in range(coordinates.shape[0]):
        _walk(p, marks, coordinates[b], frame, axes, origins, places)
        beyond[:], whole[:], mark = 0.0, 0.0, count - 1
        for k in range(joints - 1, -1, -1):
            while mark >= 0 and joints_before[mark] > k:
                beyond += forces[mark]
                for i in range(3):
                    for j in range(3):
                        whole[i, j] += places[mark, i] * forces[mark, j]
                mark -= 1
            for i in range(3):
                for j in range(3):
                    spread[i, j] = whole[i, j] - origins[k, i] * beyond[j]
            felt = _felt(p.turns[k], axes[k], beyond, spread, z[k])
            column = columns[p.coordinate[k]]
            if column != NO_COLUMN:
                balance[b, column] += sign * p.share[k] * felt
        if matrix.size:
            _ordered(p, columns, axes, z, sign, matrix[b])


@_compiled
def _felt(turns: bool, axis: Array, beyond: Array, spread: Array, z: Array) -> float:
    """What a joint feels of the forces beyond it, and its z (3,)."""
    if not turns:
        z[0], z[1], z[2] = _cross(axis, beyond)
        return float(axis[0] * beyond[0] + axis[1] * beyond[1] + axis[2] * beyond[2])
    trace, felt = spread[0, 0] + spread[1, 1] + spread[2, 2], 0.0
    for i in range(3):
        j, k = (i + 1) % 3, (i + 2) % 3
        felt += axis[i] * (spread[j, k] - spread[k, j])
        z[i] = spread[i, 0] * axis[0] + spread[i, 1] * axis[1] + spread[i, 2] * axis[2] - axis[i] * trace
    return felt
