"""The record of thresholds: each is explained, one can be changed alone, and no other module has one of its own."""

from __future__ import annotations

from dataclasses import FrozenInstanceError, replace

import pytest

from pipeline.selection.criteria import CRITERIA, refits


def test_each_has_a_unit_a_meaning_and_a_source() -> None:
    every = list(CRITERIA.of())
    assert len({each.name for each in every}) == len(every) > 40
    for each in every:
        assert each.unit and each.group and len(each.meaning) > 10 and each.source
        assert each.value == getattr(CRITERIA, each.name)


def test_one_is_changed_alone_and_a_count_stays_a_count() -> None:
    twice, half = CRITERIA.times("exclusion", 2.0), CRITERIA.times("few_sets", 0.1)
    assert twice == replace(CRITERIA, exclusion=10.0)
    assert half.few_sets == 1 and isinstance(half.few_sets, int)
    with pytest.raises(FrozenInstanceError):
        CRITERIA.exclusion = 1.0  # type: ignore[misc]


def test_fits_are_made_again_only_where_they_depend_on_it() -> None:
    assert refits(CRITERIA, CRITERIA.times("plausible", 2.0))
    assert not refits(CRITERIA, CRITERIA.times("exclusion", 2.0))
