"""`run` of a brought bar: its linkage beside that of the same bar given by its section; what it refuses."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from pipeline.bar.part_linkage import couplings, eight_alone
from pipeline.command import validate
from pipeline.errors import InputError
from pipeline.validation.entries import ENTRIES
from tests.conftest import Done
from tests.meshes.brought import made, parts, written
from vjm import paper

SECTION = """schema = 1
name = "box"
title = "A box"
[material]
E_MPa = 70000.0
nu = 0.33
yield_MPa = 250.0
[linkage]
length_mm = 60.0
width_mm = 40.0
angles_deg = [30.0]
[bar]
section = { kind = "rectangle", width_mm = 6.0, height_mm = 10.0 }
[mesh]
size_mm = 1.5
"""
ENDS = "base = { plane = [0, 0, 0], normal = [1, 0, 0] }\ntip = { plane = [60, 0, 0], normal = [1, 0, 0] }"
FILE = (
    SECTION.replace("length_mm = 60.0\n", "")
    .replace(
        'section = { kind = "rectangle", width_mm = 6.0, height_mm = 10.0 }', f'file = "box.step"\n{ENDS}'
    )
    .replace("size_mm = 1.5", "size_mm = 5.0")
)


@pytest.mark.long
def test_the_same_linkage_as_by_its_section(pipeline_command: Callable[..., Done], tmp_path: Path) -> None:
    """Another mesh, another reader, another solver: K_p, critical loads, paths, yield loads of one bar."""
    made.cad(tmp_path / "box.step", made.box)
    found: dict[str, dict[str, Any]] = {}
    for name, text in (("section", SECTION), ("file", FILE)):
        (tmp_path / f"{name}.toml").write_text(text)
        done = pipeline_command("run", f"{name}.toml", "--coarse", "--out", name, "--quiet", cwd=tmp_path)
        assert done.code == 0, done.err
        found[name] = json.loads((tmp_path / name / "result.json").read_text())
    one, other = found["section"], found["file"]
    for mine, its in zip(other["parallelogram"], one["parallelogram"], strict=True):
        assert mine["worst_fea_deviation"] < 1e-6
        filled = np.abs(its["vjm"]) > 1e-9 * np.abs(its["vjm"]).max()
        np.testing.assert_allclose(np.array(mine["fea"])[filled], np.array(its["fea"])[filled], rtol=0.03)
    # Without mesh error the two meet far closer than on the meshes of this look.
    limit = np.array(one["bar"]["convergence"]["extrapolated"])
    mine_k = np.array(other["bar"]["stiffness"])
    for name, (i, j) in ENTRIES.items():
        assert mine_k[i, j] == pytest.approx(limit[i, j], rel=0.005), name
    keys = ("q_deg", "held", "model", "spring_at", "what")
    theirs = {str([c[k] for k in keys]): c for c in one["critical"]}
    assert len(theirs) == len(other["critical"]) > 15
    for c in other["critical"]:
        same = theirs[str([c[k] for k in keys])]
        assert (c["load_N"] is None) == (same["load_N"] is None)
        # By K_b alone shear cannot be told from stiff ends, so that formulas of a file know no shear: another bar.
        if c["load_N"] is not None and c["model"] != "beam formula":
            assert c["load_N"] == pytest.approx(same["load_N"], rel=0.04), c
    for curve, its in zip(other["curves"], one["curves"], strict=True):
        assert [curve[k] for k in ("model", "branch", "held", "spring_at")] == [
            its[k] for k in ("model", "branch", "held", "spring_at")
        ]
    bent, its = (
        next(c for c in r["curves"] if (c["model"], c["branch"]) == ("fea", "buckled")) for r in (other, one)
    )
    assert bent["yield_fx_N"] == pytest.approx(its["yield_fx_N"], rel=0.1)
    # N/A and the solid's largest stress away from the ends.
    assert other["bar"]["stress"]["loads"][0]["body"]["first_yield"] == pytest.approx(250.0 * 60.0, rel=0.06)
    assert other["left_out"] == [] and other["yield_MPa"] == pytest.approx(250.0)
    page = (tmp_path / "file" / "index.html").read_text()
    for title in ("Force and deflection", "Stress under unit loads", "The bar to scale", "Critical loads"):
        assert title in page
    (tmp_path / "file" / "index.html").unlink()
    assert pipeline_command("report", "file", "--quiet", cwd=tmp_path).code == 0
    assert (tmp_path / "file" / "index.html").read_text() == page
    for source in ("file/result.json", "file/bar.json", "file"):
        made_to = f"{source.replace('/', '-')}.npz"
        assert pipeline_command("export", source, made_to, "--to", "npz", cwd=tmp_path).code == 0
        k_b = np.load(tmp_path / made_to)["K_b"]
        np.testing.assert_allclose(k_b, other["bar"]["stiffness"], rtol=1e-12, atol=1e-6)
    assert (
        pipeline_command(
            "init", "bench", "--kind", "parallelogram", "--from", "file/result.json", cwd=tmp_path
        ).code
        == 0
    )


def test_what_run_cannot_take_is_a_sentence(tmp_path: Path) -> None:
    written.inp(parts.block("hexahedron"), tmp_path / "box.inp")
    text = FILE.replace("box.step", "box.inp")
    for old, new, options, said in (
        ("[linkage]\nwidth_mm = 40.0\nangles_deg = [30.0]\n", "", {}, "linkage is missing"),
        ("[30.0]", "[30.0, 30.0]", {}, "each once"),
        ("[30.0]", "[75.0]", {}, "angles_deg"),
        ("[30.0]", "[]", {}, "angles_deg"),
        ("", "", {"fine": True}, "a smaller mesh.size_mm"),
    ):
        assert old in text
        path = tmp_path / "box.toml"
        path.write_text(text.replace(old, new) if old else text)
        with pytest.raises(InputError) as caught:
            validate(str(path), False, options.get("fine", False), tmp_path / "out", True, "")
        assert said in str(caught.value), str(caught.value)
    assert not (tmp_path / "out").exists()


def test_couplings_are_named_by_their_share() -> None:
    k = np.array(paper.BAR_STIFFNESS, dtype=float)
    assert couplings(k) == []
    np.testing.assert_array_equal(eight_alone(k), k)
    k[0, 4] = k[4, 0] = 0.02 * np.sqrt(k[0, 0] * k[4, 4])
    k[1, 2] = k[2, 1] = 0.05 * np.sqrt(k[1, 1] * k[2, 2])
    k[3, 5] = k[5, 3] = 1e-4 * np.sqrt(k[3, 3] * k[5, 5])
    said = couplings(k)
    assert [each.partition(",")[0] for each in said] == ["K23", "K15"] and "5 %" in said[0]
    np.testing.assert_array_equal(eight_alone(k), np.array(paper.BAR_STIFFNESS))
