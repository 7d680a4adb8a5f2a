"""Numbers of a material that are seldom right are asked about, and taken as they are."""

from pathlib import Path

import pytest

from pipeline.campaign import read
from pipeline.check import check
from tests.pipeline.campaign.example import BAR_CSV, laid

TOML = """schema = 1
name = "strip"
[rig]
kind = "bar"
length_mm = 250.0
section = {{ kind = "rectangle", width_mm = 4.0, height_mm = 20.0 }}
material = {{ E_MPa = {E}, nu = {nu} }}
[tolerance]
all = "exact"
[[tests]]
id = "push"
role = "fit"
control = {{ x = "force", y = "force", z = "force", rx = "force", ry = "force", rz = "force" }}
"""
QUESTIONS = {
    "in GPa": (
        "210.0",
        "0.3",
        "rig.material.E_MPa: 210 MPa is at most that of a soft plastic",
        "is it in GPa? Then write 210000",
    ),
    "tungsten in GPa": ("411.0", "0.3", "rig.material.E_MPa: 411 MPa", "Then write 411000"),
    "in Pa": (
        "2.1e11",
        "0.3",
        "rig.material.E_MPa: 2.1e+11 MPa is more than diamond has",
        "is it in kPa or Pa?",
    ),
    "no ratio": ("7e4", "0.03", "rig.material.nu: 0.03 is outside 0.1 to 0.47", "is it right?"),
    "auxetic": ("7e4", "-0.3", "rig.material.nu: -0.3 is outside 0.1 to 0.47", "is it right?"),
}


def remarks(folder: Path, E: str, nu: str) -> list[str]:
    found = read(laid(folder, TOML.format(E=E, nu=nu), BAR_CSV))
    assert found.rig.stiffness[0, 0] == pytest.approx(float(E) * 80.0 / 250.0)
    return [said for said in found.remarks if "material" in said]


@pytest.mark.parametrize("name", QUESTIONS)
def test_what_is_seldom_right_is_asked_about(name: str, tmp_path: Path) -> None:
    modulus, nu, *words = QUESTIONS[name]
    (said,) = remarks(tmp_path, modulus, nu)
    assert said.startswith("campaign.toml, ") and all(word in said for word in words), said


@pytest.mark.parametrize(
    ("modulus", "nu"), [("600.0", "0.46"), ("45000.0", "0.29"), ("7e5", "0.2"), ("2.1e5", "0.3")]
)
def test_usual_materials_raise_no_question(modulus: str, nu: str, tmp_path: Path) -> None:
    assert not remarks(tmp_path, modulus, nu)


def test_check_asks(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    check(laid(tmp_path, TOML.format(E="210.0", nu="0.3"), BAR_CSV))
    assert "is it in GPa?" in " ".join(capsys.readouterr().out.split())
