"""Sensors: their slopes, what each of them reads, and controls that prescribe readings."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from tests.vjm.load_paths import load_path
from tests.vjm.strategies import LENGTH, WIDTH
from vjm import paper
from vjm.effects.joint_friction import Jenkins
from vjm.equilibrium import equilibrium
from vjm.frames import adjoint, exp, log
from vjm.mechanisms.assembly import GaugeAt
from vjm.mechanisms.parallelogram import Parallelogram
from vjm.sensitivity import Direction, DriveDirection, SensorDirection, by_parameters, by_targets
from vjm.sensors import BaseSpring, CellOffset, CellTurn, Channels, DeadWeight, Sensor, TrueMoment, through
from vjm.stiffness import unloaded_stiffness

COMPLIANCE = np.diag([2e-5, 3e-5, 1e-5, 2e-8, 1e-8, 3e-8])
SENSORS: list[Sensor] = [
    TrueMoment(),
    BaseSpring(COMPLIANCE),
    DeadWeight(np.array([1.0, -2.0, -9.0])),
    CellOffset(np.array([3.0, -2.0, 5.0])),
    CellTurn(np.array([0.02, -0.03, 0.01])),
]
LINKAGE = Parallelogram(LENGTH, WIDTH, paper.BAR_STIFFNESS, 0.3)


@pytest.mark.parametrize("chosen", [SENSORS[k : k + 1] for k in range(5)] + [SENSORS])
def test_slopes_are_derivatives(chosen: list[Sensor]) -> None:
    generator = np.random.default_rng(1)
    size = np.repeat([50.0, 0.3, 3e3, 5e4], 3)
    channels = generator.uniform(-1, 1, (4, 12)) * size
    channels[:, 0] += LENGTH
    found = through(tuple(chosen), channels).slope
    for k in range(12):
        step = 1e-5 * size[k] * np.eye(12)[k]
        plus, minus = (through(tuple(chosen), channels + s * step).values for s in (1, -1))
        expected = (plus - minus) / (2e-5 * size[k])
        # Rounding of the largest channel over the step.
        limit = 1e-7 * np.abs(expected).max(axis=0) + 1e-10 * size / size[k]
        assert np.all(np.abs(found[..., k] - expected) < limit)


class Doubled:
    """A cell of one's own that reads twice the force along x, its slope given as an array."""

    stage = 5

    def read(self, channels: np.ndarray) -> Channels:
        scale = np.where(np.arange(12) == 6, 2.0, 1.0)
        return Channels(scale * channels, np.broadcast_to(np.diag(scale), (*channels.shape, 12)))


def test_a_sensor_of_ones_own_may_give_its_slope_as_it_is() -> None:
    chosen: tuple[Sensor, ...] = (TrueMoment(), Doubled())
    targets = LINKAGE.unloaded_pose * [0, 1, 1, 1, 1, 1] + [-800.0, 0, 0, 0, 0, 0]
    held = ("y", "z", "rx", "ry", "rz")
    state = equilibrium(replace(LINKAGE, sensors=chosen), targets, held)
    half = equilibrium(LINKAGE, targets - [-400.0, 0, 0, 0, 0, 0], held)
    assert state.converged
    np.testing.assert_allclose(state.pose, half.pose, rtol=0, atol=1e-10)
    slope = by_targets(state).pose[0, 0], by_targets(half).pose[0, 0]
    assert slope[0] == pytest.approx(0.5 * slope[1], rel=1e-8)


def test_sensors_apply_by_stage_and_not_by_order() -> None:
    channels = np.random.default_rng(2).normal(size=12)
    np.testing.assert_array_equal(
        through(tuple(SENSORS), channels).values, through(tuple(SENSORS[::-1]), channels).values
    )


def test_a_base_on_springs_stands_in_series() -> None:
    """For small loads the compliances add up, that of the base moved to the platform."""
    linkage = replace(LINKAGE, sensors=(TrueMoment(), BaseSpring(COMPLIANCE)))
    moved = adjoint(LINKAGE.unloaded_pose[:3])
    back = np.linalg.inv(moved)
    flexible = unloaded_stiffness(LINKAGE)
    # With z held, what is free of it has a compliance; z itself is a mechanism.
    state = equilibrium(linkage, linkage.unloaded_pose + 1e-6 * np.array([1.0, 2.0, 0.0, 0.01, 0.02, -0.01]))
    assert state.converged
    load = state.readings[6:12]
    pose = state.readings[:6] - linkage.unloaded_pose
    inner = pose - back @ COMPLIANCE @ back.T @ load
    np.testing.assert_allclose(flexible @ inner, load, rtol=1e-5, atol=1e-9)


def test_a_turned_cell_reads_the_true_wrench_turned() -> None:
    turn = np.array([0.02, -0.03, 0.01])
    linkage = replace(LINKAGE, sensors=(TrueMoment(), CellTurn(turn), CellOffset(np.array([4.0, 1.0, -2.0]))))
    held = ("x", "z", "ry")
    targets = np.where(np.isin(np.arange(6), (0, 2, 4)), LINKAGE.unloaded_pose, 0.0)
    targets = targets + [-0.05, 12.0, 0.0, 30.0, 1e-5, -50.0]
    state = equilibrium(linkage, targets, held)
    assert state.converged and state.unstable == 0
    wrench, back = state.wrench, exp(turn).T
    moment = back @ (wrench[3:] - np.cross([4.0, 1.0, -2.0], wrench[:3]))
    np.testing.assert_allclose(state.readings[6:9], back @ wrench[:3], rtol=1e-10)
    np.testing.assert_allclose(state.readings[9:12], moment, rtol=1e-10)
    np.testing.assert_allclose(state.readings[[7, 9, 11]], [12.0, 30.0, -50.0], atol=1e-7)


def test_weight_on_the_platform_is_carried_and_not_read() -> None:
    weight = np.array([0.0, 15.0, 0.0])
    held = ("x", "z", "rx", "ry", "rz")
    targets = np.where(np.array([1, 0, 1, 1, 1, 1], dtype=bool), LINKAGE.unloaded_pose, 0.0)
    hung = equilibrium(replace(LINKAGE, sensors=(TrueMoment(), DeadWeight(weight))), targets, held)
    pulled = equilibrium(LINKAGE, targets + [0, 15.0, 0, 0, 0, 0], held)
    np.testing.assert_allclose(hung.pose, pulled.pose, atol=1e-10)
    np.testing.assert_allclose(hung.readings[7], 0.0, atol=1e-9)


@pytest.mark.parametrize("refined", [False, True])
def test_a_gauge_takes_the_place_of_a_coordinate(refined: bool) -> None:
    """The load that brings a gauge somewhere, from the reading that this load gives."""
    linkage = replace(LINKAGE, gauge_at=(GaugeAt(1, 0.5, (0.0, 1.0, 0.0)),), sensors=(TrueMoment(),))
    linkage = linkage.refined(3) if refined else replace(linkage, spring_at="base")
    held = ("x", "z", "rx", "ry", "rz")
    mask = np.array([1, 0, 1, 1, 1, 1], dtype=bool)
    targets = np.where(mask, linkage.unloaded_pose, 0.0) + [-0.02, 25.0, 0.0, 0.0, 0.0, 0.0]
    there = equilibrium(linkage, targets, held)
    reading = float(there.readings[12])
    assert abs(reading) > 1e-3
    control = np.array([0, 12, 2, 3, 4, 5])
    back = equilibrium(linkage, targets + [0.0, reading - 25.0, 0.0, 0.0, 0.0, 0.0], control)
    assert back.converged and back.unstable == 0
    # Rounding of 1e-13 of the largest moment of a chain.
    np.testing.assert_allclose(back.readings, there.readings, rtol=1e-8, atol=1e-6)
    slope = by_targets(back).readings
    assert slope[7, 1] == pytest.approx(1 / by_targets(there).readings[12, 1], rel=1e-7)
    with pytest.raises(ValueError, match="controlled by channel"):
        equilibrium(linkage, targets, np.array([0, 13, 2, 3, 4, 5]))


@pytest.mark.parametrize("refined", [False, True])
def test_a_gauge_on_the_platform_reads_its_point_and_may_hold_a_turn(refined: bool) -> None:
    """d . (shift + (R - 1) a) of the platform as read, on a base that gives; as a control the turn that leads there."""
    arm, along = (30.0, -20.0, 45.0), (0.0, 0.6, 0.8)
    gauges = (GaugeAt(1, 0.0, along, arm),)
    linkage = replace(LINKAGE, gauge_at=gauges, sensors=(TrueMoment(), BaseSpring(COMPLIANCE)))
    linkage = linkage.refined(3) if refined else replace(linkage, spring_at="base")
    held = np.array([True, True, True, False, False, True])
    targets = np.where(held, linkage.unloaded_pose, 0.0) + [-0.02, 0.4, 0.1, 900.0, 800.0, 0.01]
    there = equilibrium(linkage, targets, tuple(np.array(["x", "y", "z", "rx", "ry", "rz"])[held]))
    moved = there.readings[:3] - linkage.unloaded_pose[:3] + (exp(there.readings[3:6]) - np.eye(3)) @ arm
    assert there.converged and np.linalg.norm(there.readings[3:6]) > 5e-3
    np.testing.assert_allclose(there.readings[12], moved @ along, rtol=1e-9)
    control = np.array([0, 1, 2, 12, 10, 5])
    again = targets + [0.0, 0.0, 0.0, there.readings[12] - targets[3], 0.0, 0.0]
    back = equilibrium(linkage, again, control)
    assert back.converged
    np.testing.assert_allclose(back.readings, there.readings, rtol=1e-7, atol=1e-6)
    slope = by_targets(back).readings
    assert slope[9, 3] == pytest.approx(1.0 / by_targets(there).readings[12, 3], rel=1e-7)


def test_unstable_directions_are_counted_under_any_control() -> None:
    """Past the guided critical load with y free, stable again with a gauge that holds y."""
    linkage = replace(LINKAGE, q=0.0, gauge_at=(GaugeAt(1, 0.5, (0.0, 1.0, 0.0)),)).refined(4)
    targets = linkage.unloaded_pose + [-0.45, 0.0, 0.0, 0.0, 0.0, 0.0]
    free = np.where([False, True] + [False] * 4, 0.0, targets)
    for sensors in ((), (TrueMoment(),)):
        it = replace(linkage, sensors=sensors)
        path = load_path(
            it,
            np.linspace(it.unloaded_pose * [1, 0, 1, 1, 1, 1], free, 8),
            ("x", "z", "rx", "ry", "rz"),
            follow=True,
        )
        assert path.converged[-1] and path.unstable[-1] == 1
        held = equilibrium(it, targets, np.array([0, 12, 2, 3, 4, 5]))
        assert held.converged and held.unstable == 0
        np.testing.assert_allclose(held.load[0], path.load[-1, 0], rtol=1e-8)


def test_a_base_turned_by_a_known_load_moves_the_platform() -> None:
    """The rotation of the base is carried to the platform as a rigid turn about the base origin."""
    sensor = BaseSpring(np.diag([0, 0, 0, 0, 1e-6, 0.0]))
    channels = np.array([LENGTH, 0.0, 0.0, 0.0, 0.1, 0.0, 0.0, 0.0, -40.0, 0.0, 500.0, 0.0])
    turn = np.array([0.0, 1e-6 * (500.0 + 40.0 * LENGTH), 0.0])
    found = through((sensor,), channels).values
    np.testing.assert_allclose(found[:3], exp(turn) @ channels[:3], rtol=1e-12)
    np.testing.assert_allclose(found[3:6], log(exp(turn) @ exp(channels[3:6])), rtol=1e-12)
    np.testing.assert_allclose(found[6:9], exp(turn) @ channels[6:9], rtol=1e-12)


def test_derivative_by_an_input() -> None:
    linkage = replace(LINKAGE, sensors=(TrueMoment(),)).altered(
        lambda _, it: replace(it, elongation=(("temperature_rise", 0.0072),))
    )
    held = ("x", "y", "z")
    targets = linkage.unloaded_pose * [1, 1, 1, 0, 0, 0] + [-0.02, 0.3, 0.1, 20.0, 100.0, 30.0]
    rise = np.array([0.0, 4.0])
    state = equilibrium(linkage, targets, held, drives={"temperature_rise": rise})
    found = by_parameters(state, [DriveDirection("temperature_rise", 1.0)])
    plus, minus = (
        equilibrium(linkage, targets, held, drives={"temperature_rise": rise + s}).readings
        for s in (0.1, -0.1)
    )
    expected = (plus - minus) / 0.2
    np.testing.assert_allclose(
        found.readings[..., 0], expected, rtol=1e-5, atol=1e-6 * np.abs(expected).max()
    )


@pytest.mark.parametrize("order", [1, 2, 4])
@pytest.mark.parametrize("sticking", [False, True])
def test_what_only_sensors_change_has_the_same_derivative(order: int, sticking: bool) -> None:
    """By a number of each sensor: the linkage built again, and read again. With friction a memory moves too."""
    hinges = (Jenkins(3e3, 0.1),) if sticking else ()
    linkage = replace(LINKAGE, hinges=hinges, gauge_at=(GaugeAt(1, 0.5, (0.0, 1.0, 0.0)),))

    def sensors(k: int, p: float) -> tuple[Sensor, ...]:
        other: dict[int, Sensor] = {
            1: BaseSpring(p * COMPLIANCE),
            2: DeadWeight(p * np.array([1.0, -2.0, -9.0])),
            3: CellOffset(p * np.array([3.0, -2.0, 5.0])),
            4: CellTurn(p * np.array([0.02, -0.03, 0.01])),
        }
        return (*SENSORS[:k], other[k], *SENSORS[k + 1 :])

    held = ("x", "z", "ry")
    mask = np.isin(np.arange(6), (0, 2, 4))
    targets = np.where(mask, linkage.unloaded_pose, 0.0) + [-0.05, 12.0, 3.0, 30.0, 1e-5, -50.0]
    state = equilibrium(replace(linkage, sensors=tuple(SENSORS)), targets, held)
    assert state.converged and (state.memory.shape[-1] > 0) == sticking
    built = [Direction(lambda p, k=k: replace(linkage, sensors=sensors(k, p)), 1.0, 0.1) for k in range(1, 5)]
    reread = [SensorDirection(lambda p, k=k: sensors(k, p), 1.0, 0.1) for k in range(1, 5)]
    slope = np.random.default_rng(3).normal(size=(state.memory.shape[-1], 4)) * 1e-3
    found, expected = (
        by_parameters(state, each, memory_slope=slope, order=order) for each in (reread, built)
    )
    for name in ("unknowns", "memory", "readings"):
        one, other = getattr(found, name), getattr(expected, name)
        np.testing.assert_allclose(one, other, rtol=0, atol=1e-7 * np.abs(other).max(initial=0.0))
    assert np.all(np.any(found.readings != 0.0, axis=0))
