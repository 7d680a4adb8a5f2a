"""The whole run on the coarse mesh, as `make proofs` does it on the working one: nearly the same K_b."""

import json
from collections.abc import Callable
from pathlib import Path

import numpy as np

from pipeline.validation.entries import eight_entries
from tests.conftest import Done
from tests.pipeline.validation.test_default_run import REGRESSION


def test_a_coarse_run_ends_with_a_result_and_a_page(
    pipeline_command: Callable[..., Done], tmp_path: Path
) -> None:
    done = pipeline_command("run", "--coarse", cwd=tmp_path)
    assert done.code == 0, done.err
    (found,) = tmp_path.rglob("result.json")
    result = json.loads(found.read_text())
    entries = eight_entries(np.array(result["bar"]["stiffness"]))
    np.testing.assert_allclose(entries, list(REGRESSION.values()), rtol=0.03)
    assert result["curves"] and (found.parent / "index.html").stat().st_size > 10_000
    assert result["bar"]["laws"]["asymmetry"] < 1e-9
