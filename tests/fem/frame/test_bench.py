"""The bench's door: what it refuses, how fine its bars are, what it needs of time."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from fem.frame.bench import Trial, run
from fem.frame.errors import Errors
from fem.frame.fibres import grid, row
from fem.frame.linkages import ELEMENTS
from fem.frame.rig import Gauge, Rig
from fem.frame.section import Section
from meshes.solid import Floats
from tests.fem.frame.rigs import BAR_P, LENGTH, ORTHOGLIDE, SLENDER, control, measure, parallelogram, steps

RIG = parallelogram()
GUIDED = ("y", "z", "rx", "ry", "rz")
ALL = ("x", *GUIDED)

# Up to 0.06 rad, 18 mm and 4 kN, near a critical load among them.
PLANS = {
    "axial, bent": (GUIDED, {"x": -4000.0, "y": 18.0, "z": 18.0, "rx": 0.06, "rz": -0.06}),
    "axial, twisted": (GUIDED, {"x": -4000.0, "y": -18.0, "z": 18.0, "rx": 0.06, "rz": -0.06}),
    "guided": (("z", "rx", "ry", "rz"), {"x": -4000.0, "y": 30.0, "z": -18.0}),
    "free": (("z",), {"x": -1000.0, "y": 3.0, "z": -18.0, "rx": 3000.0, "ry": 6e4, "rz": 1e4}),
}


@pytest.mark.parametrize("plan", PLANS)
@pytest.mark.parametrize("bar", [ORTHOGLIDE, BAR_P], ids=["Eq. 12", "P"])
def test_discretisation_is_below_the_sensors(bar: Section | Floats, plan: str) -> None:
    """The default against four times as many elements: below 0.3 µm, 5 µrad, 0.3 N."""
    held, end = PLANS[plan]
    rig = replace(RIG, bar=bar)
    effects = {"bar_initial_bow.bow_y_mm": 0.5, "bar_initial_bow.bow_z_mm": 0.5}
    values = np.linspace(0.0, 1.0, 4)[1:, None] * steps(**end)
    for degrees in (-30, 30):
        one, fine = (
            measure(rig, held, values, degrees, effects, elements=n) for n in (ELEMENTS, 4 * ELEMENTS)
        )
        assert np.abs(one.displacement - fine.displacement)[:, :3].max() < 3e-4
        assert np.abs(one.displacement - fine.displacement)[:, 3:].max() < 5e-6
        assert np.abs(one.wrench - fine.wrench)[:, :3].max() < 0.3


def bad_trial(**change: object) -> Trial:
    return replace(Trial(0.0, control(*ALL), steps(x=0.1)), **change)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("trial", "said"),
    [
        (bad_trial(control=("force",) * 5), "six"),
        (bad_trial(control=("mid",) * 6), "'mid'"),
        (bad_trial(values=np.zeros(6)), "shape"),
        (bad_trial(values=np.full((1, 6), np.nan)), "not finite"),
        (bad_trial(temperature=np.zeros(3)), "temperature"),
        (bad_trial(q=1.5), "85 degrees"),
        (bad_trial(rig=Rig("bar", LENGTH, SLENDER)), "same number of bars"),
    ],
)
def test_trials_that_are_none(trial: Trial, said: str) -> None:
    with pytest.raises(ValueError, match=said):
        run(RIG, Errors(), [bad_trial(), trial])


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"kind": "delta"}, "delta"),
        ({"base": "glued"}, "glued"),
        ({"tip": "glued"}, "glued"),
        ({"length": 0.0}, "length"),
        ({"width": -1.0}, "width"),
        ({"gravity": (0.0, 0.0, 0.0)}, "gravity"),
    ],
)
def test_rigs_that_are_none(change: dict[str, object], said: str) -> None:
    with pytest.raises(ValueError, match=said):
        replace(RIG, **change)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("values", "said"),
    [
        ({"joint_friction.torque": 1.0}, "unknown parameter"),
        ({"modulus_error.scale": 0.0}, "more than 0"),
        ({"joint_clearance.play_mm": -0.1}, "at least 0"),
        ({"mounting_tilt.rx_rad": np.inf}, "finite"),
    ],
)
def test_errors_that_are_none(values: dict[str, float], said: str) -> None:
    with pytest.raises(ValueError, match=said):
        Errors.of(values)


@pytest.mark.parametrize("effect", ["bar_length_mismatch.mismatch_mm", "bar_stiffness_asymmetry.ratio"])
def test_a_single_bar_has_no_second(effect: str) -> None:
    rig = Rig("bar", LENGTH, SLENDER)
    with pytest.raises(ValueError, match="parallelogram"):
        run(rig, Errors.of({effect: 0.9}), [Trial(0.0, control(), steps(x=1.0))])


def test_gauges_lie_on_bars() -> None:
    with pytest.raises(ValueError, match="not on a bar"):
        run(RIG, Errors(), [bad_trial()], [Gauge("far", 3, 0.5, (1.0, 0.0, 0.0))])
    with pytest.raises(ValueError, match="powers of two"):
        run(RIG, Errors(), [bad_trial()], elements=12)
    assert run(RIG, Errors(), []) == []


def test_a_trial_may_have_its_own_rig() -> None:
    short = replace(RIG, length=250.0)
    plain, other = run(RIG, Errors(), [bad_trial(), bad_trial(rig=short)])
    assert other.wrench[0, 0] / plain.wrench[0, 0] == pytest.approx(LENGTH / 250.0, rel=1e-9)


def test_fibres_carry_the_section() -> None:
    for edge_y, edge_z in ((6.0, 8.0), (3.0, 20.0)):
        y, z, w = grid(edge_y, edge_z, SLENDER.EA, SLENDER.about_y.EI, SLENDER.about_z.EI)
        assert (w > 0.0).all() and w.sum() == pytest.approx(1.0)
        assert w @ y**2 == pytest.approx(SLENDER.about_z.EI / SLENDER.EA)
        assert w @ z**2 == pytest.approx(SLENDER.about_y.EI / SLENDER.EA)
        np.testing.assert_allclose([w @ y, w @ z, w @ (y * z), y.max() - edge_y], 0.0, atol=1e-12)
    with pytest.raises(ValueError, match="outermost fibre"):
        row(2.0, 2.5)


def test_a_yielded_bar_carries_its_plastic_force() -> None:
    """Pulled to four times its yield strain: EA (limit + hardening of the rest), and as much less on the way back."""
    limit = 1e-3
    rig = replace(parallelogram(), kind="bar")
    pull = [4 * limit * LENGTH, 0.0]
    found = measure(rig, ALL, steps(x=pull), 0, {"material_yield.strain": limit})
    up = SLENDER.EA * (limit + 0.01 * 3 * limit)
    # Back by four limits: two of them elastic, two hardening the other way.
    expected = [up, up - SLENDER.EA * (2 * limit + 0.01 * 2 * limit)]
    np.testing.assert_allclose(found.wrench[:, 0], expected, rtol=1e-9)


def test_a_bar_with_rigid_ends_yields_and_stays_stable() -> None:
    """Pulled, pushed and bent to twice the yield strain; the tangent keeps what every stretch has elastically."""
    rig = parallelogram(ORTHOGLIDE)
    share = np.concatenate((np.linspace(0.0, 1.0, 7)[1:], np.linspace(1.0, -1.0, 13)[1:]))
    values = steps(x=list(-4000.0 * share), y=list(5.0 * share), z=list(15.0 * share))
    found = measure(rig, GUIDED, values, -30, {"material_yield.strain": 1e-3})
    assert found.negative.max() == 0
    elastic = measure(rig, GUIDED, values, -30)
    assert np.abs(found.wrench - elastic.wrench)[:, 1].max() > 5.0
