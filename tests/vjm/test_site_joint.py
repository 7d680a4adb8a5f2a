"""Axes at sites: with linear laws they are the compliances that other models have there; without one they carry the
load and move the readings as a law's displacement would."""

from dataclasses import replace
from functools import partial

import numpy as np
import pytest

from vjm.effects.base import for_bars
from vjm.equilibrium import Equilibrium, equilibrium
from vjm.frames import POSE_NAMES
from vjm.laws import Linear
from vjm.mechanisms.assembly import GaugeAt
from vjm.mechanisms.bar import Bar
from vjm.mechanisms.parallelogram import Parallelogram
from vjm.paper import BAR_STIFFNESS, LENGTH, WIDTH
from vjm.sensitivity import DriveDirection, by_parameters
from vjm.sensors import BaseSpring, TrueMoment
from vjm.site_joint import SiteJoint
from vjm.site_loads import carried

LOADS = np.array([[200.0, 10.0, 0.0, 500.0, 0.0, 800.0], [-300.0, 5.0, 0.0, -300.0, 0.0, 900.0]])
HELD = ("z", "ry")
RADIAL, TILT = 3e-6, 2e-8


def linkage(q: float = 0.4) -> Parallelogram:
    return Parallelogram(LENGTH, WIDTH, BAR_STIFFNESS, q=q, sensors=(TrueMoment(),))


def loaded(mechanism: Parallelogram, held: tuple[str, ...] = HELD, share: float = 1.0) -> Equilibrium:
    targets = share * LOADS
    for k, name in enumerate(POSE_NAMES):
        if name in held:
            targets[:, k] = mechanism.unloaded_pose[k]
    state = equilibrium(mechanism, targets, held)
    assert state.converged.all()
    return state


def spring(axis: int, compliance: float) -> SiteJoint:
    return SiteJoint(axis, Linear(np.array([[1.0 / compliance]])))


def test_springs_along_axes_at_the_ends_of_bars_are_the_compliance_there() -> None:
    gives = np.diag([RADIAL, 0.0, RADIAL, TILT, 0.0, TILT])
    joints = (spring(0, RADIAL), spring(2, RADIAL), spring(3, TILT), spring(5, TILT))
    small = partial(loaded, share=1e-2)
    by_matrix = small(for_bars(linkage(), lambda bar: replace(bar, base_give=gives, tip_give=gives)))
    by_joints = small(for_bars(linkage(), lambda bar: replace(bar, base_joints=joints, tip_joints=joints)))
    # Beyond small loads they differ: a compliance that is moved to the tip does not turn the bar about its base.
    seen = [0, 1, 3, 5]
    change = np.abs(by_matrix.readings - small(linkage()).readings).max(axis=0)[seen]
    off = np.abs(by_joints.readings - by_matrix.readings).max(axis=0)[seen]
    assert (off <= 3e-3 * change).all()
    assert (change > 1e-7).all()


@pytest.mark.parametrize("axis", range(6))
def test_a_base_body_on_a_spring_is_the_base_on_that_spring(axis: int) -> None:
    compliance = np.zeros((6, 6))
    compliance[axis, axis] = 1e-6 if axis < 3 else 1e-10
    by_sensor = loaded(replace(linkage(), sensors=(TrueMoment(), BaseSpring(compliance))))
    by_joint = loaded(replace(linkage(), base_joints=(spring(axis, compliance[axis, axis]),)))
    plain = loaded(linkage())
    change = np.abs(by_sensor.readings - plain.readings).max(axis=0)
    assert len(by_joint.mechanism.chains) == 1
    assert (np.abs(by_joint.readings - by_sensor.readings).max(axis=0) <= 1e-3 * change + 1e-7).all()
    assert change.max() > 1e-6


def test_a_base_body_on_a_nearly_rigid_spring_changes_nothing() -> None:
    stiff = replace(linkage(), base_joints=(spring(0, 1e-13),))
    assert loaded(stiff).readings == pytest.approx(loaded(linkage()).readings, rel=1e-6, abs=1e-7)


def test_gauges_are_the_same_in_one_leg_of_both_bars() -> None:
    places = (
        GaugeAt(1, 0.5, (0.0, 1.0, 0.0)),
        GaugeAt(2, 1.0, (0.0, 0.0, 1.0)),
        GaugeAt(1, 1.0, (1.0, 0.0, 0.0), (5.0, 2.0, 1.0)),
    )
    there = replace(linkage(), gauge_at=places)
    stiff = replace(there, base_joints=(spring(1, 1e-13),))
    assert loaded(stiff).readings == pytest.approx(loaded(there).readings, rel=1e-6, abs=1e-7)


@pytest.mark.parametrize(
    ("axis", "end"), [(0, "base"), (0, "tip"), (1, "base"), (1, "tip"), (3, "tip"), (5, "base")]
)
def test_readings_move_by_influence_times_compliance_times_load(axis: int, end: str) -> None:
    opened = for_bars(
        linkage(), lambda bar: replace(bar, **{f"{end}_joints": (SiteJoint(axis, None, "site"),)})
    )
    state = loaded(opened)
    size = 1e-2 if axis < 3 else 1e-4
    influence = by_parameters(state, [DriveDirection("site", size)], order=2).readings[..., 0]
    compliance = 1e-8 if axis < 3 else 1e-11
    sprung = loaded(
        for_bars(linkage(), lambda bar: replace(bar, **{f"{end}_joints": (spring(axis, compliance),)}))
    )
    slope = (sprung.readings - loaded(linkage()).readings) / compliance
    # Both bars take the same input here; each gives by the load through it.
    loads = [
        sum(carried(state, c) @ drive.slope for drive in chain.drives if drive.name == "site")
        for c, chain in enumerate(state.mechanism.chains)
    ]
    single = [
        by_parameters(loaded(one_bar(axis, end, bar)), [DriveDirection("site", size)], order=2).readings[
            ..., 0
        ]
        for bar in range(2)
    ]
    assert sum(single) == pytest.approx(influence, rel=1e-6, abs=1e-9 * np.abs(influence).max())
    told = sum(load[:, None] * one for load, one in zip(loads, single, strict=True))
    assert told == pytest.approx(slope, rel=2e-3, abs=2e-3 * np.abs(slope).max())


def one_bar(axis: int, end: str, bar: int) -> Parallelogram:
    joint = (SiteJoint(axis, None, "site"),)
    return for_bars(linkage(), lambda link: replace(link, **{f"{end}_joints": joint}), bar)


@pytest.mark.parametrize("axis", range(6))
def test_the_load_through_the_base_balances_the_platform(axis: int) -> None:
    opened = replace(linkage(), base_joints=(SiteJoint(axis, None, "site"),))
    state = loaded(opened)
    load = sum(
        carried(state, c) @ drive.slope
        for c, chain in enumerate(opened.chains)
        for drive in chain.drives
        if drive.name == "site"
    )
    pose, wrench = state.readings[:, :6], state.readings[:, 6:12]
    moments = wrench[:, 3:] + np.cross(pose[:, :3], wrench[:, :3])
    there = np.concatenate([wrench[:, :3], moments], axis=1)[:, axis]
    assert load == pytest.approx(there, rel=1e-6, abs=1e-6 * np.abs(wrench).max())


def test_a_site_that_is_rigid_changes_nothing() -> None:
    names = [SiteJoint(axis, None, f"s{axis}") for axis in (0, 1, 2, 3, 5)]
    opened = for_bars(
        replace(linkage(), base_joints=(SiteJoint(4, None, "b"),)),
        lambda bar: replace(bar, base_joints=tuple(names), tip_joints=tuple(names)),
    )
    assert loaded(opened).readings == pytest.approx(loaded(linkage()).readings, rel=1e-9, abs=1e-9)


def test_a_clamped_bar_on_a_base_that_gives() -> None:
    # A cantilever on a rotary spring: its tip goes down by F L^3 / 3EI + F L^2 c, small.
    c, load = 1e-9, 2.0
    bar = Bar(LENGTH, BAR_STIFFNESS, base_joints=(spring(4, c),))
    targets = np.array([[0.0, 0.0, load, 0.0, 0.0, 0.0]])
    sprung, plain = (equilibrium(each, targets, ()) for each in (bar, Bar(LENGTH, BAR_STIFFNESS)))
    more = sprung.readings[0, 2] - plain.readings[0, 2]
    assert more == pytest.approx(load * LENGTH**2 * c, rel=1e-5)
