"""What a model has to do for the columns of a mistake before that is told as one."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

from pipeline.inference.fit import Fit, fit
from pipeline.inference.load_cases import load_cases
from pipeline.inference.model import Model
from pipeline.selection.criteria import CRITERIA
from pipeline.selection.doctor import _explained, _signals
from pipeline.selection.mistakes import possible
from pipeline.selection.mistakes.base import Mistake
from tests.pipeline.selection.bench import bench
from vjm.effects import catalogue


@cache
def found() -> Fit:
    cases = load_cases(bench("modulus_error.scale", 0.9))
    return fit(Model().with_effects([catalogue()["modulus_error"]]), cases)


def forces() -> Mistake:
    return next(it for it in possible(bench(), CRITERIA) if it.words == "all forces are in kgf")


def test_a_model_that_follows_the_columns_explains_them() -> None:
    assert _explained(found(), forces(), CRITERIA, True)


def test_a_number_at_its_bound_explains_nothing() -> None:
    it = found()
    (free,) = it.model.free
    for bound in free.bounds:
        assert not _explained(replace(it, model=it.model.at([bound])), forces(), CRITERIA, True)  # type: ignore[arg-type]


def test_a_column_that_is_predicted_far_off_is_not_made_good_by_a_louder_one() -> None:
    """One of which the model predicts three times what is read, while all of the others follow it."""
    it = found()
    less, more = (next(_signals(it, replace(forces(), columns=(name,)))) for name in ("fy_N", "fz_N"))
    assert more[0] > 100.0 * less[0] > 100.0 * CRITERIA.doctor_explains * less[2]
    values = it.prediction.values.copy()
    values[:, 7] *= 3.0
    off = replace(it, prediction=replace(it.prediction, values=values))
    assert not _explained(off, forces(), CRITERIA, True)
    assert _explained(off, replace(forces(), columns=("fx_N", "fz_N")), CRITERIA, True)
