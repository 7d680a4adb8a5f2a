"""Unloaded stiffness of the parallelogram against the closed form (Eq. 11 of the paper), turned to the base frame."""

from __future__ import annotations

import numpy as np
import pytest

from fem.frame.bench import Trial, run
from fem.frame.errors import Errors
from fem.frame.so3 import exp
from meshes.solid import Floats
from tests.fem.frame.rigs import BAR_P, ORTHOGLIDE, WIDTH, control, parallelogram
from tests.fem.frame.test_section import SHEAR, stiffness_at_rest

ALL = ("x", "y", "z", "rx", "ry", "rz")


def equation_11(bar: Floats, q: float) -> Floats:
    """(6, 6) in the base frame."""
    c, s, d = np.cos(q), np.sin(q), WIDTH
    k = np.zeros((6, 6))
    k[0, 0], k[1, 1], k[1, 5] = bar[0, 0], bar[1, 1], bar[1, 5]
    k[3, 3] = bar[3, 3] + d**2 * c**2 * bar[1, 1] / 4
    k[3, 5] = d**2 * 2 * s * c * bar[1, 1] / 8
    k[4, 4] = d**2 * c**2 * bar[0, 0] / 4
    k[5, 5] = bar[5, 5] + d**2 * s**2 * bar[1, 1] / 4
    k[3:, :3], k[5, 3] = k[:3, 3:].T, k[3, 5]
    turn = np.kron(np.eye(2), exp(np.array([0.0, q, 0.0])))
    return 2 * turn @ k @ turn.T


@pytest.mark.parametrize("degrees", [-45, 0, 20, 60])
@pytest.mark.parametrize("bar", [ORTHOGLIDE, SHEAR, stiffness_at_rest(BAR_P)], ids=["Eq. 12", "shear", "P"])
def test_equation_11(bar: Floats, degrees: float) -> None:
    size = np.array([1e-3] * 3 + [1e-5] * 3)
    values = np.concatenate((np.diag(size), -np.diag(size)))
    trials = [Trial(np.radians(degrees), control(*ALL), v[None]) for v in values]
    wrench = np.array([r.wrench[0] for r in run(parallelogram(bar), Errors(), trials)])
    found = ((wrench[:6] - wrench[6:]) / (2 * size[:, None])).T
    expected = equation_11(bar, np.radians(degrees))
    root = np.sqrt(np.diag(equation_11(bar, 0.0)))
    root[2] = root[0]
    # Central differences over 1e-3 mm and 1e-5 rad: measured 1e-9.
    np.testing.assert_allclose(found / np.outer(root, root), expected / np.outer(root, root), atol=1e-6)
