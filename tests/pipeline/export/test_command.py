"""The command `export`: what it says, what it refuses, what it leaves alone."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

from pipeline.cli import app
from pipeline.export import source
from pipeline.export.formats import module_of, names
from pipeline.export.source import Sources, exported
from tests.conftest import ROOT
from tests.pipeline.export.sources import KEPT, UNEQUAL, campaign, model_text
from vjm.stiffness import rank

RUNNER = CliRunner()


def call(*arguments: object) -> tuple[int, str, str]:
    done = RUNNER.invoke(app, ["export", *map(str, arguments)])
    assert done.exception is None or isinstance(done.exception, SystemExit), done.exception
    return done.exit_code, done.stdout, done.stderr


def test_formats_are_found_by_themselves() -> None:
    folder = ROOT / "pipeline" / "export" / "formats"
    assert set(names()) == {path.stem for path in folder.glob("[a-z]*.py")}
    assert set(names()) >= {"json", "npz", "mat", "inp", "dmig", "mjcf", "urdf", "exudyn"}
    for name in names():
        assert module_of(name).UNITS.endswith(".")
    code, out, _ = call("--help")
    assert code == 0 and all(name in out for name in names())


@pytest.mark.parametrize("to", names())
def test_says_what_was_written(to: str, tmp_path: Path) -> None:
    """Units, angle, what is lost; 80 columns; the same again is no other file; quiet names the files alone."""
    target = tmp_path / f"out.{to}"
    code, out, err = call(KEPT, "--to", to, target, "--q", 30)
    assert (code, err) == (0, ""), err
    assert max(len(line) for line in out.splitlines()) <= 80
    plain = " ".join(out.split())
    for said in ("written", "Units", "geometric stiffness", "rank 5", "q = 30 degrees"):
        assert said in plain, said
    before = {path: path.read_bytes() for path in tmp_path.iterdir()}
    assert target in before
    code, out, err = call(KEPT, "--to", to, target, "--q", 30, "--quiet")
    assert code == 0 and " ".join(out.split()).count(": written") == len(before) and "Units" not in out, err
    assert {path: path.read_bytes() for path in tmp_path.iterdir()} == before


@pytest.mark.parametrize("to", ["urdf", "json", "inp"])
def test_a_file_with_something_else_stays(to: str, tmp_path: Path) -> None:
    """Of several files none is written where one cannot be."""
    files = module_of(to).files(exported(Sources(KEPT)), tmp_path / "out.x")
    taken = list(files)[-1]
    taken.write_text("mine")
    code, out, err = call(KEPT, "--to", to, tmp_path / "out.x")
    assert code == 2 and out == "" and "is there already and holds something else" in err
    assert [path.name for path in tmp_path.iterdir()] == [taken.name] and taken.read_text() == "mine"


def bad(tmp_path: Path) -> dict[str, tuple[list[object], str]]:
    bench, bar = campaign(tmp_path / "bench"), campaign(tmp_path / "one", "bar")
    machine = campaign(tmp_path / "machine", "bar")
    (machine / "campaign.toml").write_text(
        'schema = 1\nname = "m"\n[rig]\nkind = "manipulator"\nfile = "orthoglide"\n[noise]\nx_mm = 0.001\nfx_N = 1.0\n'
        '[[tests]]\nid = "at0"\nrole = "fit"\nat_mm = [0.0, 0.0, 0.0]\n'
        'control = { x = "force", y = "force", z = "force", rx = "force", ry = "force", rz = "force" }\n'
    )
    (tmp_path / "none").mkdir()
    text = tmp_path / "text.json"
    text.write_text("{}")
    out = tmp_path / "out"
    return {
        "format": ([bench, "--to", "jsn", out], "--to is 'jsn', allowed are dmig"),
        "missing": (
            [tmp_path / "nowhere", "--to", "json", out],
            "is missing, allowed are a campaign's folder",
        ),
        "empty folder": (
            [tmp_path / "none", "--to", "json", out],
            "has neither campaign.toml nor result.json nor bar.json",
        ),
        "another json": ([text, "--to", "json", out], "is not a saved result"),
        "another file": ([bench / "measurements.csv", "--to", "json", out], "is no result of run"),
        "angle of a bar": ([bar, "--to", "inp", out, "--q", 3], "is a single bar, which has none"),
        "angle": (
            [bench, "--to", "inp", out, "--q", 90],
            "--q is 90, allowed are degrees between -90 and 90",
        ),
        "model of a result": ([KEPT, "--to", "inp", out, "--model", text], "belong to a campaign"),
        "no model": ([bench, "--to", "inp", out, "--model", tmp_path / "no.toml"], "no.toml: is missing"),
        "manipulator": ([machine, "--to", "inp", out], "is a campaign of a manipulator, allowed are"),
        "folder": (
            [bench, "--to", "json", tmp_path / "none"],
            "none is a folder, allowed is the name of a file",
        ),
        "no name": ([bench, "--to", "urdf", "."], "is a folder, allowed is the name of a file"),
        "no place": ([bench, "--to", "json", text / "out"], "the folder of"),
    }


def test_bad_input_is_one_sentence(tmp_path: Path) -> None:
    cases = bad(tmp_path)
    before = sorted(tmp_path.rglob("*"))
    for name, (arguments, said) in cases.items():
        code, out, err = call(*arguments)
        assert code == 2 and out == "", (name, out, err)
        assert err.startswith("error: ") and len(err.splitlines()) == 1 and said in err, (name, err)
    assert sorted(tmp_path.rglob("*")) == before


def test_what_has_no_stiffness_is_said(tmp_path: Path) -> None:
    """Effects that are in the numbers at no load and those that are not, for springs and for mechanisms."""
    effects = {**UNEQUAL, "joint_torsional_stiffness": {"stiffness_Nmm_per_rad": 5e4}}
    bench = campaign(tmp_path / "bench", effects=effects)
    _, springs, _ = call(bench, "--to", "dmig", tmp_path / "a", "--q", 30)
    _, mechanism, _ = call(bench, "--to", "mjcf", tmp_path / "b", "--q", 30)
    inside, outside = "that are in the numbers, as they act at no load: ", "that are not in the file: "
    both = "bar_length_mismatch, bar_stiffness_asymmetry"
    plain = [" ".join(text.split()) for text in (springs, mechanism)]
    assert f"{inside}{both}, joint_torsional_stiffness." in plain[0] and f"{outside}load_offset." in plain[0]
    assert f"{inside}{both}." in plain[1] and f"{outside}load_offset, joint_torsional_stiffness." in plain[1]
    # Hinges that spring back hold the swing.
    assert "rank" not in plain[0]
    whole = exported(Sources(bench, 30.0)).linkages[0].whole
    assert whole.rank == rank(whole.matrix, whole.length) == 6 and len(whole.terms) == 6
    other = tmp_path / "other.toml"
    other.write_text(model_text({}))
    assert exported(Sources(bench, 30.0, model=other)).linkages[0].whole.rank == 5


def test_a_swing_without_energy_has_no_spring(tmp_path: Path) -> None:
    """Five terms make the whole of K_p, and none of them feels the swing."""
    linkage = exported(Sources(campaign(tmp_path / "bench"), 30.0)).linkages[0]
    whole = linkage.whole
    assert len(whole.terms) == 5
    total = sum(stiffness * np.outer(direction, direction) for stiffness, direction in whole.terms)
    assert abs(total - whole.matrix).max() < 1e-12 * abs(whole.matrix).max()


def test_effects_that_cannot_be(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """An effect that the rig cannot have is bad input; a linkage without a stiffness is a failure of the numerics."""
    bench, out = campaign(tmp_path / "bench"), tmp_path / "out"
    (bench / "model.toml").write_text(model_text({"material_yield": {"strain": 0.002}}))
    code, _, err = call(bench, "--to", "json", out)
    assert code == 2 and "model.toml: material_yield needs the rig's outermost fibres" in err

    def singular(*_: object) -> None:
        raise np.linalg.LinAlgError("Singular matrix")

    monkeypatch.setattr(source, "unloaded_stiffness", singular)
    code, _, err = call(KEPT, "--to", "json", out)
    assert code == 3 and "K_p at 0 degrees does not exist at no load" in err and "Singular" not in err
    assert not out.exists()
