"""Laws of placed sites: tangents, dissipation, and each on a bar that only it lets move."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest

from fem.frame.bench import Trial, run
from fem.frame.errors import Errors
from fem.frame.laws.form import Elastic, Law
from fem.frame.laws.forms import forms
from fem.frame.laws.forms.sliders import CoulombByLoad
from fem.frame.laws.forms.smooth import PreloadedLinear
from fem.frame.laws.forms.wrapped import OverLoad
from fem.frame.placed import Placed
from fem.frame.rig import Rig
from tests.fem.frame.law_examples import CONSERVATIVE, EXAMPLES, WITHIN
from tests.fem.frame.rigs import LENGTH, SLENDER, control, steps

BY_LOAD = "CoulombByLoad"


def followed(law: Law, history: np.ndarray) -> np.ndarray:
    """Forces of a law along a history of its coordinate, from the unloaded state."""
    if isinstance(law, Elastic):
        return np.asarray(law.curve(history)[0])
    memory, out = np.zeros((1, law.width)), []
    for q in history:
        force, _, memory = law.respond(np.array([q]), memory)
        out.append(float(force[0]))
    return np.array(out)


def test_every_law_is_found_and_has_an_example() -> None:
    assert set(forms()) == {*EXAMPLES, BY_LOAD}


@pytest.mark.parametrize("name", [*EXAMPLES, BY_LOAD])
def test_the_stiffness_is_the_slope_of_the_force(name: str) -> None:
    law = CoulombByLoad(0.3, 4.0) if name == BY_LOAD else EXAMPLES[name][0]
    generator = np.random.default_rng(1)
    memory = np.zeros((60, law.width))
    q = generator.uniform(-1.0, 1.0, 60)
    _, _, memory = law.respond(q, memory)
    if law.loaded:
        memory[:, 0] = 2.0
    q, step = q + generator.uniform(-0.5, 0.5, 60), 1e-7
    slope = (law.respond(q + step, memory)[0] - law.respond(q - step, memory)[0]) / (2 * step)
    np.testing.assert_allclose(law.respond(q, memory)[1], slope, rtol=2e-6, atol=2e-6)


@pytest.mark.parametrize("name", EXAMPLES)
def test_each_law_is_its_closed_form_on_a_bar_that_moves_along_alone(name: str) -> None:
    """Displacement less F L / EA is the coordinate of the law, its force the pull."""
    law, route = EXAMPLES[name]
    force, length = 3000.0, 0.05
    ways = np.concatenate([np.linspace(0.1, 1.4, 9), np.linspace(1.2, -1.4, 14)[:-1]])
    bar = Rig("bar", LENGTH, SLENDER)
    trial = Trial(0.0, control("x", "y", "z", "rx", "ry", "rz"), steps(x=length * ways * 3.0))
    # A straight bar under an axial load is exact with any number of elements.
    (it,) = run(bar, Errors(), [trial], elements=2, placed=[Placed("along@base", law, force, length)])
    assert it.converged.all(), it.reason
    pull = it.wrench[:, 0]
    q = it.displacement[:, 0] - pull * LENGTH / SLENDER.EA
    expected = np.array(route((q / length).tolist()))
    np.testing.assert_allclose(pull / force, expected, rtol=0.0, atol=WITHIN.get(name, 1e-8))
    np.testing.assert_allclose(it.followed[0].coordinate[:, 0], q, rtol=0.0, atol=1e-9)
    np.testing.assert_allclose(it.followed[0].force[:, 0], pull, rtol=1e-9, atol=1e-5)
    assert np.ptp(q) > length


@pytest.mark.parametrize("name", EXAMPLES)
def test_no_loop_gives_work(name: str) -> None:
    law, _ = EXAMPLES[name]
    generator = np.random.default_rng(4)
    for _ in range(2):
        corners = [0.0, *generator.uniform(-1.2, 1.2, 4), 0.0]
        once = np.concatenate([np.linspace(a, b, 250)[1:] for a, b in pairwise(corners)])
        path = np.concatenate(([0.0], once, once))
        force = followed(law, path)
        work = 0.5 * (force[1:] + force[:-1]) * np.diff(path)
        first, second = work[: len(once)].sum(), work[len(once) :].sum()
        if name in CONSERVATIVE:
            assert abs(first) < 1e-3 and abs(second) < 1e-3
        else:
            assert first > 1e-3 and second > -1e-4


def test_friction_by_load_follows_the_load_of_the_step_before() -> None:
    """A bar on one hinge, pulled along x and swung along z; its axial load is F cos of the turn."""
    bar = Rig("bar", LENGTH, SLENDER, base="pinned")
    values = steps(x=[1000.0, 2000.0, 500.0, 500.0, 3000.0, 100.0], z=[0.0, -3.0, -6.0, -2.0, 4.0, 4.1])
    law = CoulombByLoad(0.2, 1e5)
    (it,) = run(
        bar,
        Errors(),
        [Trial(0.0, control("z", "y", "rx", "rz"), values)],
        placed=[Placed("hinge_torque", law)],
    )
    assert it.converged.all(), it.reason
    turn = it.followed[0].coordinate[:, 0]
    # A torque of 400 N mm bends the bar by T L / 3 EI = 2e-4 rad.
    np.testing.assert_allclose(turn, -values[:, 2] / LENGTH, atol=3e-4)
    axial = np.abs(it.wrench[:, 0] * np.cos(turn) - it.wrench[:, 2] * np.sin(turn))
    slider, expected = 0.0, []
    for n, q in enumerate(turn):
        most = 0.2 * (axial[n - 1] if n else 0.0)
        torque = min(most, max(-most, 1e5 * (q - slider)))
        slider = q - torque / 1e5
        expected.append(torque)
    # The bar bends by some 1e-4 rad under the torque: its axial load is that at its base.
    np.testing.assert_allclose(it.followed[0].force[:, 0], expected, rtol=1e-3, atol=1e-2)
    assert it.followed[0].force[1, 0] == pytest.approx(200.0, rel=1e-3)


def test_a_coordinate_over_the_load_starts_at_zero() -> None:
    with pytest.raises(ValueError, match="allowed are 0 and a positive one"):
        OverLoad(PreloadedLinear(0.1, 1.0), 5.0)
