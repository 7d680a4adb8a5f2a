"""The whole run on coarse meshes, as `make proofs` does it on the working one too."""

import json
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from pipeline.validation.entries import eight_entries
from tests.conftest import Done
from tests.pipeline.validation.test_default_run import REGRESSION

E_MPA, NU, LENGTH = 70e3, 0.33, 120.0
SQUARE = f"""schema = 1
name = "square"
title = "A square bar"
[material]
E_MPa = {E_MPA}
nu = {NU}
[linkage]
length_mm = {LENGTH}
width_mm = 40.0
angles_deg = [30.0]
[bar]
section = {{ kind = "rectangle", width_mm = 10.0, height_mm = 10.0 }}
[mesh]
size_mm = 20.0
"""


def test_a_run_of_ones_own_case_ends_with_a_result_and_a_page(
    pipeline_command: Callable[..., Done], tmp_path: Path
) -> None:
    """Every stage, on few cells; K_b of a Timoshenko bar: shear area 5/6, torsion constant 0.1406 of the side."""
    (tmp_path / "square.toml").write_text(SQUARE)
    done = pipeline_command("run", "square.toml", "--coarse", cwd=tmp_path)
    assert done.code == 0, done.err
    (found,) = tmp_path.rglob("result.json")
    result = json.loads(found.read_text())
    shear, inertia = E_MPA / (2.0 * (1.0 + NU)), 10.0**4 / 12.0
    phi = 12.0 * E_MPA * inertia / (shear * 100.0 * 5.0 / 6.0 * LENGTH**2)
    side = 12.0 * E_MPA * inertia / (LENGTH**3 * (1.0 + phi))
    turn = (4.0 + phi) * E_MPA * inertia / (LENGTH * (1.0 + phi))
    k = np.array(result["bar"]["convergence"]["extrapolated"])
    expected = [
        E_MPA * 100.0 / LENGTH,
        side,
        -side * LENGTH / 2.0,
        side,
        side * LENGTH / 2.0,
        0.1406 * 10.0**4 * shear / LENGTH,
        turn,
        turn,
    ]
    np.testing.assert_allclose(eight_entries(k), expected, rtol=0.05)
    assert result["curves"] and result["buckling"] and result["refinement"]
    assert (found.parent / "index.html").stat().st_size > 10_000
    assert result["bar"]["laws"]["asymmetry"] < 1e-9


@pytest.mark.long
def test_a_coarse_run_ends_with_a_result_and_a_page(
    pipeline_command: Callable[..., Done], tmp_path: Path
) -> None:
    """Nearly the same K_b as on the working mesh."""
    done = pipeline_command("run", "--coarse", cwd=tmp_path)
    assert done.code == 0, done.err
    (found,) = tmp_path.rglob("result.json")
    result = json.loads(found.read_text())
    entries = eight_entries(np.array(result["bar"]["stiffness"]))
    np.testing.assert_allclose(entries, list(REGRESSION.values()), rtol=0.03)
    assert result["curves"] and (found.parent / "index.html").stat().st_size > 10_000
    assert result["bar"]["laws"]["asymmetry"] < 1e-9
