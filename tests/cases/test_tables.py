"""Tables as people had them, read by what is declared of them: the same numbers as in the plain table, or a question.

Cases c10 (a logger's own files), c11 (a cantilever with a dial, in 18 variants), n_... (a bench with two dials and one
cell, and a machine, as somebody entered them).
"""

from __future__ import annotations

import csv
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


BENCHES = ("n_B_k0", "n_B_s4", "n_b_nonoise", "n_c4", "n_e_flip", "n_f_gauge", "n_i_outlier_f")
CHANNELS = ("x_mm", "y_mm", "z_mm", "rx_rad", "ry_rad", "rz_rad")
WRENCH = ("fx_N", "fy_N", "fz_N", "mx_Nmm", "my_Nmm", "mz_Nmm")
RENAMED = {"fx_N": "pull", "fy_N": "push"}


def plain(folder: Path) -> dict[str, np.ndarray]:
    """The cells of a plain table as (rows, 12), NaN for nothing, by test."""
    rows: dict[str, list[list[float]]] = {}
    with (folder / "measurements.csv").open(encoding="utf-8") as file:
        for row in csv.DictReader(file):
            rows.setdefault(row["test"], []).append([float(row.get(c) or "nan") for c in CHANNELS + WRENCH])
    return {test: np.array(found) for test, found in rows.items()}


def read_in(campaign: Campaign) -> dict[str, np.ndarray]:
    return {t.id: np.hstack([t.data.displacement, t.data.wrench]) for t in campaign.tests}


@pytest.mark.parametrize("name", BENCHES)
def test_a_bench_as_it_was_entered(name: str) -> None:
    np.testing.assert_equal(read_in(read(DATA / name)), plain(DATA / name))


def renamed(tmp_path: Path, name: str, tables: str) -> Path:
    """The bench with forces under other headers, and what is declared of them."""
    folder = declared(tmp_path, name, tables)
    table = (folder / "measurements.csv").read_text()
    for old, new in RENAMED.items():
        table = table.replace(old, new)
    (folder / "measurements.csv").write_text(table)
    return folder


@pytest.mark.parametrize(("name", "unit", "sign"), [("n_B_k0", "kgf", 1), ("n_e_flip", "N", -1)])
def test_forces_in_another_unit_or_of_another_sign(tmp_path: Path, name: str, unit: str, sign: int) -> None:
    tables = "[columns]\n" + "".join(
        f'"{new}" = {{ is = "{old[:2]}", unit = "{unit}", sign = {sign} }}\n' for old, new in RENAMED.items()
    )
    found = read_in(read(renamed(tmp_path, name, tables)))
    factor = np.repeat([1.0, sign * (9.80665 if unit == "kgf" else 1.0)], 6)
    for test, cells in plain(DATA / name).items():
        np.testing.assert_allclose(found[test], factor * cells, rtol=1e-12)


def test_a_header_that_says_newtons_is_not_read_as_kilograms(tmp_path: Path) -> None:
    folder = declared(tmp_path, "n_B_k0", '[columns]\n"fx_N" = { is = "fx", unit = "kgf" }\n')
    with pytest.raises(BadCampaign, match="column 'fx_N': has the unit kgf, but the file says N"):
        read(folder)


def test_a_dial_that_was_not_zeroed_is_zeroed_where_that_is_declared(tmp_path: Path) -> None:
    folder = declared(tmp_path, "n_f_gauge", '[columns]\n"x_mm" = { is = "x", zero = "first_row" }\n')
    found = read_in(read(folder))
    for test, cells in plain(DATA / "n_f_gauge").items():
        np.testing.assert_allclose(found[test][:, 0], cells[:, 0] - cells[0, 0], atol=1e-15)
        np.testing.assert_equal(found[test][:, 1:], cells[:, 1:])
