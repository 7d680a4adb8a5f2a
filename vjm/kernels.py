"""Compiled kinematics of a chain: what closures, dead loads and gauges need of it, state by state.

A chain has some tens of joints, each a few products of three numbers: with whole arrays most of the time would go into
calls. numba compiles these functions at their first use and keeps them on disk.

A joint nearer the base carries those after it: d²p/dx_i dx_j = w_i x v_j and dw_j/dx_i = w_i x w_j for i before j, v
and w being columns of the spatial velocity Jacobian. With the force f and m = B(phi)^T mu of a multiplier lambda and
phi_dot = B omega, the second derivative of pose^T lambda at fixed lambda sums to w_i·z_j for i up to j,
z = v x f + w x m + (dm/dphi B)^T w.

A frame is kept as rows (4, 3): its three axes and its origin, in the base frame, mm. Arrays are contiguous, of floats;
their sizes have to fit, nothing here looks after that.
"""

from __future__ import annotations

import numpy as np

from vjm.compiled import compiled
from vjm.frames import B_SQUARE, B_SQUARE_SLOPE, SERIES_LIMIT, Array
from vjm.program import Marks, Program

SHIFT, FIXED, SLIDE, TURN = 0, 1, 2, 3
"""Kinds of elements: a constant translation, any other constant transform, a joint that slides, one that turns."""
NO_COLUMN = -1
"""Of a coordinate that does not move."""


@compiled
def _in_base(vector: Array, frame: Array) -> tuple[float, float, float]:
    """A vector (3,) of a frame in the base frame."""
    return (
        vector[0] * frame[0, 0] + vector[1] * frame[1, 0] + vector[2] * frame[2, 0],
        vector[0] * frame[0, 1] + vector[1] * frame[1, 1] + vector[2] * frame[2, 1],
        vector[0] * frame[0, 2] + vector[1] * frame[1, 2] + vector[2] * frame[2, 2],
    )


@compiled
def _cross(a: Array, b: Array) -> tuple[float, float, float]:
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


@compiled
def _rotate(frame: Array, rotation: Array) -> None:
    """Turn a frame by a constant rotation, in its own axes."""
    for i in range(3):
        a, b, c = frame[0, i], frame[1, i], frame[2, i]
        for k in range(3):
            frame[k, i] = rotation[0, k] * a + rotation[1, k] * b + rotation[2, k] * c


@compiled
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


@compiled
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


@compiled
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


# The series of `vjm.frames` and the fields of `vjm.program` are compiled in: where they change this file has to change
# as well, or what is kept on disk stays (tests/vjm/test_kernels.py is red then).
@compiled
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


@compiled
def _rate(phi: Array, mu: Array, rate: Array, turned: Array) -> None:
    """B (3, 3) of the rotation vector, and what second derivatives need of the multiplier mu: as `turned` (3, 3) the
    transposed d(B^T mu)/dphi B less the cross product with the moment B^T mu; see above."""
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


@compiled
def _own_columns(p: Program, columns: np.ndarray) -> np.ndarray:
    """(J,) column of the coordinate that moves each joint."""
    own = np.empty(p.coordinate.size, dtype=np.int64)
    for k in range(own.size):
        own[k] = columns[p.coordinate[k]]
    return own


@compiled
def _ordered(p: Program, own: np.ndarray, w: Array, z: Array, sign: float, matrix: Array) -> None:
    """Add sign x what is w_i·z_j for joints i up to j, and symmetric, by the coordinates, to the matrix (., .).

    The joints' shares are taken into z.
    """
    for j in range(own.size):
        for k in range(3):
            z[j, k] *= sign * p.share[j]
    for i in range(own.size):
        row, share = own[i], p.share[i]
        if not p.turns[i] or row == NO_COLUMN:
            continue
        a, b, c, line = share * w[i, 0], share * w[i, 1], share * w[i, 2], matrix[row]
        for j in range(i, own.size):
            column = own[j]
            if column == NO_COLUMN:
                continue
            entry = a * z[j, 0] + b * z[j, 1] + c * z[j, 2]
            line[column] += entry
            if i != j:
                matrix[column, row] += entry


@compiled
def poses(p: Program, coordinates: Array, out: Array) -> None:
    """(B, 6) of the last frame at coordinates (B, n), into `out`."""
    joints, marks = p.coordinate.size, Marks(np.empty(0, dtype=np.int64), np.empty((0, 3)))
    frame, places, phi = np.empty((4, 3)), np.empty((0, 3)), np.empty(3)
    axes, origins = np.empty((joints, 3)), np.empty((joints, 3))
    for b in range(coordinates.shape[0]):
        _walk(p, marks, coordinates[b], frame, axes, origins, places)
        _rotation_vector(frame, p.reference, phi)
        out[b, :3], out[b, 3:] = frame[3], phi


@compiled
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
    joints, row, own = p.coordinate.size, moving + dual, _own_columns(p, columns)
    frame, phi, marks = np.empty((4, 3)), np.empty(3), Marks(np.empty(0, dtype=np.int64), np.empty((0, 3)))
    axes, origins, linear = np.empty((joints, 3)), np.empty((joints, 3)), np.empty((joints, 3))
    z, rate, turned = np.empty((joints, 3)), np.empty((3, 3)), np.empty((3, 3))
    for b in range(coordinates.shape[0]):
        _walk(p, marks, coordinates[b], frame, axes, origins, marks.offsets)
        _rotation_vector(frame, p.reference, phi)
        for i in range(3):
            gap[b, dual + i] += sign * frame[3, i]
            gap[b, dual + i + 3] += sign * phi[i]
        multiplier = multipliers[b, dual : dual + 6]
        _rate(phi, multiplier[3:], rate, turned)
        _velocities(p, axes, origins, frame[3], linear)
        _pull(p, own, axes, linear, multiplier, _in_base(multiplier[3:], rate), sign, balance[b])
        if matrix.size:
            _border(p, own, axes, linear, rate, sign, row, matrix[b])
            _pulled(p, axes, linear, turned, multiplier, z)
            _ordered(p, own, axes, z, sign, matrix[b])


@compiled
def _velocities(p: Program, axes: Array, origins: Array, end: Array, linear: Array) -> None:
    """(J, 3) of the end (3,) by the joints."""
    for k in range(p.turns.size):
        x, y, z = axes[k, 0], axes[k, 1], axes[k, 2]
        if p.turns[k]:
            a, b, c = end[0] - origins[k, 0], end[1] - origins[k, 1], end[2] - origins[k, 2]
            x, y, z = y * c - z * b, z * a - x * c, x * b - y * a
        linear[k, 0], linear[k, 1], linear[k, 2] = x, y, z


@compiled
def _pull(
    p: Program,
    own: np.ndarray,
    axes: Array,
    linear: Array,
    force: Array,
    moment: tuple[float, float, float],
    sign: float,
    balance: Array,
) -> None:
    """Add sign x what each joint feels of a force and a moment at the end to the balance (m,)."""
    for k in range(own.size):
        if own[k] != NO_COLUMN:
            felt = linear[k, 0] * force[0] + linear[k, 1] * force[1] + linear[k, 2] * force[2]
            if p.turns[k]:
                felt += axes[k, 0] * moment[0] + axes[k, 1] * moment[1] + axes[k, 2] * moment[2]
            balance[own[k]] += sign * p.share[k] * felt


@compiled
def _border(
    p: Program, own: np.ndarray, axes: Array, linear: Array, rate: Array, sign: float, row: int, matrix: Array
) -> None:
    """Add sign x Jacobian, from that row on, and its transpose to the matrix (., .)."""
    for i in range(3):
        moved, turned = matrix[row + i], matrix[row + i + 3]
        for k in range(own.size):
            column, share = own[k], sign * p.share[k]
            if column == NO_COLUMN:
                continue
            entry = share * linear[k, i]
            moved[column] += entry
            matrix[column, row + i] += entry
            if p.turns[k]:
                about = rate[i, 0] * axes[k, 0] + rate[i, 1] * axes[k, 1] + rate[i, 2] * axes[k, 2]
                turned[column] += share * about
                matrix[column, row + i + 3] += share * about


@compiled
def _pulled(p: Program, axes: Array, linear: Array, turned: Array, multiplier: Array, z: Array) -> None:
    """z (J, 3), see above."""
    for k in range(p.turns.size):
        x, y, w = _cross(multiplier[:3], linear[k])
        z[k, 0], z[k, 1], z[k, 2] = -x, -y, -w
        if p.turns[k]:
            for i in range(3):
                z[k, i] += turned[i, 0] * axes[k, 0] + turned[i, 1] * axes[k, 1] + turned[i, 2] * axes[k, 2]


@compiled
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
    joints, count, own = p.coordinate.size, marks.elements.size, _own_columns(p, columns)
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
            if own[k] != NO_COLUMN:
                balance[b, own[k]] += sign * p.share[k] * felt
        if matrix.size:
            _ordered(p, own, axes, z, sign, matrix[b])


@compiled
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
