"""Laws at sites of a frame: they equal the effects that are such laws, and bad sites are named."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
import pytest

from fem.frame.bench import Readings, Trial, run
from fem.frame.errors import Errors
from fem.frame.laws.forms.hysteresis import Creep
from fem.frame.laws.forms.kinked import DeadZone
from fem.frame.laws.forms.sliders import Coulomb
from fem.frame.laws.forms.smooth import Cubic, EvenPart, Linear
from fem.frame.laws.forms.wrapped import OverLoad
from fem.frame.newton import ITERATIONS
from fem.frame.placed import Placed
from fem.frame.rig import Gauge, Rig
from meshes.solid import Floats
from tests.fem.frame.law_examples import crept
from tests.fem.frame.rigs import LENGTH, SLENDER, control, parallelogram, steps

ALL_HELD = ("y", "z", "rx", "ry", "rz")
TRIALS = [
    Trial(0.0, control(*ALL_HELD), steps(x=[1500.0, 3000.0, 0.0, -3000.0])),
    Trial(0.5, control("y", "z", "rx", "rz"), steps(x=[800.0] * 4, z=[3.0, 8.0, -4.0, 0.0])),
    Trial(
        -0.4,
        control("y", "z", "rx", "ry"),
        steps(x=[500.0] * 4, y=[2.0, 4.0, -4.0, 1.0], rx=[0.0, 0.01, 0.02, 0.0]),
    ),
]
GAUGES = [Gauge("mid", 1, 0.5, (0.0, 1.0, 0.0))]
SIZES = np.array([1.0, 1.0, 1.0, 1e-3, 1e-3, 1e-3, 1e3, 1e3, 1e3, 1e5, 1e5, 1e5, 1.0])


def read(effects: Mapping[str, float], placed: Sequence[Placed] = (), rig: Rig | None = None) -> np.ndarray:
    """All readings of the trials."""
    found = run(rig or parallelogram(), Errors.of(effects), TRIALS, GAUGES, placed=placed)
    return together(found)


def together(found: Sequence[Readings]) -> np.ndarray:
    """(rows, columns) in units of the order of the readings."""
    for it in found:
        assert it.converged.all(), it.reason
    return np.concatenate([np.hstack([it.displacement, it.wrench, it.gauges]) for it in found]) / SIZES


SAME = {
    "a spring at the hinges": (
        {"joint_torsional_stiffness.stiffness_Nmm_per_rad": 3e3},
        [Placed("hinge_torque", Linear(3e3))],
    ),
    "the same, end by end": (
        {"joint_torsional_stiffness.stiffness_Nmm_per_rad": 3e3},
        [Placed(f"hinge_torque@{end}.{bar}", Linear(3e3)) for end in ("base", "tip") for bar in (1, 2)],
    ),
    "a spring at the hinges of unequal bars": (
        {
            "joint_torsional_stiffness.stiffness_Nmm_per_rad": 3e4,
            "bar_length_mismatch.mismatch_mm": 0.5,
        },
        [Placed("hinge_torque", Linear(3e4))],
    ),
    "friction of the hinges": (
        {"joint_friction.torque_Nmm": 400.0, "joint_friction.presliding_rad": 2e-3},
        [Placed("hinge_torque", Coulomb(1.0, 1.0), 400.0, 2e-3)],
    ),
    "axes give radially": (
        {"axis_flexibility.radial_mm_per_N": 2e-6},
        [Placed("along", Linear(5e5)), Placed("across", Linear(1.0), 5e5)],
    ),
    "axes give radially, in two of each": (
        {"axis_flexibility.radial_mm_per_N": 2e-6},
        [Placed(kind, Linear(1e6)) for kind in ("along", "across", "along", "across")],
    ),
    "axes tilt": (
        {"axis_flexibility.tilt_rad_per_Nmm": 1e-7},
        [Placed("tilt_x", Linear(1e7)), Placed("tilt_z", Linear(1e7))],
    ),
    "the base gives": (
        {f"base_compliance.{c}_mm_per_N": 1e-5 for c in "xyz"}
        | {f"base_compliance.r{c}_rad_per_Nmm": 1e-8 for c in "xyz"},
        [Placed(f"base_{c}", Linear(1e5)) for c in "xyz"]
        + [Placed(f"base_r{c}", Linear(1e8)) for c in "xyz"],
    ),
}
# A tilt before the hinge or after it: what differs is of the order of tilt times turn, 1e-3 of the tilt's share.
WITHIN = {"axes tilt": 2e-4}


@pytest.mark.parametrize("name", SAME)
def test_linear_laws_and_friction_are_the_effects_that_they_spell_out(name: str) -> None:
    effects, placed = SAME[name]
    known = {path: value for path, value in effects.items() if path.startswith("bar_length")}
    plain, expected, found = read(known), read(effects), read(known, placed)
    np.testing.assert_allclose(found, expected, rtol=0.0, atol=WITHIN.get(name, 1e-8))
    assert np.abs(expected - plain).max() > 1e-3


def test_a_law_of_no_force_changes_no_bit() -> None:
    without = read({"joint_friction.torque_Nmm": 300.0})
    vanishing = [Placed("hinge_torque", Linear(1.0), force=1e-300)]
    assert np.array_equal(without, read({"joint_friction.torque_Nmm": 300.0}, vanishing))
    assert np.array_equal(without, read({"joint_friction.torque_Nmm": 300.0}, ()))


def test_a_coordinate_is_the_further_part_seen_from_the_nearer_one() -> None:
    """A pull is positive at both ends; where the bar turns up at its base, the platform turns down at its tip."""
    placed = [
        Placed("along", Linear(1e6)),
        Placed("hinge_torque", Linear(10.0)),
        Placed("base_x", Linear(1e6)),
    ]
    it = run(
        parallelogram(),
        Errors(),
        [Trial(0.0, control(*ALL_HELD), steps(x=[1000.0], z=[-5.0]))],
        placed=placed,
    )[0]
    along, hinge, base = it.followed
    np.testing.assert_allclose(along.force, [[500.0] * 4], rtol=2e-3)
    np.testing.assert_allclose(along.coordinate, along.force / 1e6)
    np.testing.assert_allclose(hinge.coordinate, 5.0 / LENGTH * np.array([[1.0, -1.0, 1.0, -1.0]]), rtol=2e-3)
    # What holds the base pulls it back; its law answers where it went.
    np.testing.assert_allclose(base.force, [[1000.0]], rtol=1e-6)


def test_one_end_alone_moves_as_its_law_says() -> None:
    bar = Rig("bar", LENGTH, SLENDER, base="pinned", tip="free")
    law = EvenPart(1.0, 0.2)
    trial = Trial(0.0, control("y", "z", "rx", "ry", "rz"), steps(x=[1500.0, -1500.0]))
    (it,) = run(bar, Errors(), [trial], placed=[Placed("along@tip", law, 3000.0, 0.05)])
    q = it.displacement[:, 0] - it.wrench[:, 0] * LENGTH / SLENDER.EA
    np.testing.assert_allclose(law.curve(q / 0.05)[0], [0.5, -0.5], rtol=1e-8)


def test_a_gap_without_stiffness_to_speak_of_is_gone_through() -> None:
    """A near-rigid stop behind a gap, under a prescribed force through zero."""
    gap = DeadZone(1.0, 1e4, 1e-3)
    trial = Trial(0.2, control(*ALL_HELD), steps(x=[3000.0, -3000.0, 0.0, 2000.0]))
    (it,) = run(parallelogram(), Errors(), [trial], placed=[Placed("along@base", gap, 1e3, 0.02)])
    assert it.converged.all(), it.reason
    # Two bars, half the load each: beyond the gap by F / k.
    beyond = np.abs(it.followed[0].coordinate) - 0.02
    np.testing.assert_allclose(beyond[[0, 1, 3]], np.abs(it.followed[0].force[[0, 1, 3]]) / 5e8, atol=1e-6)
    assert np.all(np.abs(it.followed[0].force[0]) > 1000.0)


def test_a_memory_of_load_steps_does_not_see_how_the_solver_divides_them() -> None:
    """Creep at the tip, a gap at the base: passing the gap takes parts of load steps."""
    force, length = 3000.0, 0.05
    creep, gap = Placed("along@tip", Creep(0.7, 0.6, 3.0), force, length), DeadZone(1.0, 1e5, 1e-4)
    trial = Trial(0.0, control(*ALL_HELD), steps(x=[3000.0, 3000.0, -3000.0, -3000.0, 1000.0]))
    (it,) = run(
        Rig("bar", LENGTH, SLENDER), Errors(), [trial], placed=[creep, Placed("along@base", gap, 1e3, 0.2)]
    )
    assert it.converged.all(), it.reason
    # More iterations than one solution may take: a step was divided.
    assert it.iterations.max() > ITERATIONS
    expected = crept((it.followed[0].coordinate[:, 0] / length).tolist())
    np.testing.assert_allclose(it.wrench[:, 0] / force, expected, rtol=0.0, atol=1e-8)


@pytest.mark.parametrize(
    ("site", "force", "length", "values"),
    [
        ("along@tip", 3000.0, 0.02, steps(x=[3000.0, -2000.0, 500.0])),
        ("base_x", 3000.0, 0.02, steps(x=[3000.0, -2000.0, 500.0])),
        ("tilt_z@base", 6000.0, 2e-3, steps(y=[20.0, -14.0, 3.0])),
        ("base_rz", 6000.0, 2e-3, steps(y=[20.0, -14.0, 3.0])),
    ],
)
def test_a_coordinate_over_the_load_is_found_in_a_few_iterations(
    site: str, force: float, length: float, values: Floats
) -> None:
    """The cube root of a coordinate cannot be found along its own tangent: that passes zero further away each time."""
    held = ALL_HELD if values[:, 0].any() else ("z", "rx", "ry")
    placed = Placed(site, OverLoad(Cubic(1.0), 200.0), force, length)
    (it,) = run(Rig("bar", LENGTH, SLENDER), Errors(), [Trial(0.0, control(*held), values)], placed=[placed])
    assert it.converged.all(), it.reason
    assert it.iterations.max() <= 12
    share = it.followed[0].force / force
    np.testing.assert_allclose(
        it.followed[0].coordinate / length, share / 200.0 + share**3, rtol=1e-6, atol=1e-10
    )
    assert np.abs(share).max() > 0.9


BAD = {
    "along@base.3": "'3' is no part of a site",
    "along@base.tip": "'tip' is no part of a site",
    "along@": "'' is no part of a site",
    "base_x@tip": "there is one base body",
    "sideways": "there is no site 'sideways', allowed are hinge_torque, along",
}


@pytest.mark.parametrize("site", BAD)
def test_a_name_that_is_no_site_is_refused(site: str) -> None:
    with pytest.raises(ValueError, match=BAD[site]):
        Placed(site, Linear(1.0))


def test_a_site_that_the_rig_does_not_have_is_refused() -> None:
    bar = Rig("bar", LENGTH, SLENDER, base="pinned")
    trial = [Trial(0.0, control(*ALL_HELD), steps(x=[1.0]))]
    for site, said in {"along@2": "no bar 2", "hinge_torque@tip": "no hinge at its tip"}.items():
        with pytest.raises(ValueError, match=said):
            run(bar, Errors(), trial, placed=[Placed(site, Linear(1.0))])
    with pytest.raises(ValueError, match="no hinge"):
        run(Rig("bar", LENGTH, SLENDER), Errors(), trial, placed=[Placed("hinge_torque", Linear(1.0))])
    both = Errors.of({"base_compliance.x_mm_per_N": 1e-6})
    with pytest.raises(ValueError, match="the base gives along it already"):
        run(bar, both, trial, placed=[Placed("base_x", Linear(1e5))])
    with pytest.raises(ValueError, match="allowed are positive numbers"):
        Placed("along", Linear(1.0), force=-1.0)
