"""K_tran and K_rot of a 6x6: what a single force or a single moment on the platform meets.

The paper prints one K_tran and one K_rot without saying how they come from the 6x6. Here K_tran (3, 3) is the inverse
of the compliance to forces, the platform free to turn, and K_rot (3, 3) that of the compliance to moments, the
platform free to shift. Where the 6x6 does not couple the two, as in the isotropic posture of an Orthoglide with feet
along its legs, they are its diagonal blocks.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from vjm.frames import Array


def translational(stiffness: ArrayLike) -> Array:
    """K_tran (..., 3, 3), N/mm, of a 6x6 (..., 6, 6). numpy.linalg.LinAlgError where free rotation has no stiffness."""
    k = np.asarray(stiffness, dtype=float)
    return _schur(k[..., :3, :3], k[..., :3, 3:], k[..., 3:, 3:])


def rotational(stiffness: ArrayLike) -> Array:
    """K_rot (..., 3, 3), N·mm/rad, of a 6x6 (..., 6, 6). numpy.linalg.LinAlgError where free shifts have none."""
    k = np.asarray(stiffness, dtype=float)
    return _schur(k[..., 3:, 3:], k[..., 3:, :3], k[..., :3, :3])


def principal(block: ArrayLike) -> Array:
    """Principal stiffnesses (..., 3), ascending, of a (..., 3, 3)."""
    b = np.asarray(block, dtype=float)
    return np.asarray(np.linalg.eigvalsh(0.5 * (b + np.swapaxes(b, -1, -2))))


def _schur(own: Array, mixed: Array, other: Array) -> Array:
    left = own - mixed @ np.linalg.solve(other, np.swapaxes(mixed, -1, -2))
    return 0.5 * (left + np.swapaxes(left, -1, -2))
