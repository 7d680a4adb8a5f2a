"""A guide of two leaf springs against the closed forms of S. Awtar, A. H. Slocum, E. Sevincer, J. Mech. Des. 129 (2007)
625, and against Euler's column; y is the shift of the guide, along z here, P the tension."""

from __future__ import annotations

import time

import numpy as np
import pytest

from fem.beam import uniform_stiffness
from vjm.equilibrium import Equilibrium, equilibrium
from vjm.frames import Array
from vjm.manipulator.machine import machine
from vjm.manipulator.parts import Manipulator
from vjm.parts import Leg, elastic, leaf_pair

L, THICK, DEEP, APART, MODULUS = 50.0, 0.5, 20.0, 40.0, 2e5
EA, EI = MODULUS * THICK * DEEP, MODULUS * DEEP * THICK**3 / 12
LEAF = uniform_stiffness(L, EA, EI, EI * (DEEP / THICK) ** 2, 4 * EI / 2.6)
CRITICAL = 2 * np.pi**2 * EI / L**2
GUIDE = Manipulator("guide", (Leg("guide", (leaf_pair(elastic(L, LEAF, 4), APART),)),), L)


def held(tension: Array, shift: Array, turn: float = 0.0) -> Equilibrium:
    """States (B,) at a shift, mm, and a pitch, rad, under a tension, N."""
    targets = np.zeros((shift.size, 6))
    targets[:, 0], targets[:, 2], targets[:, 4] = tension, shift, turn
    state = equilibrium(machine(GUIDE), targets, ("z", "ry"))
    assert np.all(state.converged)
    return state


def grid(shift: float, load: float) -> tuple[Array, Array]:
    """Shifts up to a share of L and tensions to both sides up to a share of the critical load."""
    y, p = np.meshgrid(np.linspace(0.01, shift, 5) * L, np.linspace(-load, load, 5) * CRITICAL)
    return y.ravel(), p.ravel()


def test_stiffness_and_shift() -> None:
    y, p = grid(0.05, 0.25)
    state = held(p, y)
    np.testing.assert_allclose(state.load[:, 2], (24 * EI / L**3 + 1.2 * p / L) * y, rtol=5e-3)
    shift = -0.6 * y**2 / L + p * (L / (2 * EA) + y**2 * L / (1400 * EI))
    np.testing.assert_allclose(state.pose[:, 0] - L, shift, rtol=5e-3)


def test_pitch_stiffness() -> None:
    """(w²/2) / (L/EA + y² L/(700 EI)) without tension."""
    y, none = np.linspace(0.0, 0.05, 6) * L, np.zeros(6)
    expected = APART**2 / 2 / (L / EA + y**2 * L / (700 * EI))
    np.testing.assert_allclose(pitch(none, y), expected, rtol=5e-3)


def test_pitch_stiffness_under_tension() -> None:
    """The term y²/700 is the first of a series in P: it is off by 3 % at P_cr/4, Euler's column is not."""
    y, p = grid(0.05, 0.25)
    step = 1e-3 * CRITICAL
    give = L / EA - (shortening(p / 2 + step, y) - shortening(p / 2 - step, y)) / (2 * step)
    np.testing.assert_allclose(pitch(p, y), APART**2 / 2 / give, rtol=5e-3)


def pitch(tension: Array, shift: Array) -> Array:
    """N·mm/rad about the middle of the guide."""
    moment = [held(tension, shift, turn).load[:, 4] for turn in (-1e-6, 1e-6)]
    return np.asarray((moment[1] - moment[0]) / 2e-6)


def shortening(tension: Array, shift: Array) -> Array:
    """Half the integral of the slope squared of one clamped and guided column, mm."""
    k = np.sqrt(tension.astype(complex) / EI + 1e-12)
    a = k * L / 2
    slope = shift / (L * (1 - np.tanh(a) / a))
    inside = L - 4 * np.tanh(a) / k + (L / 2 + np.sinh(2 * a) / (2 * k)) / np.cosh(a) ** 2
    return np.asarray(np.real(slope**2 * inside / 2))


def test_stability_functions() -> None:
    """Of Euler's column, to 0.8 of the critical load at y = 2 % of L."""
    p = np.array([-0.8, -0.6, -0.4, -0.2, 0.2, 0.4, 0.6, 0.8]) * CRITICAL
    y = np.full(p.size, 0.02 * L)
    a = 0.5 * L * np.sqrt((p / 2).astype(complex) / EI)
    exact = np.real(p / (L * (1 - np.tanh(a) / a)))
    np.testing.assert_allclose(held(p, y).load[:, 2], exact * y, rtol=2e-3)


def test_critical_load() -> None:
    """The stiffness along y is gone at 2 π² EI/L²."""
    p = np.array([-0.999, -1.001]) * CRITICAL
    force = held(p, np.full(2, 1e-4 * L)).load[:, 2]
    assert force[0] > 0 > force[1]


@pytest.mark.parametrize("driven", [True, pytest.param(False, marks=pytest.mark.long)])
def test_many_load_cases_are_solved(driven: bool) -> None:
    """3 000 to 10 % of L and 0.8 P_cr; driven to a shift, or under the force that makes it."""
    generator = np.random.default_rng(7)
    p, y = generator.uniform(-0.8, 0.8, 3000) * CRITICAL, generator.uniform(-0.1, 0.1, 3000) * L
    targets = np.zeros((3000, 6))
    targets[:, 0], targets[:, 2] = p, y if driven else (24 * EI / L**3 + 1.2 * p / L) * y
    start = time.perf_counter()
    state = equilibrium(machine(GUIDE), targets, ("z", "ry") if driven else ())
    assert np.all(state.converged) and np.max(np.abs(state.pose[:, 2])) > 0.09 * L
    print(f"{3000 / (time.perf_counter() - start):.0f} load cases a second")
