"""The command improve: the error falls step by step, only what is certain is added, and remove takes it back."""

from __future__ import annotations

import json
from pathlib import Path
from types import SimpleNamespace
from typing import cast

from typer.testing import CliRunner

from pipeline.campaign import write
from pipeline.cli import app
from pipeline.improve.steps import certain
from pipeline.inference.model_reading import read_model_file
from pipeline.selection.diagnosis import Diagnosis
from tests.pipeline.selection.bench import bench

LARGE = "bar_geometric_nonlinearity"
RUNNER = CliRunner()


def test_the_error_falls_to_noise_and_a_step_can_be_undone(tmp_path: Path) -> None:
    folder, out = tmp_path / "bench", tmp_path / "out"
    write(folder, bench("bar_length_mismatch.mismatch_mm", 0.05, ("axial_held_q+0", "lateral_q+0")))
    ran = RUNNER.invoke(app, ["improve", str(folder), "--out", str(out)])
    assert ran.exit_code == 0, ran.output
    answer = json.loads((out / "answer.json").read_text())
    assert answer["verdict"] == "within_noise"
    assert set(answer["added"]) == {LARGE, "bar_length_mismatch"}
    fitted = [step["fit"] for step in answer["error"]]
    assert fitted == sorted(fitted, reverse=True) and fitted[-1] < 1.2 < fitted[0]
    saved = read_model_file(folder / "model.toml").model
    assert set(saved.names) == {LARGE, "bar_length_mismatch"}
    assert read_model_file(out / "step_0.toml").model.names == ()
    back = RUNNER.invoke(app, ["remove", str(folder), "bar_length_mismatch", "--quiet"])
    assert back.exit_code == 0, back.output
    assert read_model_file(folder / "model.toml").model.names == (LARGE,)


def test_what_is_not_there_cannot_be_removed(tmp_path: Path) -> None:
    folder = tmp_path / "bench"
    write(folder, bench(ids=("axial_held_q+0",)))
    ran = RUNNER.invoke(app, ["remove", str(folder), "joint_friction"])
    assert ran.exit_code == 2
    assert "joint_friction is not in the model, allowed are its effects: none" in ran.output


def test_noise_needs_nothing(tmp_path: Path) -> None:
    folder = tmp_path / "bench"
    write(folder, bench(ids=("axial_held_q+0",)))
    ran = RUNNER.invoke(app, ["improve", str(folder), "--quiet"])
    assert ran.exit_code == 0, ran.output
    assert "Nothing was added: what is left is noise." in ran.output
    assert not (folder / "model.toml").exists()


def test_of_several_sets_only_what_is_certain_is_added() -> None:
    """A sensor's fault that all sets share is none by that: a law at a place that none of them is may look like it."""
    effects = {"a": ("one",), "fault": ("two",), LARGE: ()}
    cache = SimpleNamespace(candidates={k: SimpleNamespace(parameters=v) for k, v in effects.items()})
    sets = ((LARGE, "a", "fault"), (LARGE, "fault"))
    it = SimpleNamespace(verdict="ambiguous", possible=sets, certain=(), cache=cache)
    assert certain(cast(Diagnosis, it)) == {LARGE}
    it.certain = ("fault", "a")
    assert certain(cast(Diagnosis, it)) == {LARGE, "fault"}
