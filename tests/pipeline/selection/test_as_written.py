"""What is left with the rig exactly as it is written stands beside what is left within its tolerances."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from pipeline.answer.of_diagnosis import answered
from pipeline.inference.model import Model
from pipeline.selection.diagnosis import diagnose
from tests.pipeline.selection.strip import FY, GIVE, Y, strip
from vjm.effects import catalogue

FORCE = np.array([0.0, 1.0, 2.0, 3.0, 4.0, 3.0, 2.0, 1.0])


@pytest.mark.parametrize("modulus", [210e3, 204e3])
def test_it_is_the_misfit_of_the_drawing(tmp_path: Path, modulus: float) -> None:
    """A strip of 200 GPa; the closed form of what a cantilever of the modulus that is written leaves."""
    y = FORCE * GIVE / 200e3 + np.random.default_rng(0).normal(0.0, Y, FORCE.size)
    answer = answered(diagnose(strip(tmp_path, modulus, FORCE, y), Model(), catalogue()))
    sigma = np.hypot(Y, FY * GIVE / modulus)
    left = np.sqrt(np.mean(((y - FORCE * GIVE / modulus) / sigma) ** 2))
    assert answer.as_written == pytest.approx(left, rel=0.02)
    assert answer.as_written is not None and answer.as_written > 1.5 * answer.error[0].fit
    said = [it for it in answer.sentences if "exactly as it is written" in it]
    assert len(said) == 1 and f"{answer.as_written:.3g} sigma" in said[0]
