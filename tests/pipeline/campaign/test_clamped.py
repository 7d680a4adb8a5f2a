"""A coordinate that a clamp holds and that nothing reads: `held` in the control of a test."""

from pathlib import Path

import numpy as np
import pytest

from pipeline.campaign import read
from pipeline.campaign.control import swings
from pipeline.campaign.writing import write
from pipeline.inference.estimated_sigmas import completed
from pipeline.inference.load_cases import load_cases
from pipeline.inference.model import Model
from pipeline.inference.prediction import predict
from pipeline.init.command import init
from tests.pipeline.campaign.example import complaint, laid

TOML = """schema = 1
name = "pulled sideways"
[rig]
kind = "parallelogram"
length_mm = 310.0
width_mm = 80.0
bar = { EA_N = 6.82e6, EIy_Nmm2 = 1.98e8, EIz_Nmm2 = 4.51e7, GJ_Nmm2 = 1.08e7 }
[noise]
y_mm = 0.001
fy_N = 0.5
[tolerance]
all = "exact"
[[tests]]
id = "q0"
role = "fit"
q_deg = 20.0
control = { x = "force", y = "force", z = "held", rx = "force", ry = "force", rz = "force" }
"""
CSV = "test,step,y_mm,fy_N\nq0,0,0,0\nq0,1,0.5,12\nq0,2,-0.5,-12\n"
ZEROS = "test,step,y_mm,z_mm,fy_N\nq0,0,0,0,0\nq0,1,0.5,0,12\nq0,2,-0.5,0,-12\n"
MOVED = TOML.replace('z = "held"', 'z = "displacement"').replace("[noise]", "[noise]\nz_mm = 1e-9")


def test_held_is_a_column_of_zeros_that_nobody_has_to_write(tmp_path: Path) -> None:
    held = completed(read(laid(tmp_path / "held", TOML, CSV)))
    zeros = completed(read(laid(tmp_path / "zeros", MOVED, ZEROS)))
    assert not swings(held.rig, held.tests[0].q, held.tests[0].control, ())
    assert not [said for said in held.remarks if "z_mm" in said]
    one, other = (predict(Model(), load_cases(it)) for it in (held, zeros))
    assert np.abs(one.values[:, 1]).max() > 0.1
    np.testing.assert_allclose(one.values, other.values, rtol=0, atol=1e-12)
    assert load_cases(held).input_sigma[:, 2].tolist() == [0.0] * 3


def test_held_is_written_as_it_was_read(tmp_path: Path) -> None:
    first = read(laid(tmp_path / "a", TOML, CSV))
    write(tmp_path / "b", first)
    assert read(tmp_path / "b").tests[0].control == first.tests[0].control
    assert first.tests[0].control[2] == "held"


def test_a_missing_column_and_a_mechanism_name_the_way_out(tmp_path: Path) -> None:
    said = complaint(tmp_path, TOML.replace('"held"', '"displacement"'), CSV)
    assert "column z_mm: is missing, but test 'q0' controls z by displacement" in said
    assert 'where a clamp holds it and nothing reads it, write z = "held" in its control' in said
    said = complaint(tmp_path, TOML.replace('"held"', '"force"'), CSV)
    assert "nothing holds z" in said and 'z = "held" where a clamp keeps it where it is unloaded' in said


def test_what_is_held_has_no_readings_of_a_way(tmp_path: Path) -> None:
    said = complaint(tmp_path, TOML, ZEROS.replace("0.5,0,12", "0.5,0.3,12"))
    assert "line 3, column z_mm: reads 0.3 in test 'q0', which holds z where it is unloaded" in said
    assert read(laid(tmp_path, TOML, ZEROS)).tests[0].control[2] == "held"


@pytest.mark.parametrize(
    ("header", "way"),
    [
        ("Test,y_mm,fy_N", "held"),
        ("Test,Pull [N],fy_N", "held"),
        ("Test,z_mm,fy_N", "displacement"),
        ("Test,Dial [um],fy_N", "displacement"),
    ],
)
def test_init_holds_what_no_column_of_the_file_can_read(header: str, way: str, tmp_path: Path) -> None:
    file = tmp_path / "table.csv"
    file.write_text(f"{header}\nq0,0.0,0.0\nq0,0.5,12.5\n")
    init(tmp_path / "bench", file, "parallelogram")
    assert f'z = "{way}"' in (tmp_path / "bench" / "campaign.toml").read_text()
