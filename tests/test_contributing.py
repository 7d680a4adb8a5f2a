"""CONTRIBUTING.md is tried out: each of its files is put where it says, in a copy of the project, is found and used."""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from tests.conftest import ROOT

PAGE = (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8")
FILES = dict(
    re.findall(r"^```\{code-block\} py\n:caption: (\S+)\n\n(.*?)^```$", PAGE, re.MULTILINE | re.DOTALL)
)
CAMPAIGN = """schema = 1
name = "pressed"

[rig]
kind = "column"
length_mm = 300.0
bar = { EA_N = 1e6, EIy_Nmm2 = 4e5, EIz_Nmm2 = 4e5, GJ_Nmm2 = 3e5 }

[noise]
x_mm = 0.001
fx_N = 0.1

[file]
path = "readings.jsonl"

[columns]
"Way" = { is = "x", unit = "um" }
"Load" = { is = "fx", unit = "N" }

[[tests]]
id = "press"
q_deg = 0.0
role = "fit"
control = { x = "force" }
"""
READINGS = '["Way", "Load"]\n' + "".join(f"[{-0.3 * load}, {-load}]\n" for load in range(8))
USED = """
import sys
from pathlib import Path
import numpy as np
import vjm
assert Path(vjm.__file__).is_relative_to(Path.cwd()), vjm.__file__
import parastiff
from vjm.forms import forms

bench = parastiff.open("pressed")
print(bench.headline)
print(bench.subject.campaign.tests[0].rig.supports)
added = bench.add("seal_spring")
print(added.model.names, round(added.answer.error[0].chi_square, 6) >= round(added.answer.error[-1].chi_square, 6))
law = forms()["fifth"].law(np.array([2.0]), np.zeros(0), series=False)
print(float(law.respond(np.array([3.0]), np.zeros(0)).force[0]))
bench.write("again")
print(parastiff.open("again").headline)
print(parastiff.rigs.column(length_mm=300.0, bar=dict(EA_N=1e6, EIy_Nmm2=4e5, EIz_Nmm2=4e5, GJ_Nmm2=3e5)).ends)
"""


@pytest.fixture(scope="module")
def project(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A copy of the project with the files of the page."""
    here = tmp_path_factory.mktemp("project")
    for name in ("fem", "meshes", "parastiff", "pipeline", "reports", "vjm"):
        shutil.copytree(
            ROOT / name,
            here / name,
            ignore=lambda _, names: [n for n in names if not n.endswith((".py", ".toml")) and "." in n],
        )
    for name, text in FILES.items():
        assert not (ROOT / name).exists() and (ROOT / name).parent.is_dir(), name
        (here / name).write_text(text, encoding="utf-8")
    (here / "pressed").mkdir()
    (here / "pressed" / "campaign.toml").write_text(CAMPAIGN, encoding="utf-8")
    (here / "pressed" / "readings.jsonl").write_text(READINGS, encoding="utf-8")
    return here


def called(folder: Path, *arguments: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, *arguments],
        cwd=folder,
        # What is compiled is compiled again in every folder.
        env={"PYTHONPATH": str(folder), "NUMBA_DISABLE_JIT": "1"},
        capture_output=True,
        text=True,
    )


def test_the_four_files_are_found_and_used(project: Path) -> None:
    assert len(FILES) == 4
    done = called(project, "-c", USED)
    assert done.returncode == 0, done.stderr
    assert done.stdout.splitlines() == [
        "pressed: column of 300 mm, 1 tests, 8 load steps",
        str(dict.fromkeys(("y", "z", "rx", "ry", "rz"), "the pinned tip")),
        "('seal_spring',) True",
        "486.0",
        "pressed: column of 300 mm, 1 tests, 8 load steps",
        "('pinned', 'pinned')",
    ]


def test_they_are_written_as_the_project_is(project: Path) -> None:
    shutil.copy(ROOT / "pyproject.toml", project)
    for tool in (["check"], ["format", "--check"]):
        done = called(project, "-m", "ruff", *tool, *FILES)
        assert done.returncode == 0, done.stdout + done.stderr


def test_what_is_said_of_versions_and_schemas_is_so() -> None:
    assert "## Unreleased" in (ROOT / "CHANGELOG.md").read_text(encoding="utf-8")
    assert "licence" in PAGE and not list(ROOT.glob("LICEN[CS]E*"))
    for file in ("examples/bench/campaign.toml", "pipeline/validation/cases/plain_i_bar.toml"):
        assert re.search(r"^schema = 1$", (ROOT / file).read_text(encoding="utf-8"), re.MULTILINE), file
    for target in re.findall(r"\]\(([^)]+)\)", PAGE):
        assert (ROOT / target).exists(), target
