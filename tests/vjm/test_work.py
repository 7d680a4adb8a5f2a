"""Work is counted where equations are evaluated, and bounded where that is asked for."""

import numpy as np
import pytest

from vjm import paper, work
from vjm.equilibrium import equilibrium
from vjm.mechanisms.parallelogram import Parallelogram

MECHANISM = Parallelogram(310.0, 80.0, paper.BAR_STIFFNESS, 0.0)
MOVED = MECHANISM.unloaded_pose + np.array([0.0, 1.0, 0.0, 0.0, 0.0, 0.0])


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
