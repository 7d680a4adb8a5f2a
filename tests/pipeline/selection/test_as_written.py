"""What is left with the rig exactly as it is written stands beside what is left within its tolerances."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from pipeline.answer.of_diagnosis import answered
from pipeline.campaign import read
from pipeline.inference.model import Model
from pipeline.selection.diagnosis import diagnose
from vjm.effects import catalogue

STRIP = """schema = 1
name = "strip"
[rig]
kind = "bar"
length_mm = 250.0
section = {{ kind = "rectangle", width_mm = 4.0, height_mm = 20.0 }}
material = {{ E_MPa = {modulus}, nu = 0.3 }}
base = "clamped"
tip = "free"
[noise]
y_mm = 0.005
fy_N = 0.01
[[tests]]
id = "t"
role = "fit"
control = {{ x = "force", y = "force", z = "force", rx = "force", ry = "force", rz = "force" }}
"""
FORCE = np.array([0.0, 1.0, 2.0, 3.0, 4.0, 3.0, 2.0, 1.0])
GIVE = 250.0**3 / (3.0 * 20.0 * 4.0**3 / 12.0)
"""mm·MPa/N at the tip of a cantilever 4 x 20 mm, 250 mm long."""


@pytest.mark.parametrize("modulus", [210e3, 204e3])
def test_it_is_the_misfit_of_the_drawing(tmp_path: Path, modulus: float) -> None:
    """A strip of 200 GPa; the closed form of what a cantilever of the modulus that is written leaves."""
    y = FORCE * GIVE / 200e3 + np.random.default_rng(0).normal(0.0, 0.005, FORCE.size)
    rows = [f"t,{k},{fy},{value:.5f}" for k, (fy, value) in enumerate(zip(FORCE, y, strict=True))]
    (tmp_path / "measurements.csv").write_text("\n".join(["test,step,fy_N,y_mm", *rows]) + "\n")
    (tmp_path / "campaign.toml").write_text(STRIP.format(modulus=modulus))
    answer = answered(diagnose(read(tmp_path), Model(), catalogue()))
    sigma = np.hypot(0.005, 0.01 * GIVE / modulus)
    left = np.sqrt(np.mean(((y - FORCE * GIVE / modulus) / sigma) ** 2))
    assert answer.as_written == pytest.approx(left, rel=0.02)
    assert answer.as_written is not None and answer.as_written > 1.5 * answer.error[0].fit
    said = [it for it in answer.sentences if "exactly as it is written" in it]
    assert len(said) == 1 and f"{answer.as_written:.3g} sigma" in said[0]
