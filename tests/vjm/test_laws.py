"""Spring laws: force and tangent are derivatives of the energy; friction against its closed form."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.vjm.beams import BAR_P
from tests.vjm.load_paths import load_path
from tests.vjm.strategies import LENGTH, WIDTH, fixed_seed
from vjm import paper, stiffness
from vjm.effects.joint_friction import Jenkins
from vjm.equilibrium import equilibrium
from vjm.laws import Adding, Law, Linear, Polynomial, Spring
from vjm.link import Link
from vjm.mechanism import ElasticChain
from vjm.mechanisms.parallelogram import Parallelogram
from vjm.refined import Refined

LIMB = Refined(3).limb(Link(LENGTH, paper.BAR_STIFFNESS))
STIFFNESS = np.array([[3.0, 1.0], [1.0, 2.0]])
LAWS: list[tuple[Law, int, float]] = [
    (LIMB.springs[0].law, 18, 0.1),
    (Linear(STIFFNESS), 2, 1.0),
    (Polynomial((2.0, 0.5, 3.0)), 1, 1.0),
    (Jenkins(3.0, 2.0), 1, 1.0),
]


@pytest.mark.parametrize(("law", "size", "scale"), LAWS)
@pytest.mark.parametrize("seed", range(5))
def test_force_and_tangent_are_derivatives(law: Law, size: int, scale: float, seed: int) -> None:
    generator = np.random.default_rng(seed)
    strain, steps = scale * generator.uniform(-1, 1, size), 1e-4 * scale * np.eye(size)
    memory = np.broadcast_to(law.initial_memory, (size, law.initial_memory.size))
    plus, minus = law.respond(strain + steps, memory), law.respond(strain - steps, memory)
    here = law.respond(strain, law.initial_memory)
    slope = (plus.energy - minus.energy) / (2e-4 * scale)
    np.testing.assert_allclose(here.force, slope, atol=1e-7 * np.abs(here.force).max() + 1e-9)
    tangent = (plus.force - minus.force) / (2e-4 * scale)
    np.testing.assert_allclose(here.tangent, tangent, atol=1e-6 * np.abs(here.tangent).max() + 1e-9)


def test_the_force_of_a_chain_alone_is_that_with_its_tangent() -> None:
    """Laws that leave their tangent out, and one that cannot."""
    linkage = replace(Parallelogram(LENGTH, WIDTH, paper.BAR_STIFFNESS), hinges=(Jenkins(3.0, 2.0),)).refined(
        4
    )
    chain = linkage.chains[0]
    assert [isinstance(spring.law, Adding) for spring in chain.springs].count(True) == 1
    strain = np.random.default_rng(2).uniform(-0.1, 0.1, (3, 2, chain.moving.size))
    memory = np.broadcast_to(chain.initial_memory, (3, 2, chain.initial_memory.size))
    np.testing.assert_array_equal(chain.force(strain, memory), chain.respond(strain, memory).force)


def test_the_bent_bar_has_no_linear_part() -> None:
    law = LIMB.springs[0].law
    assert not np.any(law.respond(np.zeros(18), np.zeros(0)).tangent)


def test_a_law_may_act_on_any_moving_coordinate_and_no_other() -> None:
    chain = Parallelogram(LENGTH, WIDTH, paper.BAR_STIFFNESS).chains[0]
    with pytest.raises(ValueError, match="moving coordinates"):
        ElasticChain(chain.chain, chain.stiffness, chain.rest, (Spring((8,), Polynomial((1.0,))),))


@pytest.mark.parametrize("degrees", [0, 30])
def test_hinge_springs_resist_the_motion_that_was_free(degrees: int) -> None:
    """Four springs of c turn by dz / (L cos q) when the platform is driven along z with x free."""
    q, c, k = np.radians(degrees), 500.0, np.diag([1e7] * 3 + [1e12] * 3)
    linkage = Parallelogram(LENGTH, WIDTH, k, q, hinges=(Linear(np.array([[c]])),))
    found = stiffness.unloaded_stiffness(linkage, q)
    assert found[2, 2] == pytest.approx(4 * c / LENGTH**2, rel=1e-6)


FRICTION = Jenkins(350.0, 2e-3)


def cycle(amplitude: float, steps: int = 25) -> np.ndarray:
    """One quarter and two full cycles of a triangle between plus and minus the amplitude."""
    up = np.linspace(0, amplitude, steps)[1:]
    down, again = np.linspace(amplitude, -amplitude, steps)[1:], np.linspace(-amplitude, amplitude, steps)[1:]
    return np.concatenate([up, down, again, down, again])


def test_one_element_follows_masing() -> None:
    """Between reversals at -A and A the force is clip(-T + k (x + A), -T, T): a loop of area 4 T (A - T/k)."""
    amplitude = 0.01
    memory, forces, strains = FRICTION.initial_memory, [], cycle(amplitude, 401)
    for x in strains:
        answer = FRICTION.respond(np.array([x]), memory)
        memory = answer.memory
        forces.append(answer.force[0])
    last = slice(strains.size - 400, None)
    expected = np.clip(-350 + FRICTION.stiffness * (strains[last] + amplitude), -350, 350)
    np.testing.assert_allclose(forces[last], expected, atol=1e-9)
    first, second = strains.size - 800, strains.size
    x, f = strains[first - 1 : second], np.array(forces[first - 1 : second])
    area = np.sum(0.5 * (f[1:] + f[:-1]) * np.diff(x))
    assert area == pytest.approx(4 * 350 * (amplitude - FRICTION.presliding), rel=1e-3)


@pytest.mark.parametrize("refine", [None, Refined(2)], ids=["lumped", "refined"])
def test_friction_in_the_hinges_of_a_driven_linkage(refine: Refined | None) -> None:
    """Driven along z, x free: sliding hinges take Fz = 4 T / (L cos a) with the bars at the angle a."""
    linkage = Parallelogram(LENGTH, WIDTH, BAR_P.stiffness(LENGTH), bar=refine, hinges=(FRICTION,))
    z = cycle(6.0)
    targets = np.zeros((z.size, 6))
    targets[:, 2] = z
    path = load_path(linkage, targets, ("y", "z", "rx", "ry", "rz"))
    assert np.all(path.converged)
    plateau = 4 * FRICTION.limit / (LENGTH * np.cos(np.arcsin(z[-1] / LENGTH)))
    # The bars bend a little under the torques, which changes their slope at the hinges, not the balance.
    assert path.load[-1, 2] == pytest.approx(plateau, rel=1e-4)
    half = z.size - 25
    assert path.load[half, 2] == pytest.approx(-path.load[-1, 2], rel=1e-4)
    # The work of the driving force is what the springs keep and the hinges lose.
    force, place = np.append(0.0, path.load[:, 2]), np.append(0.0, z)
    work = np.sum(0.5 * (force[1:] + force[:-1]) * np.diff(place))
    lost = np.sum(path.next_memory[-1].reshape(-1, 2)[:, 1])
    assert work == pytest.approx(lost + path.energy[-1], rel=2e-2)


def test_small_motions_do_not_slip() -> None:
    linkage = Parallelogram(LENGTH, WIDTH, paper.BAR_STIFFNESS, hinges=(FRICTION,))
    targets = np.zeros((4, 6))
    targets[:, 2] = [0.1, 0.2, 0.1, 0.0]
    path = load_path(linkage, targets, ("y", "z", "rx", "ry", "rz"))
    assert abs(path.load[-1, 2]) < 1e-6 and path.load[1, 2] > 1.0
    assert np.max(path.energy) > 0 and np.max(np.abs(path.next_memory)) < 1e-12


@fixed_seed(20)
@given(st.floats(0.5, 8.0), st.integers(0, 1000))
def test_batches_of_histories_run_side_by_side(amplitude: float, seed: int) -> None:
    linkage = Parallelogram(LENGTH, WIDTH, paper.BAR_STIFFNESS, 0.2, hinges=(FRICTION,))
    generator = np.random.default_rng(seed)
    targets = np.zeros((5, 3, 6))
    targets[..., 2] = amplitude * generator.uniform(-1, 1, (5, 3)) - LENGTH * np.sin(0.2)
    held = ("y", "z", "rx", "ry", "rz")
    batch = load_path(linkage, targets, held)
    single = load_path(linkage, targets[:, 1], held)
    np.testing.assert_allclose(batch.load[:, 1], single.load, atol=1e-6)
    again = equilibrium(linkage, targets[-1, 1], held, single.member(-1))
    # Repeating a step changes nothing: rate independent.
    np.testing.assert_allclose(again.load, single.load[-1], atol=1e-6)
