"""What is made of a bar is remembered by its values: the same for equal bars, anew for any that differs."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from vjm import checks, paper
from vjm.fibres import Fibres
from vjm.laws import Linear
from vjm.link import Link
from vjm.lumped import Lumped
from vjm.refined import Refined

BAR = Link(310.0, checks.stiffness_matrix("K_b", paper.BAR_STIFFNESS), bow=(0.2, -0.1))
GIVE = np.diag([1e-6, 2e-6, 2e-6, 1e-9, 1e-9, 1e-9])


@pytest.mark.parametrize("model", [Refined(6), Lumped()])
@pytest.mark.parametrize(
    "other",
    [
        replace(BAR, length=311.0),
        replace(BAR, stiffness=1.01 * BAR.stiffness),
        replace(BAR, base_give=GIVE),
        replace(BAR, tip_give=GIVE),
        replace(BAR, bow=(0.2, 0.1)),
        replace(BAR, fibres=Fibres(12.0, 8.0, 0.002)),
    ],
)
def test_a_bar_that_differs_is_made_anew(model: Refined | Lumped, other: Link) -> None:
    first, again = model.limb(BAR), model.limb(replace(BAR, bow=(0.2, -0.1)))
    found = model.limb(other)
    assert np.array_equal(first.stiffness, again.stiffness)
    same = np.array_equal(found.stiffness, first.stiffness) and np.array_equal(found.rest, first.rest)
    assert not same or len(found.springs) != len(first.springs)


def test_slides_and_growth_are_no_part_of_the_key() -> None:
    other = replace(BAR, slides=(Linear(1e4),), elongation=(("temperature", 1e-3),))
    assert other.by_value == BAR.by_value and hash(other.by_value) == hash(BAR.by_value)


def test_a_checked_matrix_is_its_own_copy_and_cannot_be_written() -> None:
    given = np.array(paper.BAR_STIFFNESS)
    found = checks.stiffness_matrix("K_b", given)
    given[0, 0] = 1.0
    assert found[0, 0] == paper.BAR_STIFFNESS[0][0] and not found.flags.writeable
    with pytest.raises(ValueError, match="K_c must be positive definite"):
        checks.stiffness_matrix("K_c", -np.eye(6))
