"""Work is counted where equations are evaluated, and bounded where that is asked for."""

import numpy as np
import pytest

from tests.vjm.test_bent import STRIP, column
from vjm import paper, work
from vjm.critical import critical_load
from vjm.equilibrium import Equilibrium, equilibrium
from vjm.mechanisms.parallelogram import Parallelogram

MECHANISM = Parallelogram(310.0, 80.0, paper.BAR_STIFFNESS, 0.0)
MOVED = MECHANISM.unloaded_pose + np.array([0.0, 1.0, 0.0, 0.0, 0.0, 0.0])

COLUMN = column(STRIP, "clamped", "free")
CRITICAL = critical_load(COLUMN, ()).load


def taken(targets: np.ndarray) -> float:
    before = work.spent()
    assert np.all(equilibrium(MECHANISM, targets).converged)
    return work.spent() - before


def test_the_same_load_case_takes_the_same_work_and_a_batch_takes_more() -> None:
    one = taken(MOVED)
    assert one == taken(MOVED) > 1.0
    many = taken(np.tile(MOVED, (3 * work.MEMBERS, 1)))
    assert 3.0 * one < many < 5.0 * one


def test_more_than_is_allowed_raises_and_what_follows_is_free_again() -> None:
    with pytest.raises(work.TooMuch), work.at_most(1.5):
        taken(MOVED)
    with work.at_most(1e6), pytest.raises(work.TooMuch), work.at_most(0.0):
        taken(MOVED)
    assert taken(MOVED) > 0.0


def test_work_of_another_process_counts() -> None:
    before = work.spent()
    work.elsewhere(7.0)
    assert work.spent() == before + 7.0


def test_work_within_a_bound_is_over_beyond_it_and_raises_nothing() -> None:
    with work.within(1.5):
        assert not work.over()
        taken(MOVED)
        assert work.over()
        with work.within(1e6):
            assert work.over()
    assert not work.over()


def pressed(share: float, start: Equilibrium | None = None) -> tuple[Equilibrium, float]:
    """Under this share of the critical load, and the work that it took."""
    before, targets = work.spent(), np.zeros(6)
    targets[0] = share * CRITICAL
    found = equilibrium(COLUMN, targets, (), start)
    return found, work.spent() - before


def test_a_load_that_had_no_stable_equilibrium_is_not_looked_for_at_length_again() -> None:
    first, much = pressed(1.3)
    again, little = pressed(1.31, first)
    assert first.unstable > 0 and again.unstable > 0
    assert little < 0.2 * much


@pytest.mark.parametrize("share", [0.3, 0.9, -1.0])
def test_a_load_that_has_one_is_found_from_one_that_had_none(share: float) -> None:
    first, _ = pressed(1.3)
    back, _ = pressed(share, first)
    assert back.converged and back.unstable == 0
    np.testing.assert_allclose(back.pose, pressed(share)[0].pose, atol=1e-9)
