"""The virtual bench of whole manipulators: springs explain it to the noise, and what was hidden is found again."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

from pipeline.assessment.virtual.manipulator import NAMES, NOISE, STEPS, measure_manipulator, plan
from pipeline.campaign import Campaign, read
from pipeline.cli import app
from pipeline.errors import InputError
from pipeline.inference.fit import fit
from pipeline.inference.linear_prediction import predict_linear
from pipeline.inference.load_cases import load_cases
from pipeline.inference.model import Model
from pipeline.inference.prediction import predict
from tests.pipeline.inference.manipulators import rig
from vjm.effects import catalogue

HIDDEN = {"axis_flexibility": {"radial_mm_per_N": 4e-5, "tilt_rad_per_Nmm": 0.0}}


def measured(hidden: dict[str, dict[str, float]], weight: float = 0.0) -> Campaign:
    """Two postures."""
    own = rig(weight)
    assert own.manipulator is not None
    return measure_manipulator("bench", own, plan(own.manipulator, np.zeros(6))[:12], hidden, 11)


def test_the_plan_loads_every_axis_at_four_postures() -> None:
    own = rig()
    assert own.manipulator is not None
    tests = plan(own.manipulator, np.array([5.0, 0.0, 0.0, 0.0, 0.0, 0.0]))
    assert len(tests) == 4 * len(NAMES) and tests[0].point == (5.0, 0.0, 0.0)
    assert {t.role for t in tests} == {"fit", "holdout"}
    for k, one in enumerate(tests[:6]):
        assert one.loads.shape == (STEPS, 6) and np.flatnonzero(
            np.any(one.loads != 0.0, axis=0)
        ).tolist() == [k]
        assert one.loads[:, k].min() == -one.loads[:, k].max()


def test_noise_is_all_that_springs_do_not_explain() -> None:
    """144 rows of six readings, each with the noise of its sensor and that of the six loads, which moves the platform;
    the mean square of as many unit normals lies within four of its deviations of one."""
    cases = load_cases(measured({}, weight=30.0))
    for prediction in (predict(Model(), cases, slopes=False), predict_linear(cases)):
        of_loads = np.sum((prediction.by_inputs[:, :6] * cases.input_sigma[:, None]) ** 2, axis=-1)
        left = (cases.measured - prediction.values)[:, :6] / np.sqrt(NOISE.displacement**2 + of_loads)
        assert abs(np.mean(left**2) - 1.0) < 4.0 * np.sqrt(2.0 / left.size)


def test_what_was_hidden_is_fitted() -> None:
    cases = load_cases(measured(HIDDEN))
    found = fit(Model().with_effects([catalogue()["axis_flexibility"]]), cases)
    radial = found.model.values[0]
    assert radial == pytest.approx(4e-5, rel=0.1)
    assert predict(Model(), cases).values.shape == cases.measured.shape


@pytest.mark.parametrize(
    ("hidden", "said"),
    [
        ({"joint_friction": {"torque_Nmm": 100.0, "presliding_rad": 1e-3}}, "joint_friction does not show"),
        ({"bar_geometric_nonlinearity": {}}, "stiffen or soften under load"),
        ({"dimension_error": {"length_mm": 0.1, "width_mm": 0.0}}, "dimension_error.length_mm does not show"),
        ({"self_weight": {"line_N_per_mm": 0.01}}, r"self_weight.line_z_N_per_mm does not show"),
    ],
)
def test_what_the_frame_cannot_have_is_refused(hidden: dict[str, dict[str, float]], said: str) -> None:
    with pytest.raises(InputError, match=said):
        measured(hidden)


def test_the_command_writes_a_campaign_and_seals_the_answer(tmp_path: Path) -> None:
    arguments = [
        "simulate",
        str(tmp_path / "c"),
        "--manipulator",
        "orthoglide",
        "--effect",
        "modulus_error=0.8",
    ]
    ran = CliRunner().invoke(app, [*arguments, "--seed", "3"])
    assert ran.exit_code == 0, ran.output
    assert "0.8" not in ran.output
    answer = json.loads((tmp_path / "c.sealed.json").read_text())
    assert answer["parameters"] == {"modulus_error.scale": 0.8}
    campaign = read(tmp_path / "c")
    assert campaign.rig.kind == "manipulator" and len(campaign.tests) == 24
    again = CliRunner().invoke(app, [*arguments, "--seed", "3"])
    assert again.exit_code == 2 and "exists" in again.output
