"""The mean misfit in one sentence: a zero is asked about where a constant is what is off."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from pipeline.compare.models import compare_models
from tests.cases.test_knocked_rows import loads, measured


@pytest.mark.parametrize(("zero", "asked"), [("nominal", True), ("fitted", False)])
def test_a_constant_is_asked_about_where_zeros_are_known(tmp_path: Path, zero: str, asked: bool) -> None:
    right = measured(tmp_path, loads(9), 0.0, {})
    tests = []
    for test in right.tests:
        moved = test.data.displacement + np.array([0.0, 0.4, 0.0, 0.0, 0.0, 0.0])
        tests.append(replace(test, zero=zero, data=replace(test.data, displacement=moved)))
    said = compare_models(replace(right, tests=tuple(tests))).models[0].headline
    assert ("was it zeroed" in said) == asked == said.startswith("y is 0.398 mm off on average")


def test_what_grows_with_the_square_of_the_load_is_no_zero(tmp_path: Path) -> None:
    """A dial that the bend foreshortens is off in the mean, and began at zero."""
    right = measured(tmp_path, loads(9), 0.0, {})
    tests = []
    for test in right.tests:
        bent = np.where(np.arange(6) == 0, -0.05 * (loads(9)[:, None] / 200.0) ** 2, test.data.displacement)
        tests.append(replace(test, data=replace(test.data, displacement=bent)))
    sigmas = right.noise.sigmas
    sigmas[0] = 0.002
    noisy = replace(right, tests=tuple(tests), noise=right.noise.of(sigmas))
    said = compare_models(noisy).models[0].headline
    assert said.startswith("x is -0.0") and "mm off on average (" in said and "zeroed" not in said
