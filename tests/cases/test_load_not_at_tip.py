"""A bar that is loaded before its tip: superposition of beam theory, the elastica, its own weight, and what is refused.

c16: a cantilever of 20 x 0.97 x 200 mm pushed at 100 mm, with dials at 50, 100, 150 mm and at its tip.
"""

from __future__ import annotations

import json
import shutil
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import solve_bvp

from pipeline.answer.of_diagnosis import answered
from pipeline.campaign import BadCampaign, Campaign, read, write
from pipeline.campaign.gauge import Gauge
from pipeline.campaign.rigs.bar import BarRig
from pipeline.campaign.rigs.bars import UniformBar
from pipeline.compare.models import compare_models
from pipeline.export.source import Sources, exported
from pipeline.inference.frame_prediction import predict_frame
from pipeline.inference.load_cases import load_cases
from pipeline.inference.model import Model
from pipeline.inference.prediction import predict
from pipeline.inference.suitable import known_effects
from pipeline.selection.diagnosis import diagnose
from vjm.effects import catalogue
from vjm.equilibrium import equilibrium

DATA = Path(__file__).parent / "data" / "c16_load_not_at_tip"
LENGTH, EI = 200.0, 97625.6
BAR = UniformBar(EA=1.24509e6, EIy=EI, EIz=4.15031e7, GJ=146028.0)
DIALS = tuple(Gauge(f"g{x}", x / LENGTH, "z") for x in (0, 37, 50, 100, 150, 200))


def rig(at: float | None, **more: object) -> BarRig:
    return BarRig(length=LENGTH, bar=BAR, load_at=at, **more)  # type: ignore[arg-type]


def deflection(force: float, a: float, x: np.ndarray) -> np.ndarray:
    """Of a cantilever at x under a force at a: F x² (3 a - x) / (6 EI) up to there, straight beyond."""
    bent = np.minimum(x, a)
    return force * (bent**2 * (3.0 * a - bent) / 6.0 + 0.5 * a**2 * (x - bent)) / EI


@pytest.mark.parametrize("at", [30.0, 100.0, 163.7, None])
@pytest.mark.parametrize("refined", [False, True])
def test_dials_read_what_beam_theory_says(at: float | None, refined: bool) -> None:
    mechanism = rig(at).mechanism(DIALS)
    mechanism = mechanism.refined() if refined else mechanism
    # Small enough for the line to be all.
    load = np.array([0.0, 0.0, -1e-4, 0.0, 0.0, 0.0])
    state = equilibrium(mechanism, load, ())
    x = np.array([gauge.station * LENGTH for gauge in DIALS])
    expected = deflection(-1e-4, at or LENGTH, x)
    np.testing.assert_allclose(state.readings[12:], expected, rtol=1e-6, atol=1e-12)
    tip = state.readings[:6] - rig(at).nominal_pose(np.array(0.0))
    np.testing.assert_allclose(tip[2], expected[-1], rtol=1e-6)
    np.testing.assert_allclose(tip[4], 1e-4 * (at or LENGTH) ** 2 / (2.0 * EI), rtol=1e-6)


def elastica(force: float, a: float) -> tuple[float, float, float]:
    """Fall of the points at a and at the tip and way of the tip along x, of an inextensible cantilever under a dead
    force at a: EI theta'' = -F cos(theta), theta(0) = 0, theta'(a) = 0; beyond it the bar is straight."""

    def slopes(s: np.ndarray, u: np.ndarray) -> np.ndarray:
        return np.array([u[1], -force / EI * np.cos(u[0]), np.cos(u[0]), np.sin(u[0])])

    def ends(base: np.ndarray, tip: np.ndarray) -> np.ndarray:
        return np.array([base[0], tip[1], base[2], base[3]])

    s = np.linspace(0.0, a, 41)
    theta, _, x, w = solve_bvp(slopes, ends, s, np.zeros((4, s.size)), tol=1e-9).sol(a)
    left = LENGTH - a
    return float(w), float(w + left * np.sin(theta)), float(x + left * np.cos(theta) - LENGTH)


def test_a_long_way_is_that_of_the_elastica() -> None:
    """15 N at half the length: the tip falls by 95 mm and comes back by 28."""
    force, a = 15.0, 100.0
    there, tip, back = elastica(force, a)
    assert tip > 0.4 * LENGTH
    mechanism = rig(a).mechanism((Gauge("at", 0.5, "-z"),)).refined(12)
    state = equilibrium(mechanism, np.array([0.0, 0.0, -force, 0.0, 0.0, 0.0]), ())
    assert state.converged
    np.testing.assert_allclose(state.readings[12], there, rtol=1e-3)
    np.testing.assert_allclose(-state.readings[2], tip, rtol=1e-3)
    np.testing.assert_allclose(state.readings[0] - LENGTH, back, rtol=3e-3)


def test_a_tip_may_be_moved_by_a_load_elsewhere() -> None:
    """The force at 100 mm that brings the tip where it is wanted is the one that does so."""
    mechanism = rig(100.0).mechanism(()).refined()
    first = equilibrium(mechanism, np.array([0.0, 0.3, -1.0, 0.0, 0.0, 0.0]), ())
    target = np.array([0.0, *first.readings[1:3], 0.0, 0.0, 0.0])
    second = equilibrium(mechanism, target, ("y", "z"))
    np.testing.assert_allclose(second.readings[6:9], [0.0, 0.3, -1.0], atol=1e-7)


@pytest.mark.parametrize("refined", [False, True])
def test_the_piece_beyond_the_load_has_its_weight(refined: bool) -> None:
    """What it does at the load: q a² (6 L² - 4 L a + a²) / (24 EI) and its slope, of a bar under its weight alone."""
    q, a = 1e-6, 120.0
    heavy = {"gravity": (0.0, 0.0, -1.0), "line_weight": q}
    mechanism = rig(a, **heavy).mechanism((Gauge("at", a / LENGTH, "-z"),))
    state = equilibrium(mechanism.refined(24) if refined else mechanism, np.zeros(6), ())
    sag = q * a**2 * (6.0 * LENGTH**2 - 4.0 * LENGTH * a + a**2) / (24.0 * EI)
    slope = q * a * (3.0 * LENGTH**2 - 3.0 * LENGTH * a + a**2) / (6.0 * EI)
    np.testing.assert_allclose(state.readings[[12, 4]], [sag, slope], rtol=1e-5)


def test_readings_at_the_tip_have_their_slopes() -> None:
    """Newton's derivatives of a displacement beyond the load against differences, with the base on springs."""
    campaign = read(DATA)
    effect = catalogue()["base_compliance"]
    model = Model().with_effects([catalogue()["bar_geometric_nonlinearity"], effect])
    cases = load_cases(campaign)
    found = predict(model, cases)
    step = np.zeros((len(cases.test), 7))
    step[:, 2] = 1e-4
    both = [predict(model, cases, shift=sign * step).values for sign in (1.0, -1.0)]
    np.testing.assert_allclose(
        found.by_inputs[:, [2, 12, 13, 14], 2],
        ((both[0] - both[1]) / 2e-4)[:, [2, 12, 13, 14]],
        rtol=1e-5,
    )


def test_finite_elements_read_the_same(tmp_path: Path) -> None:
    """An independent code: forces along y and z at two points of one bar, dials before and beyond them."""
    campaign = _two_points(tmp_path)
    cases = load_cases(campaign)
    springs = predict(Model().with_effects([catalogue()["bar_geometric_nonlinearity"]]), cases)
    frame = predict_frame(cases, lambda: springs)
    assert not frame.lost.any()
    moved = np.abs(frame.values[:, [1, 2, 12, 13, 14]])
    np.testing.assert_allclose(
        springs.values[:, [1, 2, 12, 13, 14]], frame.values[:, [1, 2, 12, 13, 14]], atol=2e-3 * moved.max()
    )
    assert moved[-1].max() > 5.0


def _two_points(folder: Path) -> Campaign:
    text = (DATA / "campaign.toml").read_text(encoding="utf-8")
    control = text[text.index("control") :]
    more = f'\n[[tests]]\nid = "at_160"\nrole = "fit"\nrig = {{ load_at_mm = 160.0 }}\n{control}'
    (folder / "campaign.toml").write_text(text + more.replace(' z = "force"', ' z = "displacement"'))
    rows = (DATA / "measurements.csv").read_text(encoding="utf-8")
    (folder / "measurements.csv").write_text(rows + "at_160,0,0.0,,,,\nat_160,1,-6.0,,,,\n")
    return read(folder)


def test_a_test_has_its_own_point_and_is_written_with_it(tmp_path: Path) -> None:
    (tmp_path / "a").mkdir()
    campaign = _two_points(tmp_path / "a")
    write(tmp_path / "b", campaign)
    again = read(tmp_path / "b")
    assert [getattr(test.rig, "load_at", 0) for test in again.tests] == [100.0, 160.0]


def test_the_case_is_within_noise(tmp_path: Path) -> None:
    campaign = read(DATA)
    models = {model.model: model for model in compare_models(campaign).models}
    assert (models["lin"].fit or 0.0) < 1e-3 and models["vjm"].within_noise
    found = answered(diagnose(campaign, Model(), known_effects(()).effects))
    assert (found.verdict, found.effects) == ("within_noise", ())
    # As if the load were at the tip: 69 % too soft at the tip alone.
    shutil.copytree(DATA, tmp_path / "tip")
    path = tmp_path / "tip" / "campaign.toml"
    path.write_text(path.read_text(encoding="utf-8").replace("load_at_mm = 100.0\n", ""))
    assert not compare_models(read(tmp_path / "tip")).model_of("vjm").within_noise


def test_what_is_exported_is_the_whole_bar() -> None:
    (bar,) = exported(Sources(DATA)).bars
    assert bar.length == LENGTH
    assert bar.matrix[2, 2] == pytest.approx(12.0 * EI / LENGTH**3)


REFUSED = {
    "load_at_mm = 250.0": "load_at_mm is 250, a bar of 200 mm allows no more than that",
    "load_at_mm = 0.0": "allowed is: at least 0.001",
    "load_at_mm = [100.0, 5.0, 0.0]": "allowed is a point on the bar, [x, 0, 0]",
    'load_at_mm = 100.0\ntip = "guided"': "allowed with a free tip: this one is guided",
    "load_at_mm = 100.0\ngravity = [0, 0, -1]\nline_weight_N_per_mm = 0.1": "the sag of the piece beyond the load",
}


@pytest.mark.parametrize("lines", REFUSED)
def test_a_point_that_is_none_is_refused(tmp_path: Path, lines: str) -> None:
    shutil.copytree(DATA, tmp_path / "c")
    path = tmp_path / "c" / "campaign.toml"
    path.write_text(path.read_text(encoding="utf-8").replace("load_at_mm = 100.0", lines))
    with pytest.raises(BadCampaign) as caught:
        read(path.parent)
    assert REFUSED[lines] in str(caught.value)


def test_a_point_is_a_number_or_a_vector(tmp_path: Path) -> None:
    shutil.copytree(DATA, tmp_path / "c")
    path = tmp_path / "c" / "campaign.toml"
    path.write_text(path.read_text(encoding="utf-8").replace("= 100.0\n", "= [100.0, 0.0, 0.0]\n", 1))
    one, other = read(DATA).rig, read(path.parent).rig
    assert json.dumps(one.keys()) == json.dumps(other.keys())
    assert isinstance(one, BarRig) and replace(one, load_at=None).keys() == one.drawn.keys()
