"""Columns and parallelograms beyond their critical load, pressed by a prescribed displacement, against the elastica.

S. P. Timoshenko, J. M. Gere, "Theory of Elastic Stability", 2nd ed. 1961, 2.7: an inextensible pin-ended column,
shortened by d beyond its critical load, carries P = P_cr (1 + d / 2L) to first order. Columns that are clamped or
guided, or free at an end, are made of halves or quarters of it and carry the same share more.
"""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from tests.vjm.beams import BAR_P
from vjm import bent
from vjm.bent import along, leave
from vjm.effects.bar_initial_bow import BarInitialBow
from vjm.effects.base import Rig
from vjm.equilibrium import Equilibrium, drive_values, equilibrium, unloaded
from vjm.frames import Array
from vjm.mechanisms.bar import Bar
from vjm.mechanisms.parallelogram import Parallelogram
from vjm.problem import channel_numbers

L, EA = 200.0, 5e6
HELD = {"pinned": ("x", "y", "z", "rx", "ry", "rz"), "guided": ("x", "rx", "ry", "rz"), "free": ("x",)}
STRIP, ROUND, DEEP = (4.2e5, 2.6e8), (4e6, 4e6), (2.6e8, 4.2e5)
"""EI about y and z, N·mm²: bends in z, in any direction, in y."""


def column(bending: tuple[float, float], base: str, tip: str, length: float = L) -> Bar:
    EIy, EIz = bending
    across = 12 * np.array([EIz, EIy]) / length**3
    k = np.diag([EA / length, *across, 1.3e6 / length, 4 * EIy / length, 4 * EIz / length])
    k[1, 5] = k[5, 1] = -6 * EIz / length**2
    k[2, 4] = k[4, 2] = 6 * EIy / length**2
    return Bar(length, k, base=base, tip=tip).refined()  # type: ignore[arg-type]


def beyond(rig: Rig, held: tuple[str, ...], way: Array) -> list[Equilibrium]:
    """States (S,) on every branch, pressed by `way` (S,), mm, along x."""
    targets = np.zeros((way.size, 6))
    mask = np.array([name in held for name in ("x", "y", "z", "rx", "ry", "rz")])
    targets[:, mask] = rig.unloaded_pose[mask]
    targets[:, 0] -= way
    channels, drives = channel_numbers(held), drive_values(rig, None)
    ways = leave(unloaded(rig), targets[0], channels, drives)
    every = np.broadcast_to(channels, targets.shape), np.broadcast_to(drives, (way.size, drives.size))
    return [along(side, targets, *every) for side in ways.sides]


@pytest.mark.parametrize("length", [L, pytest.param(900.0, marks=pytest.mark.long)])
@pytest.mark.parametrize(
    ("bending", "base", "tip", "factor"),
    [
        (STRIP, "pinned", "pinned", 1.0),
        (STRIP, "clamped", "free", 0.25),
        (STRIP, "clamped", "guided", 1.0),
        (DEEP, "clamped", "guided", 1.0),
        (ROUND, "clamped", "free", 0.25),
        (ROUND, "pinned", "pinned", 1.0),
    ],
)
def test_columns_carry_on_as_the_elastica(
    bending: tuple[float, float], base: str, tip: str, factor: float, length: float
) -> None:
    """From just beyond the critical load to thirty times its shortening; both sides alike and stable."""
    critical = factor * np.pi**2 * min(bending) / length**2
    start = critical * length / EA
    way = start * np.array([1.003, 1.1, 2.0, 10.0, 30.0])
    found = beyond(column(bending, base, tip, length), HELD[tip], way)
    whole = [state for state in found if state.converged.all() and (state.unstable == 0).all()]
    assert len(whole) >= 2
    expected = critical * (1.0 + (way - start) / (2.0 * length))
    for state in whole:
        # Six segments, and the shortening by the load itself.
        np.testing.assert_allclose(-state.load[:, 0], expected, rtol=1.5e-3)
    if tip != "pinned":
        sideways = [np.max(np.abs(state.pose[:, 1:3]), axis=1) for state in whole]
        # y = a (1 - cos(pi x / L)) / 2, or a (1 - cos(pi x / 2L)): the chord is shorter by a² pi² / (16 L).
        np.testing.assert_allclose(sideways[0][-1], sideways[1][-1], rtol=1e-6)
        assert sideways[0][-1] == pytest.approx(4.0 / np.pi * np.sqrt((way[-1] - start) * length), rel=0.01)


@pytest.mark.parametrize("q", [pytest.param(0.0, marks=pytest.mark.long), 30.0])
@pytest.mark.parametrize(
    ("held", "load", "slope"),
    [
        (("x", "z", "rx", "ry", "rz"), {0.0: 9937.0, 30.0: 8604.0}, {0.0: 16.1, 30.0: 3.93}),
        (("x", "z"), {0.0: 2489.0, 30.0: 2196.0}, {0.0: 4.03, 30.0: 1.416}),
    ],
)
def test_parallelograms_as_two_independent_programs(
    held: tuple[str, ...], load: dict[float, float], slope: dict[float, float], q: float
) -> None:
    """OpenSees and exudyn, bars with shear, extrapolated to their bifurcation."""
    rig = Parallelogram(310.0, 80.0, BAR_P.stiffness(310.0), np.radians(q)).refined()
    stiff = {0.0: 43896.0, 30.0: 32921.0}[q]
    way = load[q] / stiff + np.array([0.01, 0.4, 0.8])
    found = beyond(rig, held, way)
    assert len(found) == 2
    for state in found:
        assert state.converged.all() and (state.unstable == 0).all()
        np.testing.assert_allclose(-state.load[:, 0], load[q] + slope[q] * (way - way[0]), rtol=1.5e-3)


def test_a_bow_leads_to_its_own_side() -> None:
    """It has no bifurcation; where steps are too long for Newton's method the path is followed all the same."""
    straight, way = column(STRIP, "clamped", "free"), np.array([0.5, 2.0])
    plain = beyond(straight, HELD["free"], way)
    for bow in (0.02, -0.02):
        rig = BarInitialBow().apply(straight, {"bow_y_mm": 0.0, "bow_z_mm": bow})
        (state,) = beyond(rig, HELD["free"], way)
        assert state.converged.all() and (state.unstable == 0).all()
        # A tip that goes down bends a bar upwards in its middle.
        assert np.sign(state.pose[1, 2]) == -np.sign(bow)
        np.testing.assert_allclose(state.load[:, 0], plain[0].load[:, 0], rtol=5e-3)


def test_a_straight_path_that_stays_stable_is_left_alone() -> None:
    rig = column(STRIP, "pinned", "pinned")
    way = np.array([0.5]) * np.pi**2 * STRIP[0] / L**2 * L / EA
    (state,) = beyond(rig, HELD["pinned"], way)
    plain = equilibrium(rig, rig.unloaded_pose - [way[0], 0, 0, 0, 0, 0])
    np.testing.assert_allclose(state.load[0], plain.load, atol=1e-9)


def test_a_way_without_any_state_is_not_halved_to_the_last_float(monkeypatch: pytest.MonkeyPatch) -> None:
    """Half of the way at a time, twenty times down to a millionth of it, and to one part in ten thousand from there."""
    asked: list[float] = []

    def never(*arguments: object) -> Equilibrium:
        asked.append(1.0)
        return replace(unloaded(rig), converged=np.asarray(False))

    rig = column(STRIP, "pinned", "pinned")
    monkeypatch.setattr(bent, "nearby", never)
    beyond(rig, HELD["pinned"], np.array([0.5]))
    assert 0 < len(asked) <= 35 * bent.ROUNDS


@pytest.mark.parametrize("rest", [1.0, np.nan])
@pytest.mark.parametrize("least", [-1e-9, -1.0, np.nan])
def test_a_state_without_eigenvalues_stays_as_unstable_as_it_was(
    monkeypatch: pytest.MonkeyPatch, rest: float, least: float
) -> None:
    """A law may have no tangent at rest, or where the state is."""
    rig = column(STRIP, "pinned", "pinned")
    state = replace(unloaded(rig), unstable=np.array(1)).reshaped(1)
    found = iter([rest, least])
    monkeypatch.setattr(
        bent, "reduced_modes", lambda *_: SimpleNamespace(values=np.array([next(found), 2.0]))
    )
    zero = rest == 1.0 and least == -1e-9
    assert bent.neutral_is_stable(state).unstable.tolist() == [0 if zero else 1]
