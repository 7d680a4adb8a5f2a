"""How often perfect intervals hold null where null is a bound: what coverage may be asked of such numbers.

S. G. Self, K.-Y. Liang, Journal of the American Statistical Association 82 (1987) 605-610.
"""

from __future__ import annotations

import numpy as np
import pytest
from scipy.optimize import nnls
from scipy.stats import chi2

from pipeline.assessment.coverage.cases import BASE
from pipeline.assessment.coverage.trial import exact
from pipeline.inference.fit import fit
from pipeline.inference.load_cases import load_cases
from pipeline.inference.model import Model
from vjm.effects import catalogue

RISE = float(chi2.ppf(0.95, 1))
DRAWS = 2000


@pytest.mark.parametrize(("name", "share"), [("contact_stiffening", 0.975), ("base_compliance", 0.993)])
def test_null_is_held_more_often_than_in_95_of_100(name: str, share: float) -> None:
    """The linear problem of a bench without the effect, noise drawn anew, numbers fitted from null upwards."""
    model = Model().with_effects([catalogue()[each] for each in (BASE, name)])
    assert all(each.parameter.one_sided for each in model.free)
    slopes = fit(model, load_cases(exact((), 8))).jacobian
    triangle = np.linalg.qr(slopes / np.linalg.norm(slopes, axis=0), mode="r")
    count, rng = triangle.shape[1], np.random.default_rng(4)
    rises = []
    for noise in rng.normal(size=(DRAWS, count)):
        least = nnls(triangle, noise)[1] ** 2
        # A column of zeros stands for the number that is held at null.
        rises += [nnls(triangle * (np.arange(count) != k), noise)[1] ** 2 - least for k in range(count)]
    held = np.mean(np.array(rises) < RISE)
    assert held == pytest.approx(share, abs=3.0 * np.sqrt(share * (1.0 - share) / DRAWS))
