"""Preconditioned conjugate gradients for several right-hand sides at once.

Source: Y. Saad, Iterative Methods for Sparse Linear Systems, 2nd ed., SIAM 2003, section 9.2.
"""

from collections.abc import Callable

import numpy as np

from fem.factor import Operator, SolveError
from meshes.solid import Floats


def conjugate_gradients(
    matrix: Operator, rhs: Floats, near: Callable[[Floats], Floats], tolerance: float, most: int
) -> tuple[Floats, int]:
    """x (n, ...) of a symmetric positive definite matrix for `rhs` (n, ...), and the iterations that it took.

    near: a symmetric positive definite inverse that is near to the matrix's, of residuals (n, r). tolerance: what is
    left of each right-hand side, of its length. SolveError where that is not reached in so many iterations.
    """
    b = rhs.reshape(len(rhs), -1)
    sizes = np.linalg.norm(b, axis=0)
    x, r = np.zeros_like(b), b.copy()
    p, rz = np.zeros_like(b), np.ones(b.shape[1])
    for iteration in range(most + 1):
        if np.all(np.linalg.norm(r, axis=0) <= tolerance * sizes):
            return x.reshape(rhs.shape), iteration
        z = near(r)
        rz, before = np.einsum("ij,ij->j", r, z), rz
        p = z + _safe_ratio(rz, before) * p
        product = matrix @ p
        curvature = np.einsum("ij,ij->j", p, product)
        if np.any(curvature < 0.0):
            raise SolveError("the matrix is not positive definite, as conjugate gradients need it")
        step = _safe_ratio(rz, curvature)
        x += step * p
        r -= step * product
    raise SolveError(f"the iteration did not converge in {most} steps: the model may not be held")


def _safe_ratio(a: Floats, b: Floats) -> Floats:
    """a / b, all (...), and zero where b is zero: a right-hand side that is solved already."""
    return np.divide(a, b, out=np.zeros_like(a), where=b != 0.0)
