"""Hinges of a parallelogram with bars of different lengths are relaxed where it stands when it has been put together.

The figures are those of an independent frame program: a uniform bar of the paper's stiffness, 0.97 of its modulus,
0.08 mm of mismatch, 250 N·mm of friction with 2e-4 rad before slip, 13 333 N·mm about y in the first step.
"""

from __future__ import annotations

import numpy as np
import pytest

from fem.frame import bench
from fem.frame.errors import Errors
from fem.frame.rig import Rig as FrameRig
from tests.vjm.load_paths import load_path
from vjm import lagrangian, paper
from vjm.effects import catalogue
from vjm.effects.base import Rig
from vjm.equilibrium import Equilibrium, drive_values
from vjm.frames import Array
from vjm.history import by_history
from vjm.mechanism import initial_memory
from vjm.mechanisms.assembled import FourBar
from vjm.mechanisms.assembly import GaugeAt
from vjm.mechanisms.parallelogram import Parallelogram
from vjm.sensitivity import Direction
from vjm.sensors import TrueMoment

L, D = paper.LENGTH, paper.WIDTH
EA, EI_Y, EI_Z, GJ = 6.82e6, 1.98e8, 4.51e7, 1.08e7
SCALE, MISMATCH, TORQUE, PRESLIDING = 0.97, 0.08, 250.0, 2e-4
MY = np.array([13333.0, 26666.0, 40000.0, 0.0])
EFFECTS = catalogue()
ANGLES = (0.0, 0.5, -0.5)


def uniform() -> Array:
    """(6, 6) of the uniform bar at its tip."""
    k = np.diag([EA / L, 12 * EI_Z / L**3, 12 * EI_Y / L**3, GJ / L, 4 * EI_Y / L, 4 * EI_Z / L])
    k[1, 5] = k[5, 1] = -6 * EI_Z / L**2
    k[2, 4] = k[4, 2] = 6 * EI_Y / L**2
    return k


def rig(mismatch: float = MISMATCH, q: float = 0.0, spring: float = 0.0, torque: float = TORQUE) -> Rig:
    """Refined springs with mismatch, friction and, if asked for, hinge springs."""
    gauge = GaugeAt(1, 0.5, (0.0, 0.0, 1.0))
    out: Rig = Parallelogram(L, D, uniform(), q, sensors=(TrueMoment(),), gauge_at=(gauge,)).refined()
    for name, values in {
        "modulus_error": {"scale": SCALE},
        "bar_length_mismatch": {"mismatch_mm": mismatch},
        "joint_friction": {"torque_Nmm": torque, "presliding_rad": PRESLIDING},
        "joint_torsional_stiffness": {"stiffness_Nmm_per_rad": spring},
    }.items():
        out = EFFECTS[name].apply(out, values)
    return out


def turned(about_y: Array, mechanism: Rig) -> Equilibrium:
    """Moments about y, z held."""
    targets = np.zeros((len(about_y), 6))
    targets[:, 2], targets[:, 4] = mechanism.unloaded_pose[2], about_y
    found = load_path(mechanism, targets, ("z",))
    assert found.converged.all()
    return found


def sticking() -> tuple[float, float]:
    """(fz of the first step, fz with both tips slipping), N, of straight beams between elastic hinges.

    End turns of a bar are L / (6 EI) (2 M - M') of the moments there; with k = T / presliding the tip hinge carries
    M_t = k (phi - turn), the base hinge M_b = -k turn, and the platform my = EA d² / (2 L) phi + 2 M_t.
    """
    c, k = L / (6 * SCALE * EI_Y), TORQUE / PRESLIDING
    share = k * c / (1 + 2 * k * c)
    tip = k / (1 + 2 * k * c - k * c * share)
    phi = MY[0] / (SCALE * EA * D**2 / (2 * L) + 2 * tip)
    return 2 * (1 + share) * tip * phi / L, 2 * (1 + share) * TORQUE / L


def test_the_first_steps_are_those_of_straight_beams_and_of_an_independent_program() -> None:
    found = turned(MY, rig()).readings[:, 8]
    np.testing.assert_allclose(found[:2], sticking(), rtol=5e-4)
    np.testing.assert_allclose(found[:2], [1.154, 1.938], rtol=2e-3)


@pytest.mark.parametrize("q", ANGLES)
@pytest.mark.parametrize("other", ["none", "bar_initial_bow", "mounting_tilt", "dimension_error"])
def test_springs_and_frame_elements_agree(q: float, other: str) -> None:
    """Loops of friction with hinge springs, there and back; relaxed as drawn, fz would be off by a newton or three."""
    mechanism, more = rig(q=q, spring=2e5), {}
    if other != "none":
        mechanism = EFFECTS[other].apply(mechanism, EFFECTS[other].typicals)
        more = {f"{other}.{name}": value for name, value in EFFECTS[other].typicals.items()}
    errors = {
        "modulus_error.scale": SCALE,
        "bar_length_mismatch.mismatch_mm": MISMATCH,
        "joint_friction.torque_Nmm": TORQUE,
        "joint_friction.presliding_rad": PRESLIDING,
        "joint_torsional_stiffness.stiffness_Nmm_per_rad": 2e5,
    }
    values = np.zeros((len(MY), 6))
    values[:, 4] = MY
    control = ("force", "force", "displacement", "force", "force", "force")
    trial = bench.Trial(q, control, values)
    frame = bench.run(FrameRig("parallelogram", L, uniform(), D), Errors.of(errors | more), [trial])[0]
    springs = turned(MY, mechanism).readings
    np.testing.assert_allclose(springs[:, 8], frame.wrench[:, 2], atol=3e-3)
    moved = springs[:, :6] - np.append(rig(q=q).unloaded_pose[:3], np.zeros(3))
    sensors = np.array([1e-3] * 3 + [2e-5] * 3)
    np.testing.assert_allclose(moved / sensors, frame.displacement / sensors, atol=0.02)


@pytest.mark.parametrize("q", ANGLES)
def test_the_unloaded_linkage_is_put_together_from_rigid_bars(q: float) -> None:
    """Its loops close, nothing carries, the platform is turned by -m / (d cos q) and stands m / (2 cos q) further."""
    for default in (0.0, q):
        mechanism = rig(q=default)
        at = drive_values(mechanism, {"q": np.array(q)})
        rows = lagrangian.all_rows(
            mechanism, lagrangian.at_rest(mechanism, at), initial_memory(mechanism), at, second=False
        )
        assert max(np.max(np.abs(row.gap)) for row in rows) < 1e-12
        assert max(np.max(np.abs(row.balance)) for row in rows) == 0.0
    pose = lagrangian.at_rest(mechanism, at)[lagrangian.layout(mechanism).platform]
    assert pose[4] == pytest.approx(-MISMATCH / (D * np.cos(q)), rel=1e-3)
    assert pose[0] - L * np.cos(q) == pytest.approx(MISMATCH / (2 * np.cos(q)), rel=2e-3)
    # The turned platform hangs one pin by d (1 - cos ry) / 2 lower.
    assert pose[2] == pytest.approx(-L * np.sin(q), abs=1e-12)


@pytest.mark.parametrize("q", ANGLES)
def test_without_load_nothing_is_read(q: float) -> None:
    """Whatever springs and friction the hinges have, and the gauge reads zero there."""
    mechanism = rig(q=q, spring=2e5)
    found = turned(np.zeros(1), mechanism).readings[0]
    np.testing.assert_allclose(found[6:12], 0.0, atol=1e-6)
    assert found[12] == pytest.approx(0.0, abs=1e-9)


def test_equal_bars_are_not_turned_at_all() -> None:
    q = np.linspace(-1.0, 1.0, 7)
    turn, platform = FourBar((L, L), D).turned(q)
    assert not turn.any() and not platform.any()
    chains = rig(mismatch=0.0, q=0.3).chains
    assert all(drive.curve is None for chain in chains for drive in chain.drives)


def test_large_mismatches_close_the_loop() -> None:
    """By distances between pins, without the solver's own equations."""
    q, lengths = np.array([-1.0, 0.2, 0.9]), (L + 15.0, L)
    turn, platform = FourBar(lengths, D).turned(q)
    ends = []
    for k, z in enumerate((-0.5 * D, 0.5 * D)):
        angle = q + turn[:, k]
        ends.append(np.stack([lengths[k] * np.cos(angle), z - lengths[k] * np.sin(angle)]))
    across = ends[1] - ends[0]
    np.testing.assert_allclose(np.linalg.norm(across, axis=0), D, rtol=1e-13)
    np.testing.assert_allclose(np.arctan2(across[0], across[1]), platform, atol=1e-13)
    np.testing.assert_allclose(0.5 * (ends[0] + ends[1])[1], -L * np.sin(q), atol=1e-11)


@pytest.mark.parametrize("q", [0.0, 0.4])
def test_derivatives_by_the_mismatch_are_differences_of_histories(q: float) -> None:
    """The relaxed angles move with the mismatch, and with the angle of the bars, which is an input."""

    def build(value: float) -> Rig:
        return rig(value, q=0.1, spring=2e4)

    def readings(value: float) -> Equilibrium:
        mechanism = build(value)
        targets = np.zeros((len(MY), 1, 6))
        targets[..., 2] = -L * np.sin(q)
        targets[..., 4] = MY[:, None]
        return load_path(mechanism, targets, ("z",), drives={"q": np.full((len(MY), 1), q)})

    state = readings(MISMATCH)
    along = by_history(state.reshaped(1, len(MY)), [Direction(build, MISMATCH, 0.05)])
    step = 1e-4
    slope = (readings(MISMATCH + step).readings - readings(MISMATCH - step).readings) / (2 * step)
    scale = np.array([1e-3] * 3 + [1e-5] * 3 + [1.0] * 3 + [50.0] * 3 + [1e-3])
    np.testing.assert_allclose(along.readings[0, ..., 0] / scale, slope[:, 0] / scale, atol=2e-3)
    assert np.max(np.abs(slope[:, 0] / scale)) > 1.0
