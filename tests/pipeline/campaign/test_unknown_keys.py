"""A key that a table within a table does not have is told with the keys of that table; a decimal comma as one."""

from pathlib import Path

import pytest

from pipeline.bar.file_case import file_case
from pipeline.campaign import BadCampaign, read
from pipeline.errors import InputError
from pipeline.manipulator.description import describe
from pipeline.validation.case import load_case
from tests.pipeline.campaign.example import TOML, laid

BAR = "bar = { EA_N = 6.82e6, EIy_Nmm2 = 1.98e8, EIz_Nmm2 = 4.51e7, GJ_Nmm2 = 1.08e7 }"
SECTION = (
    'section = { kind = "rectangle", width_mm = 4.0, height_mm = 20.0 }\nmaterial = { E_MPa = 7e4, nu = 0.3 }'
)
KEYS = {
    "material": ("E_MPa = 7e4", "modulus = 7e4", "rig.material.modulus: ", "allowed: E_MPa, nu, yield_MPa, source"),
    "near": ("E_MPa = 7e4", "E_GPa = 70", "rig.material.E_GPa: ", "did you mean 'E_MPa'?"),
    "section": ("height_mm = 20.0", "thick = 20.0", "rig.section.thick: ", "allowed: kind, width_mm, height_mm"),
    "bar": ("", "", "rig.bar.GJ: ", "allowed: EA_N, EIy_Nmm2, EIz_Nmm2, GJ_Nmm2"),
}  # fmt: skip


@pytest.mark.parametrize("name", KEYS)
def test_keys_that_are_allowed_are_those_of_the_same_table(name: str, tmp_path: Path) -> None:
    old, new, place, allowed = KEYS[name]
    own = BAR.replace("GJ_Nmm2", "GJ") if name == "bar" else SECTION.replace(old, new)
    with pytest.raises(BadCampaign) as caught:
        read(laid(tmp_path, TOML.replace(BAR, own)))
    assert f"{place}is not a key of this table, {allowed}" in str(caught.value)


def test_cases_do_so_too(tmp_path: Path) -> None:
    path = tmp_path / "case.toml"
    path.write_text('schema = 1\nname = "a"\n[material]\nmodulus = 7e4\n[bar]\nfile = "a.step"\n')
    with pytest.raises(InputError, match=r"material.*modulus is not a key of this table, allowed: E_MPa, nu"):
        file_case(path)
    path.write_text('schema = 1\nname = "a"\n[mesh]\nfineness = 3\n')
    with pytest.raises(InputError, match=r"mesh.fineness is not a key of this table, allowed: size_mm"):
        load_case(str(path))


COMMAS = {
    "alone": ("length_mm = 310.0", "length_mm = 310,5", "310,5 has a decimal comma", "310.5 (at line 6, column"),
    "in a table": ("EA_N = 6.82e6", "EA_N = 6820,5", "6820,5 has a decimal comma", "6820.5 (at line 8, column"),
    "no comma": ("length_mm = 310.0", "length_mm = 310.0 mm", "Expected newline", "(at line 6, column"),
}  # fmt: skip


@pytest.mark.parametrize("name", COMMAS)
def test_a_decimal_comma_is_told_as_one(name: str, tmp_path: Path) -> None:
    old, new, found, allowed = COMMAS[name]
    with pytest.raises(BadCampaign) as caught:
        read(laid(tmp_path, TOML.replace(old, new)))
    assert found in str(caught.value) and allowed in str(caught.value)


def test_other_files_in_toml_do_so_too(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"1,5 has a decimal comma, allowed is a decimal point: 1\.5"):
        describe("length_mm = 1,5\n", "machine.toml")
    path = tmp_path / "case.toml"
    path.write_text("[mesh]\nsize_mm = 1,5\n")
    with pytest.raises(InputError, match=r"1,5 has a decimal comma"):
        load_case(str(path))
