"""`bar` of a case with a section: the bar of `run`, figure by figure, as JSON and as a page."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

from fem.material import Isotropic
from fem.stiffness import bar_stiffness
from meshes.bar import Bar
from meshes.resolution import Resolution
from meshes.section import Rectangle
from meshes.store import mesh_bar
from pipeline.bar.record import relative_spread
from pipeline.cli import app
from reports.formats import named_entries
from tests.conftest import Done

CASE = """schema = 1
name = "short"
title = "A short bar"
[material]
E_MPa = 70000.0
nu = 0.33
yield_MPa = 250.0
[linkage]
length_mm = 60.0
width_mm = 40.0
[bar]
section = { kind = "rectangle", width_mm = 6.0, height_mm = 10.0 }
[mesh]
size_mm = 6.0
"""


@pytest.mark.long
def test_record_page_and_figures(pipeline_command: Callable[..., Done], tmp_path: Path) -> None:
    (tmp_path / "short.toml").write_text(CASE)
    done = pipeline_command("bar", "short.toml", "--coarse", "--json", "it.json", "--quiet", cwd=tmp_path)
    assert done.code == 0, done.err
    record = json.loads((tmp_path / "it.json").read_text())
    folder = tmp_path / "results" / "short-bar"
    assert record == json.loads((folder / "bar.json").read_text())
    page = (folder / "index.html").read_text()
    assert "A short bar" in page and "K₄₄" in page and "shapes" in page
    k = np.array(record["stiffness"])
    mesh = mesh_bar(Bar(Rectangle(6.0, 10.0), 60.0), Resolution(6.0, 1))
    np.testing.assert_allclose(k, bar_stiffness(mesh, 60.0, Isotropic(70e3, 0.33)), atol=1e-9 * k.max())
    # EA/L, Euler of a cantilever: only a look whether units and places are right.
    assert record["extrapolated"][0][0] == pytest.approx(70e3 * 60.0 / 60.0, rel=0.03)
    euler = np.pi**2 * 70e3 * 10.0 * 6.0**3 / 12 / 120.0**2
    (free,) = [
        b for b in record["buckling"] if b["supports"] == "free" and b["mode"] == 1 and b["model"] == "solid"
    ]
    assert free["load_N"] == pytest.approx(euler, rel=0.05) and free["plane"] == "xy"
    assert record["geometric"][1][1] == pytest.approx(1.2 / 60.0, rel=0.1)
    axial = record["stress"]["loads"][0]["body"]
    assert axial["first_yield"] == pytest.approx(250.0 * 60.0, rel=0.06)
    assert any(b["beyond_yield"] for b in record["buckling"]) and "Stress under unit loads" in page
    assert set(record["data"]) == {"short.toml"}


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (("nowhere.toml",), "nowhere.toml"),
        (("bar.xyz",), "bar.xyz"),
        (("plain_i_bar", "--coarse", "--fine"), "allowed is one of the two"),
    ],
)
def test_what_is_no_bar_is_one_sentence(arguments: tuple[str, ...], said: str) -> None:
    done = CliRunner().invoke(app, ["bar", *arguments])
    assert done.exit_code == 2 and said in done.stderr and done.stderr.count("\n") == 1, done.stderr


@pytest.mark.long
def test_the_same_figures_as_run(pipeline_command: Callable[..., Done], tmp_path: Path) -> None:
    """In folders of their own, so that neither finds what the other has kept."""
    (tmp_path / "a").mkdir()
    (tmp_path / "b").mkdir()
    assert (
        pipeline_command("bar", "plain_i_bar", "--coarse", "--json", "it.json", cwd=tmp_path / "a").code == 0
    )
    assert pipeline_command("run", "plain_i_bar", "--coarse", "--out", "there", cwd=tmp_path / "b").code == 0
    mine = json.loads((tmp_path / "a" / "it.json").read_text())
    whole = json.loads((tmp_path / "b" / "there" / "result.json").read_text())
    assert mine["stiffness"] == whole["bar"]["stiffness"]
    assert mine["geometric"] == whole["bar"]["axial"]["solid"]
    assert mine["numerical_band"] == whole["bar"]["convergence"]["band"]
    loads = [b for b in whole["buckling"] if b["body"] == "bar" and b["model"] == "solid"]
    mine_loads = [b for b in mine["buckling"] if b["model"] == "solid"]
    assert [b["load_N"] for b in mine_loads] == [b["load_N"] for b in loads]


def test_names_of_entries_leave_out_what_is_nothing() -> None:
    k = np.diag([4.0, 1.0, 1.0, 1.0, 1.0, 1.0])
    k[1, 5] = k[5, 1] = -0.5
    k[0, 1] = k[1, 0] = 1e-3
    assert named_entries(k) == {
        "K11": (0, 0), "K22": (1, 1), "K26": (1, 5), "K33": (2, 2), "K44": (3, 3), "K55": (4, 4), "K66": (5, 5)
    }  # fmt: skip
    assert relative_spread(k, {}) == {}
    assert relative_spread(k, {"a": 1.1 * k, "b": 0.8 * k})["K26"] == pytest.approx(0.2)
