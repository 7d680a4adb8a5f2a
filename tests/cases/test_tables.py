"""Tables as people had them, read by what is declared of them: the same numbers as in the plain table, or a question.

Cases c10 (a logger's own files) and c11 (a cantilever with a dial, in 18 variants).
"""

from __future__ import annotations

import shutil
from pathlib import Path

import numpy as np
import pytest

from pipeline.campaign import BadCampaign, Campaign, read

DATA = Path(__file__).parent / "data"
Z = np.array([0.0, -0.508, -1.016, -1.524, -2.0574, -2.5654, -3.048])
FZ = -5.0 * np.arange(7)
Z_FZ = '"{0}" = {{ is = "z", unit = "{1}" }}\n"{2}" = {{ is = "fz", unit = "{3}" }}\n'
PLAIN = ("magnitudes", "missing_step", "no_sigma_at_all", "outlier", "repeats_same_step", "unload_only")
MAPPED = {
    "extra_remark_column": '[columns]\n"remark" = { is = "ignore" }\n',
    "inches_pounds": "[columns]\n" + Z_FZ.format("z_in", "in", "fz_lbf", "lbf"),
    "kN": "[columns]\n" + '"fz_kN" = { is = "fz" }\n',
    "microns": "[columns]\n" + '"z_um" = { is = "z", unit = "um" }\n',
    "no_step": '[file]\npath = "measurements.csv"\n',
    "semicolons_comma": '[file]\nseparator = ";"\ndecimal = ","\n',
    "spaces_in_header": '[columns]\n"z (mm)" = { is = "z" }\n"Fz (N)" = { is = "fz" }\n',
    "time_instead": '[file]\ntime_column = "time_s"\n',
    "units_row": '[file]\nunits_row = 2\n[columns]\n"z" = { is = "z" }\n"fz" = { is = "fz" }\n',
    "xlsx": '[file]\npath = "measurements.xlsx"\nheader_row = 4\nunits_row = 5\nfill_down = ["Test"]\n'
    '[columns]\n"Test" = { is = "test" }\n"Step" = { is = "step" }\n'
    '"Dial" = { is = "z" }\n"Weight" = { is = "fz" }\n',
}
REFUSED = {
    "sigma_per_row": (
        '[columns]\n"z_mm_sigma" = { is = "sigma.z" }\n',
        "write one sigma for each column under [noise]",
    ),
    "xlsx_broken": ('[file]\npath = "measurements.xlsx"\n', "is no workbook that can be read"),
}


def declared(tmp_path: Path, case: str, tables: str) -> Path:
    folder = tmp_path / "campaign"
    shutil.copytree(DATA / case, folder)
    path = folder / "campaign.toml"
    before, mark, tests = path.read_text(encoding="utf-8").partition("[[tests]]")
    path.write_text(before + tables + mark + tests, encoding="utf-8")
    return folder


def readings(campaign: Campaign) -> tuple[np.ndarray, np.ndarray]:
    (test,) = campaign.tests
    return test.data.displacement[:, 2], test.data.wrench[:, 2]


def test_every_variant_is_looked_at() -> None:
    there = {path.name for path in (DATA / "c11").iterdir()}
    assert there == {*PLAIN, *MAPPED, *REFUSED} and len(there) == 18


@pytest.mark.parametrize("name", PLAIN)
def test_a_plain_table_is_read_as_it_is(name: str) -> None:
    z, fz = readings(read(DATA / "c11" / name))
    assert np.isfinite(z).sum() == z.size - (name == "missing_step") and np.isfinite(fz).all()


@pytest.mark.parametrize("name", MAPPED)
def test_what_was_declared_gives_the_plain_table(tmp_path: Path, name: str) -> None:
    factor = 4.4482216152605 if name in ("inches_pounds", "xlsx") else 1.0
    z, fz = readings(read(declared(tmp_path, f"c11/{name}", MAPPED[name])))
    np.testing.assert_allclose(z, Z, rtol=1e-12, atol=1e-15)
    np.testing.assert_allclose(fz, factor * FZ, rtol=1e-12, atol=1e-15)


@pytest.mark.parametrize("name", MAPPED)
def test_nothing_is_converted_that_was_not_declared(name: str) -> None:
    with pytest.raises(BadCampaign):
        read(DATA / "c11" / name)


@pytest.mark.parametrize("name", REFUSED)
def test_what_cannot_be_read_is_said(tmp_path: Path, name: str) -> None:
    tables, said = REFUSED[name]
    with pytest.raises(BadCampaign) as caught:
        read(declared(tmp_path, f"c11/{name}", tables))
    assert said in str(caught.value)


def test_a_loggers_own_file_without_a_header(tmp_path: Path) -> None:
    """A time, travel and force, parted by blanks, with a decimal comma; tested at constant speed."""
    tables = '[file]\nheader_row = 0\ntime_column = "#1"\n[columns]\n'
    tables += '"#2" = { is = "z", unit = "mm", sign = -1 }\n"#3" = { is = "fz", unit = "N", sign = -1 }\n'
    z, fz = readings(read(declared(tmp_path, "c10_raw_logger_file", tables)))
    assert z.size == 38 and z[12] == -1.21 and fz[12] == -22.9 and fz.min() == -2173.9


def test_a_testing_machines_file_with_units_in_its_second_row(tmp_path: Path) -> None:
    tables = '[file]\nunits_row = 2\ntime_column = "Time"\n[columns]\n'
    tables += '"Extension" = { is = "z", sign = -1 }\n"Load" = { is = "fz", sign = -1, zero = "first_row" }\n'
    z, fz = readings(read(declared(tmp_path, "c10_raw_logger_file/instron_raw", tables)))
    assert z[-1] == -0.11656 and fz[0] == 0.0 and fz[-1] == pytest.approx(2.46923 - 6.77164)
