"""Plays near the noise: rows choose the side of the stop, so chi-square tells less, and no rival is excluded by it."""

from __future__ import annotations

import pytest

from pipeline.inference.load_cases import load_cases
from pipeline.inference.model import Model
from pipeline.inference.multistart import best_fit
from pipeline.selection.criteria import CRITERIA
from pipeline.selection.exclusion import excluded, needed
from pipeline.selection.fit_cache import FitCache, Names
from tests.pipeline.selection.bench import bench
from vjm.effects import catalogue

BENT = "bar_geometric_nonlinearity"
PLAY, CONTACT, SOFT = (
    frozenset({BENT, name}) for name in ("joint_clearance", "contact_stiffening", "modulus_error")
)


def cache(play: float) -> FitCache:
    cases = load_cases(
        bench("joint_clearance.play_mm", play, ("axial_held_q+0", "axial_held_q+15", "swing_q+0"))
    )
    return FitCache(cases, Model(), catalogue(), lambda _: None)


@pytest.mark.long
def test_a_kink_in_one_set_alone_asks_for_more() -> None:
    it = cache(1e-3)
    assert needed(it, CONTACT, SOFT) == CRITERIA.exclusion
    choices = it.fit(PLAY).residual
    assert choices.spread > 0.0 < choices.doubt
    assert it.fit(CONTACT).residual.spread == it.fit(CONTACT).residual.doubt == 0.0
    assert needed(it, PLAY, CONTACT) == needed(it, CONTACT, PLAY) == CRITERIA.exclusion + choices.spread


@pytest.mark.long
@pytest.mark.parametrize(("play", "plain"), [(1e-3, False), (6e-3, True)])
def test_a_play_is_not_excluded_by_what_looks_like_it(play: float, plain: bool) -> None:
    """Nor does one near the noise exclude that; one of six times the noise does."""
    it = cache(play)
    assert it.fit(PLAY).model.values.size
    assert not excluded(it, PLAY, CONTACT) and excluded(it, CONTACT, PLAY) == plain


def test_a_play_twenty_times_the_noise_is_told() -> None:
    it = cache(2e-2)
    assert excluded(it, CONTACT, PLAY) and not excluded(it, PLAY, CONTACT)


def test_a_play_that_no_size_helps_is_absent() -> None:
    """One of 0.6 times the noise: without a number its rows choose no sides, and it is no harder to exclude."""
    found = cache(6e-4).fit(PLAY)
    assert not found.model.values.size and found.residual.spread == found.residual.doubt == 0.0


@pytest.mark.long
def test_a_play_is_looked_for_at_all_sizes_whatever_a_probe_found() -> None:
    it = cache(6e-4)
    bent: Names = frozenset({BENT})
    before = it.fit(bent)
    found = it.fit(PLAY, {"joint_clearance": 0.03})
    model = before.model.with_effects([catalogue()["joint_clearance"]])
    again = best_fit(model, it.whole, ("joint_clearance",), before.prediction)
    assert abs(found.chi_square - again.chi_square) < 1.0
