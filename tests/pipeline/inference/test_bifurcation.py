"""Campaigns that press a column far beyond its critical load, against the elastica.

A pin-ended strip, shortened by up to a thousand times what its critical load shortens it: P = P_cr (1 + d / 2L), the
middle 2/pi of the root of shortening times length to one side (S. P. Timoshenko, J. M. Gere, "Theory of Elastic
Stability", 2nd ed. 1961, 2.7).
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from fem.frame import bench
from fem.frame.errors import Errors
from fem.frame.rig import STEEPEST_DEG
from pipeline.campaign import read
from pipeline.errors import InputError
from pipeline.inference import bifurcation as branches
from pipeline.inference.load_cases import LoadCases, load_cases
from pipeline.inference.model import Model
from pipeline.inference.predicted import Prediction
from pipeline.inference.prediction import predict
from tests.fem.frame.rigs import parallelogram
from vjm.bent import Ways
from vjm.effects import catalogue
from vjm.reasons import Reason

L, EA, EI = 300.0, 5e6, 416667.0
CRITICAL = np.pi**2 * EI / L**2
START = CRITICAL * L / EA
WAY = np.array([0.0, 5e-4, 1e-3, 2e-3, 2.8e-3, 0.1, 0.5, 1.0, 2.0, 3.0, 1.0, 1e-3])
"""Shortening at the steps, mm: the fifth is 2 % beyond the critical one; there and back."""
BENT = WAY > START
LOAD = np.where(BENT, CRITICAL * (1.0 + (WAY - START) / (2.0 * L)), EA / L * WAY)
MIDDLE = 2.0 / np.pi * np.sqrt(L * np.clip(WAY - START, 0.0, None))
NONLINEAR = Model().with_effects([catalogue()["bar_geometric_nonlinearity"]])
TOML = """schema = 1
name = "strip"
[rig]
kind = "bar"
base = "pinned"
tip = "pinned"
length_mm = 300.0
bar = { EA_N = 5e6, EIy_Nmm2 = 416667.0, EIz_Nmm2 = 2.6e8, GJ_Nmm2 = 1.3e6 }
[noise]
x_mm = 1e-5
fx_N = 0.2
mid_mm = 0.01
[[gauges]]
name = "mid"
bar = 1
station = 0.5
direction = "z"
[[tests]]
id = "press"
role = "fit"
control = { x = "displacement" }
"""


def campaign(folder: Path, side: float = 1.0, toml: str = TOML, count: int = len(WAY)) -> LoadCases:
    """The first rows of the test, its readings without noise, the middle gone to this side."""
    rows = zip(-WAY[:count], -LOAD[:count], side * MIDDLE[:count], strict=True)
    lines = [f"press,{k},{x:.9g},{fx:.9g},{mid:.9g}" for k, (x, fx, mid) in enumerate(rows)]
    folder.mkdir(exist_ok=True)
    (folder / "campaign.toml").write_text(toml, encoding="utf-8")
    header = "test,step,x_mm,fx_N,mid_mm"
    (folder / "measurements.csv").write_text("\n".join([header, *lines, ""]), encoding="utf-8")
    return load_cases(read(folder))


def both(folder: Path, side: float = 1.0, count: int = len(WAY)) -> tuple[LoadCases, Prediction]:
    cases = campaign(folder, side, count=count)
    return cases, predict(NONLINEAR, cases)


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_the_column_carries_on_as_the_elastica_to_the_side_of_the_gauge(tmp_path: Path, side: float) -> None:
    _, found = both(tmp_path, side)
    assert not found.lost.any()
    np.testing.assert_allclose(-found.values[:, 6], LOAD, rtol=5e-3, atol=1e-9)
    np.testing.assert_allclose(found.values[5:, 12], side * MIDDLE[5:], rtol=0.02, atol=1e-9)
    assert np.all(np.sign(found.values[BENT, 12]) == side)


def test_slopes_on_the_bent_branch_are_those_of_the_elastica(tmp_path: Path) -> None:
    """dP/dd falls from EA / L to P_cr / 2L."""
    _, found = both(tmp_path)
    np.testing.assert_allclose(found.by_inputs[5:10, 6, 0], CRITICAL / (2.0 * L), rtol=0.03)
    np.testing.assert_allclose(found.by_inputs[:4, 6, 0], EA / L, rtol=1e-6)


def test_starting_from_bent_states_gives_the_same(tmp_path: Path) -> None:
    cases, found = both(tmp_path)
    again = predict(NONLINEAR, cases, start=found)
    np.testing.assert_allclose(again.values, found.values, rtol=1e-7, atol=1e-7)


def test_rows_before_the_bifurcation_do_not_know_of_those_beyond(tmp_path: Path) -> None:
    """To the last bit: where nothing is lost nothing is done."""
    whole, few = both(tmp_path / "whole")[1], both(tmp_path / "few", count=4)[1]
    np.testing.assert_array_equal(whole.values[:4], few.values)
    np.testing.assert_array_equal(whole.by_inputs[:4], few.by_inputs)


@pytest.mark.parametrize("degrees", [STEEPEST_DEG, -STEEPEST_DEG, STEEPEST_DEG + 0.01])
def test_the_steepest_angle_is_one_for_files_and_frame(tmp_path: Path, degrees: float) -> None:
    held_z = ("force", "force", "displacement", "force", "force", "force")
    trial = bench.Trial(float(np.radians(degrees)), held_z, np.zeros((1, 6)))
    toml = TOML.replace(
        'kind = "bar"\nbase = "pinned"\ntip = "pinned"', 'kind = "parallelogram"\nwidth_mm = 80.0'
    )
    others = ", ".join(f'{name} = "force"' for name in ("y", "z", "rx", "ry", "rz"))
    toml = toml.replace('x = "displacement"', f'x = "displacement", {others}')
    toml = toml.replace('id = "press"', f'id = "press"\nq_deg = {degrees}')
    if abs(degrees) > STEEPEST_DEG:
        with pytest.raises(ValueError, match="85 degrees"):
            bench.run(parallelogram(), Errors(), [trial])
        with pytest.raises(InputError, match=r"q_deg: is 85\.01, allowed is: at most 85"):
            campaign(tmp_path, toml=toml)
    else:
        assert bench.run(parallelogram(), Errors(), [trial])[0].converged.all()
        assert campaign(tmp_path, toml=toml).campaign.tests[0].q_deg == degrees


def test_rows_without_a_branch_are_not_looked_for_again(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A fit evaluates a model many times; where the first found no branch the next would take as long in vain."""
    asked: list[float] = []

    def none(*_: object) -> Ways:
        asked.append(0.0)
        return Ways((), Reason.NO_EQUILIBRIUM)

    cases = campaign(tmp_path)
    monkeypatch.setattr(branches, "leave", none)
    first = predict(NONLINEAR, cases)
    assert len(asked) == 1 and first.lost.any()
    again = predict(NONLINEAR, cases, start=first)
    assert len(asked) == 1 and np.array_equal(again.lost, first.lost)
    monkeypatch.undo()
    assert not predict(NONLINEAR, cases).lost.any()
