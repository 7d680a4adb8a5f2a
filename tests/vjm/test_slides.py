"""Slides: laws inverted exactly, and a start that leads where rest leads."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from tests.vjm.load_paths import load_path
from vjm import paper
from vjm.clearance import Clearance
from vjm.effects.base import for_bars
from vjm.effects.contact_stiffening import Contact
from vjm.equilibrium import equilibrium, nearby
from vjm.increments import UNSURE
from vjm.mechanisms.parallelogram import Parallelogram
from vjm.slides import with_slides

HELD = ("y", "z", "rx", "ry", "rz")
LINKAGE = Parallelogram(310.0, 80.0, paper.BAR_STIFFNESS, q=np.radians(15))
FORCES = np.array([-4000.0, -3.0, 0.0, 0.4, 900.0])
TARGETS = LINKAGE.unloaded_pose * [0, 1, 1, 1, 1, 1] + FORCES[:, None] * [1, 0, 0, 0, 0, 0]


@pytest.mark.parametrize("law", [Contact(5e-5), Clearance(0.01)])
def test_a_law_gives_what_it_answers(law: Contact | Clearance) -> None:
    force = np.array([-5e3, -2.0, -0.1, 0.0, 0.3, 1.0, 40.0, 4e3])
    answer = law.respond(law.give(force)[..., None], np.zeros(0)).force[..., 0]
    np.testing.assert_allclose(answer, force, rtol=1e-9, atol=1e-12)


@pytest.mark.parametrize("law", [Contact(5e-5), Clearance(0.01)])
def test_the_start_leads_where_rest_leads(law: Contact | Clearance) -> None:
    sliding = for_bars(LINKAGE, lambda link: replace(link, slides=(law,)))
    cold = equilibrium(sliding, TARGETS, HELD)
    warm = equilibrium(sliding, TARGETS, HELD, with_slides(equilibrium(LINKAGE, TARGETS, HELD), sliding))
    assert cold.converged.all() and warm.converged.all()
    np.testing.assert_allclose(warm.pose, cold.pose, rtol=0, atol=1e-10)
    assert warm.iterations.max() <= 5 and warm.iterations.sum() <= cold.iterations.sum()


def test_a_state_with_other_slides_serves_as_well() -> None:
    """Stops that moved by a tenth are met again; kept where they were, Newton's method wanders."""
    first, second = (
        for_bars(LINKAGE, lambda link, play=play: replace(link, slides=(Clearance(play),)))
        for play in (0.01, 0.011)
    )
    state = equilibrium(first, TARGETS, HELD)
    again = equilibrium(second, TARGETS, HELD, with_slides(state, second))
    np.testing.assert_allclose(again.pose, equilibrium(second, TARGETS, HELD).pose, rtol=0, atol=1e-10)
    assert again.iterations.max() <= 5


def test_a_first_step_within_the_play_is_no_wandering() -> None:
    """From inside the play to the stop: the soft spring's step goes 15 mm, the platform 0.02 mm. A way of 15 mm that
    the platform does go is one."""
    sliding = for_bars(LINKAGE, lambda link: replace(link, slides=(Clearance(0.01),)))
    inside, pressed = (LINKAGE.unloaded_pose * [0, 1, 1, 1, 1, 1] + [f, 0, 0, 0, 0, 0] for f in (0.02, 600.0))
    start = equilibrium(sliding, inside, HELD)
    found = nearby(sliding, pressed, HELD, start, {}, start.memory)
    path = np.linspace(inside, pressed, 300)
    assert found.converged and np.abs(found.pose - start.pose)[0] < 0.03
    np.testing.assert_allclose(found.pose, load_path(sliding, path, HELD, start).pose[-1], rtol=0, atol=1e-10)
    wide = for_bars(LINKAGE, lambda link: replace(link, slides=(Clearance(1.0),)))
    start = equilibrium(wide, inside, HELD)
    assert nearby(wide, pressed, HELD, start, {}, start.memory).reason == UNSURE


def test_another_mechanism_is_refused() -> None:
    with pytest.raises(ValueError, match="unknowns"):
        with_slides(equilibrium(LINKAGE, TARGETS, HELD), LINKAGE.refined())
