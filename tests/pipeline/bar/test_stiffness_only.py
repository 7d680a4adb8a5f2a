"""`bar --stiffness-only`: the K_b of the whole command, without what is not asked for, in the record and in memory."""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from pipeline.bar.command import Asked, bar
from pipeline.bar.file_case import file_case
from pipeline.bar.of_file import elastic_limit, place
from pipeline.bar.record import BarRecord
from pipeline.campaign.bar_from import bar_from
from pipeline.errors import InputError
from tests.conftest import Done
from tests.meshes.brought import made, parts, written

CASE = """schema = 1
name = "it"
[material]
E_MPa = 70000.0
nu = 0.33
[bar]
file = "it.step"
base = { plane = [0, 0, 0], normal = [1, 0, 0] }
tip = { plane = [60, 0, 0], normal = [1, 0, 0] }
"""
NEVER = ("skfem", "gmsh", "pyvista", "matplotlib", "plotly", "meshio")


def laid(folder: Path, make: Callable[[], None], text: str = CASE) -> Path:
    made.cad(folder / "it.step", make)
    (folder / "it.toml").write_text(text)
    return folder / "it.toml"


def alone(path: Path) -> BarRecord:
    return bar(Asked(str(path), stiffness_only=True, out=path.parent / "out", quiet=True))


@pytest.mark.parametrize(
    ("make", "more"),
    [
        (made.box, ""),
        (made.box, 'tie = "distributed"\n'),
        pytest.param(made.tapered, "", marks=pytest.mark.long),
    ],
)
def test_the_same_stiffness_as_by_the_whole_mesh(make: Callable[[], None], more: str, tmp_path: Path) -> None:
    """A prism by its section alone to 1e-8, its band too; else the same meshes are used."""
    path = laid(tmp_path, make, CASE + more + "[mesh]\nsize_mm = 6.0\n")
    record, case = alone(path), file_case(path)
    part = place(case, tmp_path / "it.step")
    limit = elastic_limit([b.stiffness(case.bar.tie) for b in part.bars], part)
    assert made.difference(np.array(record.stiffness), limit.value) < 1e-8
    assert record.numerical_band["K44"] == pytest.approx(limit.error[3, 3] / limit.value[3, 3], rel=1e-4)
    assert record.mesh.dofs == part.bars[-1].mesh.dofs and record.mesh.cells == part.bars[-1].mesh.count
    assert any(part.bars[-1].model("rigid").solved_by in said for said in record.said)


def test_what_is_not_computed_is_said(tmp_path: Path) -> None:
    record = alone(laid(tmp_path, made.box))
    assert record.geometric is None and record.buckling == [] and record.stress is None
    assert record.modelling == {} and record.modelling_band == {}
    assert any("are not computed" in said and "K_g" in said for said in record.said)
    assert sorted(p.name for p in (tmp_path / "out").iterdir()) == ["bar.json"]
    assert BarRecord.read(tmp_path / "out" / "bar.json", "record of bar") == record


def test_init_takes_it(pipeline_command: Callable[..., Done], tmp_path: Path) -> None:
    """The tolerance is the usual one with the band by mesh; that nothing is known of the tie is said."""
    alone(laid(tmp_path, made.box, CASE + "[linkage]\nwidth_mm = 40.0\n"))
    done = pipeline_command(
        "init", "bench", "--kind", "parallelogram", "--from", "out/bar.json", cwd=tmp_path
    )
    assert done.code == 0, done.err
    known = bar_from(tmp_path / "bench" / "bar.json")
    assert "nothing known by tie of the ends" in known.said and known.geometric is None
    assert known.tolerance({"GJ": 0.02})["GJ"] == pytest.approx(np.hypot(0.02, known.numerical["GJ"]))
    assert "length_mm = 60.0" in (tmp_path / "bench" / "campaign.toml").read_text()


def test_a_mesh_as_it_came(tmp_path: Path) -> None:
    written.inp(parts.block("hexahedron"), tmp_path / "it.inp")
    text = CASE.replace('file = "it.step"', 'file = "it.inp"\nunit = "mm"').replace(
        "[material]\nE_MPa = 70000.0\nnu = 0.33",
        "[materials]\nLEFT = { E_MPa = 7e4, nu = 0.33 }\nRIGHT = { E_MPa = 7e4, nu = 0.33 }",
    )
    (tmp_path / "it.toml").write_text(text)
    record = alone(tmp_path / "it.toml")
    assert record.stiffness[0][0] == pytest.approx(7e4 * 60 / 60, rel=0.03)
    assert any("band by mesh is not known" in said for said in record.said)


def test_a_prism_needs_no_library_of_meshes_or_pictures(tmp_path: Path) -> None:
    """They take longer to import than K_b to compute; gmsh is the child's alone."""
    path = laid(tmp_path, made.box)
    code = (
        "import sys; from pipeline.cli import app\n"
        f"app(['bar', {str(path)!r}, '--stiffness-only', '--out', {str(tmp_path / 'out')!r}, '--quiet'], "
        "standalone_mode=False)\n"
        f"print('loaded:', *[name for name in {NEVER!r} if name in sys.modules])"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.splitlines()[-1] == "loaded:"
    assert json.loads((tmp_path / "out" / "bar.json").read_text())["stiffness"][0][0] > 7e4


def test_a_case_with_a_section_is_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="--stiffness-only is for a bar that comes as a file"):
        bar(Asked("plain_i_bar", stiffness_only=True, out=tmp_path / "out", quiet=True))
