"""Shared by all tests: one default validation run, made once."""

import os
import subprocess
import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import pytest
from typer.testing import CliRunner

from pipeline.cli import app

ROOT = Path(__file__).resolve().parent.parent


@dataclass(frozen=True)
class Done:
    """What a command left behind."""

    code: int
    out: str
    err: str


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Whole runs first: files are given out whole, and at the end the longest one would be waited for."""
    items.sort(key=lambda item: "_run.py" not in item.nodeid)


@pytest.fixture(scope="session")
def pipeline_command() -> Callable[..., Done]:
    """Run `python -m pipeline` with arguments in a folder."""

    def call(*arguments: str, cwd: Path) -> Done:
        environment = {**os.environ, "PYTHONPATH": str(ROOT)}
        done = subprocess.run(
            [sys.executable, "-m", "pipeline", *arguments],
            cwd=cwd,
            env=environment,
            capture_output=True,
            text=True,
            timeout=600,
        )
        return Done(done.returncode, done.stdout, done.stderr)

    return call


@pytest.fixture
def command_here(monkeypatch: pytest.MonkeyPatch) -> Callable[..., Done]:
    """The same in this process: no interpreter starts, no library is loaded anew."""

    def call(*arguments: str, cwd: Path) -> Done:
        monkeypatch.chdir(cwd)
        done = CliRunner().invoke(app, arguments)
        if done.exception is not None and not isinstance(done.exception, SystemExit):
            raise done.exception
        return Done(done.exit_code, done.stdout, done.stderr)

    return call


@dataclass(frozen=True)
class CleanRun:
    """A default run in an empty folder, and a second one after it."""

    folder: Path
    first: Done
    second: Done

    @property
    def out(self) -> Path:
        return self.folder / "reports" / "validation"


@pytest.fixture(scope="session")
def clean_run(pipeline_command: Callable[..., Done], tmp_path_factory: pytest.TempPathFactory) -> CleanRun:
    """The default run twice in an empty folder: the second has to find everything done."""
    folder = tmp_path_factory.mktemp("clean")
    first = pipeline_command("run", cwd=folder)
    (folder / "first.json").write_bytes((folder / "reports/validation/result.json").read_bytes())
    return CleanRun(folder, first, pipeline_command("run", cwd=folder))
