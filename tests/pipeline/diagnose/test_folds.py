"""Whether an effect would be chosen again without one of the tests."""

from __future__ import annotations

from types import SimpleNamespace
from typing import cast

import numpy as np
import pytest

from pipeline.diagnose.folds import agreement
from pipeline.diagnose.picture import Picture
from pipeline.diagnose.shelf import Names, Shelf
from pipeline.diagnose.signatures import Signature
from pipeline.inference.fit import Fit
from pipeline.inference.model import Model
from pipeline.selection.criteria import CRITERIA
from vjm.effects import catalogue

NAMES = ("modulus_error", "mounting_tilt")
EVERY = np.repeat(np.arange(4), 5)


def shelf(misfit: np.ndarray) -> Shelf:
    """Four tests of five readings; one effect raises all of them, the other those of the last test alone."""
    effects = catalogue()
    shapes = np.ones(EVERY.size), (EVERY == 3).astype(float)
    signatures = {
        name: Signature(effects[name], (shape[:, None],), np.array([-np.inf]))
        for name, shape in zip(NAMES, shapes, strict=True)
    }
    fit = cast(Fit, SimpleNamespace(chi_square=float(misfit @ misfit), model=Model()))
    none = np.zeros((EVERY.size, 0))
    about = Picture(fit, signatures, misfit, none, none, EVERY, 1.0, CRITERIA.plausible)
    pictures = {frozenset[str](): about}
    return cast(
        Shelf,
        SimpleNamespace(pictures=pictures, candidates={n: effects[n] for n in NAMES}, criteria=CRITERIA),
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
    assert agreement(shelf(misfit), names, name) == share
