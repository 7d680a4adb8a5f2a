"""`bar` of a file: a case or options in, record and page out; then from CAD to a diagnosis with nothing typed."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

from fem.pardiso import has_pardiso
from pipeline.cli import app
from tests.conftest import Done
from tests.meshes.brought import made, parts, written

CASE = """schema = 1
name = "link"
title = "A link of two materials"
[materials]
LEFT = { E_MPa = 210000.0, nu = 0.3, yield_MPa = 600.0 }
RIGHT = { E1_MPa = 7e4, E2_MPa = 7e4, E3_MPa = 7e4, nu12 = 0.33, nu13 = 0.33, nu23 = 0.33, G12_MPa = 26315.789473684, \
G13_MPa = 26315.789473684, G23_MPa = 26315.789473684 }
[bar]
file = "link.inp"
unit = "mm"
base = { plane = [0, 0, 0], normal = [1, 0, 0] }
tip = { plane = [60, 0, 0], normal = [1, 0, 0] }
[linkage]
width_mm = 40.0
"""


def laid(folder: Path, text: str = CASE) -> Path:
    written.inp(parts.block("hexahedron"), folder / "link.inp")
    (folder / "link.toml").write_text(text)
    return folder / "link.toml"


def test_a_case_with_a_file(pipeline_command: Callable[..., Done], tmp_path: Path) -> None:
    laid(tmp_path)
    done = pipeline_command("bar", "link.toml", "--json", "it.json", "--quiet", cwd=tmp_path)
    assert done.code == 0, done.err
    record = json.loads((tmp_path / "it.json").read_text())
    series = 1.0 / (30 / (210e3 * 60) + 30 / (70e3 * 60))
    assert record["stiffness"][0][0] == pytest.approx(series, rel=0.03)
    assert record["numerical_band"] == record["geometric_numerical_band"] == {} and record["modelling_band"]
    assert "K₁₁" in (tmp_path / "results" / "link-bar" / "index.html").read_text()
    assert record["width_mm"] == 40.0 and record["length_mm"] == pytest.approx(60.0)
    assert set(record["data"]) == {"link.inp"} and set(record["modelling"]) == {"distributed"}
    said = " ".join(record["said"])
    assert "linear cells were raised" in said and "band by mesh is not known" in said and "read past" in said
    assert (
        f"Solved by: {'pardiso' if has_pardiso() else 'SuperLU'}, {record['mesh']['dofs']} unknowns" in said
    )
    folder = tmp_path / "results" / "link-bar"
    assert "A link of two materials" in (folder / "index.html").read_text()
    assert sorted(p.stem for p in (folder / "modes").iterdir()) == ["clamped", "free", "guided", "pinned"]
    assert {b["supports"] for b in record["buckling"]} == {"free", "guided", "clamped", "pinned"}
    free = next(b for b in record["buckling"] if b["supports"] == "free")
    # Between Euler's loads of either material all along.
    euler = [np.pi**2 * E * 10 * 6**3 / 12 / 120**2 for E in (70e3, 210e3)]
    assert euler[0] < free["load_N"] < euler[1] and free["plane"] == "xy"
    # The left half alone has a criterion and a limit: at the latest where the mean stress F / 60 mm² is 600 MPa, and
    # before that where the other material holds it at x = 30.
    axial = record["stress"]["loads"][0]
    assert axial["load"] == "Fx" and 0.6 * 600 * 60 < axial["body"]["first_yield"] < 600 * 60
    assert axial["body"]["first_yield"] == pytest.approx(600 / axial["body"]["stress"], rel=1e-9)
    assert all(
        each[where]["at_mm"][0] <= 30.0 for each in record["stress"]["loads"] for where in ("body", "ends")
    )
    for b in record["buckling"]:
        assert b["beyond_yield"] is (b["load_N"] > axial["body"]["first_yield"])
    assert {b["beyond_yield"] for b in record["buckling"]} == {True, False}
    assert "brings the first fibre" in said
    assert "Stress under unit loads" in (folder / "index.html").read_text()


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("LEFT = {", "MIDDLE = {", "its regions are"),
        ('unit = "mm"', 'unit = "ft"', "allowed are mm, cm, m, um, inch"),
        ("normal = [1, 0, 0] }\ntip", "normal = [0, 0, 0] }\ntip", "a direction other than zero"),
        ("plane = [60, 0, 0]", "place = [60, 0, 0]", "a table without plane, cylinder or name"),
        ('file = "link.inp"', 'file = "nowhere.inp"', "is missing or no file"),
        ('file = "link.inp"', 'file = "link.dwg"', "link.dwg"),
        ("[linkage]", "[[linkage]]", "linkage"),
        ("nu12 = 0.33", "nu12 = 3.3", "energy back"),
        ("[materials]", "[material]\nE_MPa = 1.0\nnu = 0.3\n[materials]", "material or materials"),
        ("width_mm = 40.0", "wide_mm = 40.0", "wide_mm is not a key"),
    ],
)
def test_a_case_that_cannot_be_is_a_sentence(old: str, new: str, said: str, tmp_path: Path) -> None:
    from pipeline.bar.command import Asked, bar
    from pipeline.errors import InputError

    assert old in CASE
    path = laid(tmp_path, CASE.replace(old, new))
    with pytest.raises(InputError) as caught:
        bar(Asked(str(path), out=tmp_path / "out", quiet=True))
    assert said in str(caught.value), str(caught.value)
    assert not (tmp_path / "out").exists()


def test_a_file_with_options(tmp_path: Path) -> None:
    laid(tmp_path)
    mesh, case = str(tmp_path / "link.inp"), str(tmp_path / "link.toml")
    for arguments, said in (
        ((mesh, "--unit", "mm"), "add --E and --nu"),
        ((mesh, "--unit", "mm", "--E", "7e4", "--nu", "0.33"), '{ name = "FOOT" }'),
        ((case, "--E", "7e4"), "--E belong to a file without a case"),
    ):
        done = CliRunner().invoke(app, ["bar", *arguments])
        assert done.exit_code == 2 and said in done.stderr, done.stderr


@pytest.mark.long
def test_from_cad_to_a_diagnosis_with_nothing_typed_between(
    pipeline_command: Callable[..., Done], tmp_path: Path
) -> None:
    """STEP, bar, init --from, simulate, diagnose, add, predict: the record hands on all that the next step needs."""

    def rod() -> None:
        import gmsh

        gmsh.model.occ.addBox(0, -5, -8, 250, 10, 16)

    made.cad(tmp_path / "rod.step", rod)
    ends = "base = { plane = [0,0,0], normal = [1,0,0] }\ntip = { plane = [250,0,0], normal = [1,0,0] }"
    (tmp_path / "rod.toml").write_text(
        f'schema = 1\nname = "rod"\n[material]\nE_MPa = 7e4\nnu = 0.33\n[bar]\nfile = "rod.step"\n{ends}\n'
        "[linkage]\nwidth_mm = 60.0\n"
    )

    def done(*arguments: str) -> str:
        it = pipeline_command(*arguments, cwd=tmp_path)
        assert it.code == 0, it.err
        return it.out

    done("bar", "rod.toml", "--out", "rod", "--quiet")
    done("init", "bench", "--kind", "parallelogram", "--from", "rod/bar.json")
    done(
        "simulate",
        "hidden",
        "--effect",
        "joint_friction.torque_Nmm=400",
        "--seed",
        "4",
        "--from",
        "bench",
        "--quiet",
    )
    done("diagnose", "hidden", "--json", "answer.json", "--quiet")
    answer = json.loads((tmp_path / "answer.json").read_text())
    assert answer["verdict"] in ("identified", "ambiguous")
    assert "joint_friction" in {e for each in [answer["effects"], *answer["alternatives"]] for e in each}
    done("add", "hidden", *answer["effects"], "--quiet")
    done("predict", "hidden", "--json", "predicted.json", "--quiet")
    predicted = json.loads((tmp_path / "predicted.json").read_text())
    assert predicted["held_out"]["of"] > 100
    assert predicted["held_out"]["inside"] > 0.85 * predicted["held_out"]["of"]
    assert predicted["comparison"] and predicted["budget"]
    record = json.loads((tmp_path / "rod" / "bar.json").read_text())
    assert record["stiffness"][0][0] == pytest.approx(7e4 * 160 / 250, rel=0.01)
    text = (tmp_path / "hidden" / "campaign.toml").read_text()
    assert f"length_mm = {record['length_mm']}" in text and "EA = " in text
