"""Stability of an equilibrium with its held coordinates fixed: negative eigenvalues of the tangent."""

import numpy as np

from fem.frame.batch import Bools
from fem.frame.condensation import negative_pivots
from fem.frame.control import Conditions
from fem.frame.so3 import transpose
from fem.frame.system import System
from meshes.solid import Floats

NEUTRAL = 1e-9
"""Eigenvalue, over the diagonal, that counts as zero: a mechanism is neither stable nor unstable."""


def negative_eigenvalues(system: System, conditions: Conditions, active: Bools) -> Floats:
    """(B,) number of unstable directions among motions that satisfy the displacement and gauge conditions.

    The bordered matrix [[K, Cᵀ], [C, 0]] has one more negative eigenvalue for each independent row of C.
    """
    size = system.load.shape[-1]
    there = active[:, :, None] & active[:, None, :]
    K = np.where(there, system.tangent, np.eye(size))
    root = 1.0 / np.sqrt(np.maximum(np.abs(np.diagonal(K, axis1=1, axis2=2)), 1e-12))
    K = K * root[:, :, None] * root[:, None, :]
    held = conditions.geometric[..., None]
    C = np.where(held & active[:, None, :], conditions.on_unknowns, 0.0) * root[:, None, :]
    C = C / np.maximum(np.sqrt((C**2).sum(-1, keepdims=True)), 1e-300)
    idle = np.where(conditions.geometric, 0.0, 1.0)[..., None] * np.eye(6)
    whole = np.concatenate((np.concatenate((K, transpose(C)), -1), np.concatenate((C, idle), -1)), -2)
    negative = (np.linalg.eigvalsh(whole) < -NEUTRAL).sum(-1) - conditions.geometric.sum(-1)
    return np.asarray(negative + negative_pivots(system.condensed).sum(-1), float)
