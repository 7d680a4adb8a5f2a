"""The shipped campaign is what its sealed answer says, and small."""

import json
from pathlib import Path

import numpy as np

from pipeline.campaign import read
from pipeline.simulate import sealed, simulate

ROOT = Path(__file__).resolve().parents[2]
FOLDER = ROOT / "examples" / "bench"


def test_the_example_is_small_and_read_without_a_remark() -> None:
    assert sum(path.stat().st_size for path in FOLDER.iterdir()) < 200_000
    campaign = read(FOLDER)
    assert campaign.remarks == () and len(campaign.tests) == 19
    assert {test.role for test in campaign.tests} == {"fit", "holdout"}


def test_the_example_can_be_measured_again(tmp_path: Path) -> None:
    """Same answer, same seed: same readings to one step of the display, where rounding may turn."""
    answer = json.loads(sealed(FOLDER).read_text())
    effects = [f"{name}={value!r}" for name, value in answer["parameters"].items()]
    assert (
        " ".join(["--effect joint_friction=800", f"--seed {answer['seed']}"])
        in (ROOT / "Makefile").read_text()
    )
    simulate(tmp_path / "bench", effects, answer["seed"], quiet=True)
    for one, other in zip(read(FOLDER).tests, read(tmp_path / "bench").tests, strict=True):
        step = read(FOLDER).noise
        assert np.max(np.abs(one.data.displacement - other.data.displacement) / step.displacement) < 0.1
        assert np.max(np.abs(one.data.wrench - other.data.wrench) / step.wrench) < 0.1
        assert np.max(np.abs(one.data.gauges - other.data.gauges) / step.gauges) < 0.1
