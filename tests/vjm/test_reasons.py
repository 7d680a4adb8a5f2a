"""Reasons are sentences that no other one begins with, and are found again in longer ones."""

import pytest

from vjm import newton
from vjm.reasons import Reason


@pytest.mark.parametrize("reason", list(Reason))
def test_a_longer_sentence_keeps_its_reason(reason: Reason) -> None:
    assert Reason.of(f"{reason}; last equilibrium 12 % of the way from the start") is reason
    assert sum(other.startswith(reason) for other in Reason) == 1


def test_what_the_solver_says_is_its_own_affair() -> None:
    for said in (newton.RUNNING, newton.DIVERGED, newton.SINGULAR, "anything else"):
        assert Reason.of(said) is Reason.NOT_CONVERGED
