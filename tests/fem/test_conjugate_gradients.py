"""Conjugate gradients end after as many steps as a matrix has different eigenvalues, and that is enough."""

from __future__ import annotations

import numpy as np
import pytest
import scipy.sparse as sp

from fem.conjugate_gradients import conjugate_gradients
from fem.factor import SolveError


def test_the_last_step_counts() -> None:
    matrix, load = sp.csr_matrix(np.diag([1.0, 2.0, 3.0])), np.array([1.0, 1.0, 1.0])
    x, steps = conjugate_gradients(matrix, load, lambda r: r, 1e-12, 3)
    assert steps == 3
    np.testing.assert_allclose(matrix @ x, load, atol=1e-12)
    with pytest.raises(SolveError, match="in 2 steps"):
        conjugate_gradients(matrix, load, lambda r: r, 1e-12, 2)
