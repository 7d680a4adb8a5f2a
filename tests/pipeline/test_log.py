"""The log of a command: each fit with its steps in a file, and nothing of the answer changes."""

import logging
import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from typer.testing import CliRunner

from pipeline.campaign import write
from pipeline.cli import app
from pipeline.inference.model_reading import read_model_file
from pipeline.log import ROOT
from tests.pipeline.bench import bench


@pytest.fixture(autouse=True)
def _as_before() -> Iterator[None]:
    level, handlers = ROOT.level, list(ROOT.handlers)
    yield
    ROOT.setLevel(level)
    for handler in set(ROOT.handlers) - set(handlers):
        ROOT.removeHandler(handler)
        handler.close()


def added(folder: Path, *before: str) -> None:
    done = CliRunner().invoke(app, [*before, "add", str(folder), "modulus_error", "--quiet"])
    assert done.exit_code == 0, done.output


def test_a_fit_is_traced_step_by_step_and_ends_as_without(tmp_path: Path) -> None:
    for name in ("plain", "logged"):
        write(tmp_path / name, bench("modulus_error.scale", 0.95))
    added(tmp_path / "plain")
    log = tmp_path / "fit.log"
    log.write_text("what was there\n")
    added(tmp_path / "logged", "--log", str(log))
    one, other = (
        read_model_file(tmp_path / name / "model.toml").model.values for name in ("plain", "logged")
    )
    assert one.tolist() == other.tolist()
    text = log.read_text()
    assert text.startswith("what was there\n")
    assert "pipeline.inference.fit: fit of modulus_error from [" in text
    steps = re.findall(r"sum of squares (\S+), tried (\S+), promised", text)
    left = [float(tried) for _, tried in steps]
    assert len(left) >= 2 and left[-1] < float(steps[0][0])
    ends = re.findall(r"fit: sum of squares \S+, rows lost 0, numbers \[([^\]]+)\]", text)
    assert any(float(end) == pytest.approx(other[0], rel=1e-7) for end in ends)


def test_a_log_that_cannot_be_written_is_said(tmp_path: Path) -> None:
    done = CliRunner().invoke(app, ["--log", str(tmp_path / "none" / "x.log"), "effects"])
    assert done.exit_code == 2
    assert re.search(r"error: --log .*x\.log: cannot be written: No such file", done.output)
    assert not [h for h in ROOT.handlers if isinstance(h, logging.FileHandler)]
