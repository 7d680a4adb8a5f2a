"""A search that has taken too long ends with what it found, says so, and names nothing."""

from dataclasses import replace

import pytest

from pipeline.answer.of_diagnosis import answered
from pipeline.assessment.coverage.trial import campaign
from pipeline.inference.model import Model
from pipeline.selection.criteria import CRITERIA
from pipeline.selection.diagnosis import Diagnosis, diagnose
from vjm.effects import catalogue

TESTS = campaign((("modulus_error.scale", 0.95),), 3, 8)


def found(most: float) -> Diagnosis:
    return diagnose(TESTS, Model(), catalogue(), criteria=replace(CRITERIA, search_work=most))


@pytest.mark.long
def test_what_was_not_compared_with_all_is_not_named() -> None:
    whole = found(CRITERIA.search_work)
    assert whole.verdict == "identified" and not whole.found.ended
    for most in (0.0, 50.0):
        it = found(most)
        assert it.found.ended
        assert it.verdict == "unknown" and len(it.cache.fits) <= len(whole.cache.fits)
        said = " ".join(answered(it).sentences)
        assert "The search ended" in said or "the search ended" in said
