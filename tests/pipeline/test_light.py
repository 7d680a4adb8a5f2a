"""Commands about measurements need no mesher, no pictures and no pages: they run where none of these can be loaded."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from pipeline import system

ROOT = Path(__file__).resolve().parents[2]
HEAVY = ("gmsh", "meshio", "pyvista", "trame", "pypardiso", "plotly", "sklearn")
BLOCKED = f"""
import sys

class Blocker:
    def find_spec(self, name, path=None, target=None):
        if name.split(".")[0] in {HEAVY!r}:
            raise ImportError(f"{{name}} is blocked")

sys.meta_path.insert(0, Blocker())
"""


def run(code: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, "-c", BLOCKED + code], cwd=ROOT, capture_output=True, text=True, timeout=300
    )


@pytest.mark.parametrize(
    "arguments",
    [("effects",), pytest.param(("compare", "examples/bench", "--quiet"), marks=pytest.mark.long)],
)
def test_runs_without_mesher_and_pictures(arguments: tuple[str, ...]) -> None:
    done = run(f"from pipeline.cli import app\napp({list(arguments)!r})")
    assert done.returncode == 0, done.stderr
    assert done.stdout.strip()


@pytest.mark.long
def test_no_command_about_measurements_loads_them() -> None:
    names = ("effects_page", "compare.command", "diagnose.command", "add.command", "plan.command")
    names = (*names, "improve.command", "simulate", "simulate_manipulator", "export.command")
    lines = [f"import pipeline.{name}" for name in names]
    done = run("\n".join([*lines, f"print([n for n in {HEAVY!r} if n in sys.modules])"]))
    assert done.returncode == 0, done.stderr
    assert done.stdout.strip() == "[]"


def test_setup_installs_only_what_is_missing(monkeypatch: pytest.MonkeyPatch) -> None:
    called: list[list[str]] = []
    there = dict.fromkeys(system.NEEDED, True)

    def call(command: list[str]) -> bool:
        called.append(command)
        if "install" in command:
            there.update(dict.fromkeys(there, True))
        return True

    monkeypatch.setattr(system, "call", call)
    monkeypatch.setattr(system, "loads", lambda name: there[name])
    monkeypatch.setattr(system, "administrator", list)
    monkeypatch.setattr(system.shutil, "which", lambda name: f"/usr/bin/{name}")
    system.install_libraries()
    assert not called
    there["libGLU.so.1"] = False
    system.install_libraries()
    assert "update" in called[0] and called[1][-1] == "libglu1-mesa"
