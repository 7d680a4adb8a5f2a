"""A search that has taken too long ends with what it found, says so, and names nothing."""

import pytest

from pipeline.coverage.trial import campaign
from pipeline.diagnose import search
from pipeline.diagnose.diagnosis import Diagnosis, diagnose
from pipeline.diagnose.words import sentences
from pipeline.inference.model import Model
from vjm.effects import catalogue

TESTS = campaign((("modulus_error.scale", 0.95),), 3, 8)


def found(most: float, monkeypatch: pytest.MonkeyPatch) -> Diagnosis:
    monkeypatch.setattr(search, "WORK", most)
    return diagnose(TESTS, Model(), catalogue())


def test_what_was_not_compared_with_all_is_not_named(monkeypatch: pytest.MonkeyPatch) -> None:
    whole = found(search.WORK, monkeypatch)
    assert whole.verdict == "identified" and not whole.found.ended
    for most in (0.0, 50.0):
        it = found(most, monkeypatch)
        assert it.found.ended
        assert it.verdict == "unknown" and len(it.shelf.fits) <= len(whole.shelf.fits)
        said = " ".join(sentences(it))
        assert "The search ended" in said or "the search ended" in said
