"""Forms where influences are known: amplitudes that have to rise."""

import numpy as np
import pytest
from scipy.optimize import minimize

from pipeline.discover.forming import rising


@pytest.mark.parametrize("seed", range(6))
def test_amplitudes_that_rise_are_those_of_a_general_solver(seed: int) -> None:
    generator = np.random.default_rng(seed)
    columns, residuals = generator.normal(size=(40, 3)) * [1.0, 1e3, 1e-2], generator.normal(size=40)
    slopes = generator.normal(size=(12, 3)) * [1.0, 1e3, 1e-2] + [0.8, 0.0, 0.0]
    found = rising(columns, residuals, slopes)
    unit = np.array([1.0, 1e-3, 1e2])
    other = minimize(
        lambda a: float(np.sum((residuals - columns @ (unit * a)) ** 2)),
        np.array([1.0, 0.0, 0.0]),
        constraints={"type": "ineq", "fun": lambda a: slopes @ (unit * a)},
        method="SLSQP",
        options={"ftol": 1e-14, "maxiter": 500},
    )
    assert np.min(slopes @ found) > -1e-9
    assert float(np.sum((residuals - columns @ found) ** 2)) == pytest.approx(float(other.fun), rel=1e-7)


def test_where_all_rise_the_amplitudes_are_those_of_least_squares() -> None:
    generator = np.random.default_rng(9)
    columns = generator.normal(size=(30, 2))
    residuals = columns @ [2.0, 0.1] + 0.01 * generator.normal(size=30)
    slopes = np.array([[1.0, -2.0], [1.0, 2.0]])
    assert rising(columns, residuals, slopes) == pytest.approx(
        np.linalg.lstsq(columns, residuals)[0], rel=1e-9
    )
