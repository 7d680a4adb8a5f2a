"""Finite rotations of rigid faces and platforms, in the finite elements' own formulation."""

import numpy as np

from meshes.solid import Floats


def cross_matrix(v: Floats) -> Floats:
    """[v] with [v] w = v x w, (3, 3)."""
    x, y, z = v
    return np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])


def rotation(vector: Floats) -> Floats:
    """Rotation matrix (3, 3) of a rotation vector (3,) in rad (Rodrigues' formula)."""
    w = cross_matrix(np.asarray(vector, float))
    angle = float(np.linalg.norm(vector))
    # sinc keeps both factors exact at angle zero.
    return np.eye(3) + np.sinc(angle / np.pi) * w + 0.5 * np.sinc(angle / (2 * np.pi)) ** 2 * (w @ w)


def rotation_vector(matrix: Floats) -> Floats:
    """Rotation vector (3,), rad, of a rotation matrix (3, 3) by less than π."""
    axis = 0.5 * np.array(
        [matrix[2, 1] - matrix[1, 2], matrix[0, 2] - matrix[2, 0], matrix[1, 0] - matrix[0, 1]]
    )
    sine = float(np.linalg.norm(axis))
    angle = float(np.arctan2(sine, 0.5 * (np.trace(matrix) - 1.0)))
    return axis if sine < 1e-12 else axis * (angle / sine)
