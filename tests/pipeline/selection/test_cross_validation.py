"""Whether an effect would be chosen again without one of the tests."""

from __future__ import annotations

from types import SimpleNamespace
from typing import cast

import numpy as np
import pytest

from pipeline.inference.fit import Fit
from pipeline.inference.model import Model
from pipeline.selection.criteria import CRITERIA
from pipeline.selection.cross_validation import agreement
from pipeline.selection.first_order import FirstOrder
from pipeline.selection.fit_cache import FitCache, Names
from pipeline.selection.signatures import Signature
from vjm.effects import catalogue

NAMES = ("modulus_error", "mounting_tilt")
EVERY = np.repeat(np.arange(4), 5)


def cache(misfit: np.ndarray) -> FitCache:
    """Four tests of five readings; one effect raises all of them, the other those of the last test alone."""
    effects = catalogue()
    shapes = np.ones(EVERY.size), (EVERY == 3).astype(float)
    signatures = {
        name: Signature(effects[name], (shape[:, None],), np.array([-np.inf]))
        for name, shape in zip(NAMES, shapes, strict=True)
    }
    fit = cast(Fit, SimpleNamespace(chi_square=float(misfit @ misfit), model=Model()))
    none = np.zeros((EVERY.size, 0))
    about = FirstOrder(fit, signatures, misfit, none, none, EVERY, 1.0, CRITERIA.plausible)
    first_orders = {frozenset[str](): about}
    return cast(
        FitCache,
        SimpleNamespace(
            first_orders=first_orders, candidates={n: effects[n] for n in NAMES}, criteria=CRITERIA
        ),
    )


@pytest.mark.parametrize(
    ("by_test", "name", "share"),
    [
        ([10.0, 10.0, 10.0, 10.0], "modulus_error", 1.0),
        ([0.0, 0.0, 0.0, 10.0], "mounting_tilt", 0.75),
        ([0.0, 0.0, 0.0, 10.0], "modulus_error", None),
    ],
)
def test_what_folds_choose(by_test: list[float], name: str, share: float | None) -> None:
    """What shows in one test alone is chosen in all folds but the one without it. What all tests together would not
    choose to first order was chosen by fits: a share of folds would be no sign of how sure it is."""
    misfit = np.repeat(by_test, 5)
    names: Names = frozenset([name])
    assert agreement(cache(misfit), names, name) == share
