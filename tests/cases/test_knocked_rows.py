"""A clamped bar, two dials and a load cell, a row or two of them knocked: the cell is named, and the verdict is that
without it. The truth is the beam's closed form; the clamp may turn."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from pipeline.answer.of_diagnosis import answered
from pipeline.answer.record import Answer
from pipeline.campaign import Campaign, read
from pipeline.inference.fit import unfitted
from pipeline.inference.load_cases import load_cases
from pipeline.inference.model import Model
from pipeline.selection.adequacy.bad_readings import bad_readings
from pipeline.selection.criteria import CRITERIA
from pipeline.selection.diagnosis import diagnose
from vjm.effects import catalogue

LENGTH, E, INERTIA = 300.0, 210e3, 20.0 * 12.0**3 / 12.0
TURN = 5e-8
"""rad/(N·mm) of a clamp that gives."""
CAMPAIGN = """schema = 1
name = "two dials"
[rig]
kind = "bar"
length_mm = 300.0
section = { kind = "rectangle", width_mm = 12.0, height_mm = 20.0 }
material = { E_MPa = 210000.0, nu = 0.3 }
base = "clamped"
tip = "free"
[noise]
y_mm = 0.002
mid_mm = 0.002
fy_N = 0.1
[tolerance]
bar = { EA = 0.02, EIy = 0.02, EIz = 0.02, GJ = 0.02, ends = "exact" }
[[gauges]]
name = "mid"
on = "bar"
bar = 1
station = 0.5
direction = "y"
[file]
path = "r.csv"
[columns]
"load" = { is = "fy", unit = "N" }
"tip" = { is = "y", unit = "mm" }
"mid" = { is = "mid", unit = "mm" }
[[tests]]
id = "test-1"
role = "fit"
control = { x = "force", y = "force", z = "force", rx = "force", ry = "force", rz = "force" }
"""


def loads(rows: int) -> np.ndarray:
    """Up to 200 N and back."""
    up = np.linspace(0.0, 200.0, (rows + 1) // 2)
    return np.concatenate([up, up[-2::-1]])


def measured(
    folder: Path, force: np.ndarray, turn: float, knocked: dict[int, float], seed: int = 3
) -> Campaign:
    """knocked: mm by which the dial at the tip is off in a row."""
    noise = np.random.default_rng(seed)
    moment, half = force * LENGTH, LENGTH / 2.0
    tip = moment * LENGTH**2 / (3.0 * E * INERTIA) + turn * moment * LENGTH
    mid = force * half**2 * (3.0 * LENGTH - half) / (6.0 * E * INERTIA) + turn * moment * half
    tip, mid = (each + noise.normal(0.0, 0.002, force.size) for each in (tip, mid))
    read_force = force + noise.normal(0.0, 0.1, force.size)
    for row, off in knocked.items():
        tip[row] += off
    rows = [f"{f:.4f},{t:.5f},{m:.5f}" for f, t, m in zip(read_force, tip, mid, strict=True)]
    (folder / "r.csv").write_text("\n".join(["load,tip,mid", *rows]) + "\n")
    (folder / "campaign.toml").write_text(CAMPAIGN)
    return read(folder)


def diagnosed(
    folder: Path, force: np.ndarray, turn: float, knocked: dict[int, float], seed: int = 3
) -> Answer:
    return answered(diagnose(measured(folder, force, turn, knocked, seed), Model(), catalogue()))


def aside(it: Answer) -> list[tuple[str, int]]:
    return [(each.column, each.step) for each in it.set_aside]


@pytest.mark.parametrize(("rows", "row"), [(7, 2), (7, 4), (13, 4)])
def test_one_knocked_row_of_few_is_named(rows: int, row: int, tmp_path: Path) -> None:
    found = diagnosed(tmp_path, loads(rows), 0.0, {row: 0.08})
    assert aside(found) == [("y_mm", row)] and found.verdict == "within_noise", found.sentences


@pytest.mark.parametrize(("rows", "row"), [(7, 4), pytest.param(13, 4, marks=pytest.mark.long)])
def test_one_knocked_row_of_few_hides_no_effect(rows: int, row: int, tmp_path: Path) -> None:
    found = diagnosed(tmp_path, loads(rows), TURN, {row: 0.08})
    assert aside(found) == [("y_mm", row)], found.sentences
    assert found.verdict == "identified" and found.effects == ("base_compliance",), found.sentences


def test_what_is_off_at_the_greatest_load_of_few_rows_may_be_a_law(tmp_path: Path) -> None:
    """The row before the load turns back, and rows of which there are no others at greater loads."""
    for force, row in ((loads(7), 3), (loads(7), 1), (np.array([0.0, 50.0, 100.0, 150.0, 200.0]), 3)):
        found = unfitted(Model(), load_cases(measured(tmp_path, force, 0.0, {row: 0.08})))
        assert not bad_readings(found, CRITERIA)
    again = unfitted(Model(), load_cases(measured(tmp_path, loads(7), 0.0, {2: 0.08})))
    assert [each.step for each in bad_readings(again, CRITERIA)] == [2]


@pytest.mark.parametrize("seed", range(4))
def test_of_right_rows_none_is_set_aside(seed: int, tmp_path: Path) -> None:
    assert not aside(diagnosed(tmp_path, loads(7), TURN * (seed % 2), {}, seed))
