"""Implicit derivatives against solving again; gauges against the rigid link and the bent bar."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from fem.beam import uniform_stiffness
from tests.vjm.beams import BAR_P
from tests.vjm.load_paths import load_path
from tests.vjm.strategies import LENGTH, WIDTH
from vjm import paper
from vjm.effects.joint_friction import Jenkins
from vjm.equilibrium import Equilibrium, equilibrium
from vjm.laws import Polynomial
from vjm.mechanism import Mechanism
from vjm.mechanisms.assembly import GaugeAt
from vjm.mechanisms.bar import Bar
from vjm.mechanisms.parallelogram import Parallelogram
from vjm.refined import Refined
from vjm.sensitivity import Direction, by_parameters, by_targets

HELD = ("x", "z", "ry")
MODELS = {
    "lumped": Parallelogram(LENGTH, WIDTH, paper.BAR_STIFFNESS, 0.3),
    "refined": Parallelogram(LENGTH, WIDTH, paper.BAR_STIFFNESS, 0.3, bar=Refined(3)),
    "hinge law": Parallelogram(
        LENGTH, WIDTH, paper.BAR_STIFFNESS, 0.3, bar=Refined(2), hinges=(Polynomial((300.0, 0.0, 9e3)),)
    ),
}


def targets_of(mechanism: Mechanism) -> np.ndarray:
    """Two mixed cases, in compression and in tension; far enough to be nonlinear."""
    motion = [[-0.01, 0, 0.5, 0, 1e-4, 0], [0.05, 0, -6.0, 0, 0, 0]]
    load = [[0, 30.0, 0, 800.0, 0, -900.0], [0, -60.0, 0, 500.0, 0, 2000.0]]
    held = np.array([name in HELD for name in ("x", "y", "z", "rx", "ry", "rz")])
    return np.where(held, mechanism.unloaded_pose + np.array(motion), np.array(load))


def outputs(state: Equilibrium) -> np.ndarray:
    return np.concatenate([state.pose, state.load], axis=-1)


def difference(solve: Callable[[float], np.ndarray], value: float, step: float) -> np.ndarray:
    """Central difference of fourth order of what is solved again."""
    far, near = (solve(value + s * step) - solve(value - s * step) for s in (2, 1))
    return (8 * near - far) / (12 * step)


def assert_close(found: np.ndarray, expected: np.ndarray, state: Equilibrium, size: float) -> None:
    """Shifts, turns, forces and moments, each to 1e-6 of the largest derivative of its kind.

    Added is what rounding in a solved output, 1e-10 of it, does to a difference over a hundredth of `size`.
    """
    for part in (slice(0, 3), slice(3, 6), slice(6, 9), slice(9, 12)):
        rounding = 1e-7 * np.max(np.abs(outputs(state)[..., part])) / size
        limit = 1e-6 * np.max(np.abs(expected[..., part])) + rounding
        np.testing.assert_allclose(found[..., part], expected[..., part], rtol=0, atol=limit)


@pytest.mark.parametrize("name", MODELS)
def test_derivatives_by_the_targets(name: str) -> None:
    mechanism = MODELS[name]
    targets = targets_of(mechanism)
    state = equilibrium(mechanism, targets, HELD)
    assert np.all(state.converged)
    found = by_targets(state)
    for k, size in enumerate([2e-2, 10.0, 1e-1, 1e3, 1e-4, 1e3]):
        unit = np.eye(6)[k]

        def solve(shift: float, unit: np.ndarray = unit) -> np.ndarray:
            return outputs(equilibrium(mechanism, targets + shift * unit, HELD, state))

        expected = difference(solve, 0.0, 0.02 * size)
        assert_close(np.concatenate([found.pose, found.load], axis=-2)[..., k], expected, state, size)


def scaled_entry(i: int, j: int) -> Callable[[Parallelogram, float], Parallelogram]:
    def change(linkage: Parallelogram, p: float) -> Parallelogram:
        k = linkage.bar_stiffness.copy()
        k[i, j] *= p
        k[j, i] = k[i, j]
        return replace(linkage, bar_stiffness=k)

    return change


PARAMETERS: dict[str, tuple[Callable[[Parallelogram, float], Parallelogram], float, float]] = {
    "K22": (scaled_entry(1, 1), 1.0, 0.1),
    "K35": (scaled_entry(2, 4), 1.0, 0.1),
    "length": (lambda m, p: replace(m, length=p), LENGTH, 10.0),
    "width": (lambda m, p: replace(m, width=p), WIDTH, 5.0),
    "q": (lambda m, p: replace(m, q=p), 0.3, 0.1),
}


@pytest.mark.parametrize(
    ("name", "parameter"),
    [
        # Each number of one model, and two of each of the others.
        pytest.param(name, it, marks=[] if name == "lumped" or it in ("K35", "q") else pytest.mark.long)
        for name in MODELS
        for it in PARAMETERS
    ],
)
def test_derivatives_by_parameters_of_the_chains(name: str, parameter: str) -> None:
    """Held coordinates are displacements from the unloaded pose, which moves with length and q."""
    base = MODELS[name]
    change, value, size = PARAMETERS[parameter]

    def build(p: float) -> Parallelogram:
        return replace(change(base, p), gauge_at=(GaugeAt(2, 0.7, (0.0, 1.0, 0.0)),))

    def solve(p: float) -> Equilibrium:
        return equilibrium(build(p), targets_of(build(p)), HELD)

    state = solve(value)
    assert np.all(state.converged)
    slope = difference(lambda p: targets_of(build(p)), value, 1e-2 * size)
    found = by_parameters(state, [Direction(build, value, size)], slope[..., None])
    expected = difference(lambda p: outputs(solve(p)), value, 0.02 * size)
    assert_close(np.concatenate([found.pose, found.load], axis=-2)[..., 0], expected, state, size)
    again = difference(lambda p: solve(p).readings[..., 12], value, 0.02 * size)
    limit = 1e-6 * np.max(np.abs(again)) + 1e-8 * np.max(np.abs(state.readings[..., 12])) / size
    np.testing.assert_allclose(found.readings[..., 12, 0], again, rtol=0, atol=limit)


def test_derivatives_pass_through_a_history_with_friction() -> None:
    """d/dT after sliding and turning back: the memory's own derivative is handed from step to step."""

    def build(limit: float) -> Parallelogram:
        return replace(MODELS["lumped"], q=0.0, hinges=(Jenkins(limit, 2e-3),))

    z = np.array([2.0, 4.0, 3.7, 3.5])
    targets = np.zeros((4, 6))
    targets[:, 2] = z
    held = ("y", "z", "rx", "ry", "rz")
    state, memory = None, np.zeros(1)
    for target in targets:
        state = equilibrium(build(350.0), target, held, state)
        past = memory[:, None] if memory.size > 1 else 0.0
        found = by_parameters(state, [Direction(build, 350.0, 350.0)], memory_slope=past)
        memory = found.memory[:, 0]
    assert state is not None
    expected = difference(lambda p: outputs(load_path(build(p), targets, held).member(-1)), 350.0, 0.5)
    assert_close(np.concatenate([found.pose, found.load], axis=-2)[..., 0], expected, state, 1.0)
    # Turned back by half a millimetre the hinges stick and still carry a part of the limit.
    assert abs(expected[8]) > 1e-4


@pytest.mark.parametrize("place", ["base", "middle"])
def test_a_lumped_bar_is_straight_beside_a_spring_that_is_not_at_its_tip(place: str) -> None:
    linkage = replace(MODELS["lumped"], spring_at=place)
    state = equilibrium(linkage, targets_of(linkage), HELD)
    after = [linkage.gauge(1, s, (0.0, 0.0, 1.0)).reading(state) for s in (0.6, 0.8, 1.0)]
    np.testing.assert_allclose(after[1] - after[0], after[2] - after[1], atol=1e-9)


@pytest.mark.parametrize("station", [0.0, 0.13, 0.5, 0.77, 0.999])
@pytest.mark.parametrize("load", [(0.0, 1e-3, 0.0), (0.0, 0.0, -2e-3), (0.5, 0.0, 0.0)])
def test_a_point_of_a_lumped_bar_bends_as_a_uniform_beam(
    station: float, load: tuple[float, float, float]
) -> None:
    """F (3 L x² - x³) / (6 EI) under a force, M x² / (2 EI) under a moment at the tip, N x / EA along."""
    beam = Bar(200.0, uniform_stiffness(200.0, 1e6, 3e7, 5e6, 2e6))
    x = 200.0 * station
    moment = np.array([0.0, 0.04, -0.02])
    state = equilibrium(beam, np.concatenate([load, moment]), ())
    read = [beam.gauge(station, axis).reading(state) for axis in np.eye(3).tolist()]
    cubic = (600.0 * x**2 - x**3) / 6.0
    expected = [
        load[0] * x / 1e6,
        (load[1] * cubic + moment[2] * x**2 / 2.0) / 5e6,
        (load[2] * cubic - moment[1] * x**2 / 2.0) / 3e7,
    ]
    np.testing.assert_allclose(read, expected, rtol=1e-6, atol=1e-12)


@pytest.mark.parametrize("segments", [1, 2, 3, 8])
@pytest.mark.parametrize("station", [0.0, 0.13, 0.5, 0.77, 1.0])
def test_gauges_read_the_cubic_of_a_bent_cantilever(segments: int, station: float) -> None:
    """Force F across the tip: F (3 L x² - x³) / (6 EI) and F x / GA at x, in both planes."""
    bar = Bar(LENGTH, BAR_P.stiffness(LENGTH), bar=Refined(segments))
    force, x = 1e-3, station * LENGTH
    cases = [((0.0, 1.0, 0.0), 1, BAR_P.ei_z, BAR_P.ga_y), ((0.0, 0.0, 1.0), 2, BAR_P.ei_y, BAR_P.ga_z)]
    for direction, across, ei, ga in cases:
        state = equilibrium(bar, force * np.eye(6)[across], ())
        expected = force * ((3 * LENGTH * x**2 - x**3) / (6 * ei) + x / ga)
        assert bar.gauge(station, direction).reading(state) == pytest.approx(expected, rel=1e-6, abs=1e-12)


def test_gauges_at_the_tip_follow_the_platform() -> None:
    linkage = MODELS["refined"]
    state = equilibrium(linkage, linkage.unloaded_pose + np.array([0, 2.0, 1.0, 0, 0, 0]))
    assert np.isclose(linkage.gauge(1, 1.0, (0.0, 1.0, 0.0)).reading(state), 2.0)
    for wrong in ({"bar": 3}, {"station": 1.2}, {"direction": (1.0, 1.0, 0.0)}):
        with pytest.raises(ValueError, match=r"bar must be|station lies|length 1"):
            linkage.gauge(**({"bar": 1, "station": 0.5, "direction": (0.0, 1.0, 0.0)} | wrong))
