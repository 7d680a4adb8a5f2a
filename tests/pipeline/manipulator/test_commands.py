"""The commands table and sweep: what they print and write, and one sentence with code 2 for bad input."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

from pipeline.cli import app
from pipeline.manipulator.sweep import RESULT
from pipeline.manipulator.table_record import Table1
from tests.pipeline.manipulator.test_description import OTHER

OWN = """
from dataclasses import replace
from parastiff import Effect, Parameter, laws

class Seal(laws.Polynomial):
    pass

class Sealed(Effect):
    name = "sealed"
    title = equation = signature = limits = source = "for a test"
    parameters = (Parameter("Nmm_per_rad", "N·mm/rad", 0.0, 1e3, 0.0, 1e9, "of every hinge"),)

    def change(self, rig, values):
        return replace(rig, hinges=(*rig.hinges, Seal((values["Nmm_per_rad"],))))
"""
SMALL = ("--no-pictures", "--points", "3,3,2", "--chunk", "5", "--low", "-40,-40,0", "--high", "40,40,0")


def output(*arguments: str, code: int = 0) -> str:
    ran = CliRunner().invoke(app, list(arguments))
    assert ran.exit_code == code, ran.output
    assert "Traceback" not in ran.output
    return ran.output


def test_table_on_the_terminal_and_in_files(tmp_path: Path) -> None:
    text = output("table", "--json", str(tmp_path / "t.json"), "--out", str(tmp_path / "out"))
    assert "3 numbers fitted to 3 cells, 7 cells predicted" in text
    assert max(map(len, text.splitlines())) <= 100
    record = Table1.model_validate_json((tmp_path / "t.json").read_text(encoding="utf-8"))
    assert record.predicted == 7
    assert (tmp_path / "out" / "table_1.json").read_text() == (tmp_path / "t.json").read_text()
    assert "7 cells predicted" in (tmp_path / "out" / "table_1.md").read_text(encoding="utf-8")


def test_a_manipulator_without_parallelograms_has_no_table(tmp_path: Path) -> None:
    (tmp_path / "other.toml").write_text(OTHER, encoding="utf-8")
    said = output("table", str(tmp_path / "other.toml"), code=2)
    assert "Table 1 needs an Orthoglide" in said and "leg a has no parallelogram" in said


def test_sweep_writes_prints_and_is_gone_on_with(tmp_path: Path) -> None:
    folder = tmp_path / "map"
    text = output("sweep", "--out", str(folder), *SMALL)
    # The box is flat, so it has one point across.
    assert "9 postures" in text and "lowest K_tran" in text and "a second" in text
    values = np.load(folder / RESULT)
    assert values.shape[0] == 9 and not values[:, 2].any()
    again = output("sweep", "--out", str(folder), *SMALL)
    assert "9 postures" in again and "a second" not in again


def test_another_grid_in_the_same_folder_is_refused(tmp_path: Path) -> None:
    output("sweep", "--out", str(tmp_path), *SMALL)
    assert "is of another sweep" in output("sweep", "--out", str(tmp_path), "--points", "2", code=2)


BAD = {
    "points": (["--points", "many"], "--points is many, allowed is a number"),
    "half points": (["--points", "2.5"], "allowed are whole numbers"),
    "no points": (["--points", "0"], "0 points, allowed are 1 or more"),
    "corner": (["--low", "1,2"], "--low is 1,2, allowed are 3 numbers"),
    "not finite": (["--high", "1,2,nan"], "--high is 1,2,nan, allowed are 3 numbers"),
    "upside down": (["--low", "0,0,0", "--high", "0,0,-1"], "a lower and a higher edge"),
    "too many": (["--points", "100000"], "points, allowed are up to"),
    "chunk": (["--chunk", "0"], "--chunk is 0"),
    "workers": (["--workers", "0"], "workers is 0"),
    "effect": (["--effect", "modulus_eror"], "did you mean 'modulus_error'"),
    "parameter": (["--effect", "modulus_error.skale=1"], "modulus_error has no 'skale'"),
    "value": (["--effect", "modulus_error=soft"], "scale is soft, allowed are numbers from 0.3 to 3"),
    "bounds": (["--effect", "modulus_error=9"], "scale is 9, allowed are numbers"),
    "no value": (["--effect", "modulus_error.scale"], "has no value"),
    "twice": (["--effect", "joint_friction", "--effect", "joint_friction"], "is given twice"),
    "fibres": (["--effect", "material_yield"], "needs the rig's outermost fibres"),
    "temperature": (["--effect", "thermal_expansion"], "need --rise"),
    "no use of it": (["--rise", "3"], "--rise is given, allowed with an effect"),
    "wrench": (["--wrench", "1,2"], "--wrench is 1,2, allowed are 3 numbers"),
    "no wrench": (["--wrench", "0,0,0"], "--wrench is zero"),
    "manipulator": (["no_such"], "shipped are orthoglide"),
}


@pytest.mark.parametrize("name", BAD)
def test_bad_input_is_one_sentence(name: str, tmp_path: Path) -> None:
    arguments, said = BAD[name]
    assert said in output("sweep", "--out", str(tmp_path / "map"), *arguments, code=2)
    assert not (tmp_path / "map" / RESULT).exists()


def test_another_wrench_or_effect_is_another_sweep(tmp_path: Path) -> None:
    flat = ("--out", str(tmp_path), "--points", "1", "--low", "0,0,0", "--high", "0,0,0", "--no-pictures")
    text = output("sweep", *flat, "--effect", "modulus_error=0.8", "--wrench", "100,0,0")
    assert "error of the lowest K_tran by the effect" in text and "displacement under the wrench" in text
    softer, pushed = ("--effect", "modulus_error=0.8"), ("--wrench", "100,0,0")
    for changed in ((*softer, "--wrench", "100,1,0"), ("--effect", "modulus_error=0.7", *pushed), pushed):
        assert "is of another sweep" in output("sweep", *flat, *changed, code=2)


def test_an_effect_of_ones_own_goes_to_other_processes(tmp_path: Path) -> None:
    """A class of its file is known to the process that read it alone: it travels with the call."""
    (tmp_path / "own.py").write_text(OWN)
    own = ("--effect", "sealed=1e6", "--effects-from", str(tmp_path / "own.py"))
    for workers in ("1", "2"):
        output("sweep", "--out", str(tmp_path / workers), *SMALL, *own, "--workers", workers)
    alone, shared = (np.load(tmp_path / workers / RESULT) for workers in ("1", "2"))
    # The last digit of a movement that is none hangs on where arrays lie in memory.
    np.testing.assert_allclose(alone, shared, rtol=1e-12, atol=1e-12)


def test_a_folder_with_other_files_is_refused(tmp_path: Path) -> None:
    (tmp_path / "letter.txt").write_text("mine")
    assert "holds other files" in output("sweep", "--out", str(tmp_path), *SMALL, code=2)
