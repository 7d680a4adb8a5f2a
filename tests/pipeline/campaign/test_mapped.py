"""A table in the units and the layout of its logger is the same campaign as the plain one, where that was declared."""

from __future__ import annotations

from hashlib import sha256
from pathlib import Path
from time import perf_counter

import numpy as np
import openpyxl
import pytest
from nptdms import ChannelObject, GroupObject, TdmsWriter

from pipeline.campaign.names import DISPLACEMENTS, WRENCHES
from pipeline.campaign.reading import BY_ROWS
from tests.pipeline.campaign.mapped_tables import (
    FZ,
    SIMPLE,
    TEST,
    TWO,
    Z,
    assert_agrees,
    assert_refused,
    campaign,
    table,
)


@pytest.mark.parametrize(
    ("z", "fz", "by", "force"),
    [
        ("mm", "N", 1.0, 1.0),
        ("in", "lbf", 25.4, 4.4482216152605),
        ("um", "kN", 1e-3, 1e3),
        ("thou", "kgf", 0.0254, 9.80665),
        ("inches", "kp", 25.4, 9.80665),
        ("ft", "ozf", 304.8, 4.4482216152605 / 16.0),
        ("m", "gf", 1e3, 9.80665e-3),
    ],
)
def test_units_are_converted_as_declared_and_said(
    tmp_path: Path, z: str, fz: str, by: float, force: float
) -> None:
    found = campaign(tmp_path, SIMPLE.format(z=z, fz=fz), table(["Travel", "Load"], Z / by, FZ / force))
    assert_agrees(found)
    said = " ".join(found.remarks)
    assert "z = 'Travel'" in said and (by == 1.0 or "1 " in said)


@pytest.mark.parametrize(
    ("layout", "content"),
    [
        ("[file]\nheader_row = 3\n", "board A, tested by M.\n\nTravel (mm),Load (N)\n"),
        ("[file]\nunits_row = 2\n", "Travel,Load\nmm,N\n"),
        ('[file]\ncomment = "#"\n', "Travel [mm],Load [N]\n# a remark, with a comma\n"),
        ("[file]\nskip = 2\n", "Travel [mm],Load [N]\n0.1,bumped\nstart\n"),
    ],
)
def test_titles_units_remarks_and_skipped_rows_are_where_it_was_declared(
    tmp_path: Path, layout: str, content: str
) -> None:
    rows = "".join(f"{z},{f}\n" for z, f in zip(Z, FZ, strict=True))
    names = (
        ("Travel (mm)", "Load (N)")
        if "(" in content
        else ("Travel [mm]", "Load [N]")
        if "[" in content
        else ("Travel", "Load")
    )
    columns = f'[columns]\n"{names[0]}" = {{ is = "z" }}\n"{names[1]}" = {{ is = "fz" }}\n'
    assert_agrees(campaign(tmp_path, layout + columns, content + rows))


@pytest.mark.parametrize("step", ["", '"No" = { is = "step" }\n'])
def test_where_rows_are_the_steps_it_is_said_where_they_begin(tmp_path: Path, step: str) -> None:
    content = "No,Travel,Load\n" + "".join(
        f"{k},{z},{f}\n" for k, (z, f) in enumerate(zip(Z, FZ, strict=True), 1)
    )
    declared = SIMPLE.format(z="mm", fz="N") + (step or '"No" = { is = "ignore" }\n')
    found = campaign(tmp_path, declared, content)
    assert (BY_ROWS in found.remarks) is (not step)
    assert found.tests[0].data.steps[0] == (1 if step else 0)


def test_blank_rows_and_headers_that_come_again_are_no_rows(tmp_path: Path) -> None:
    first, rest = table(["Travel", "Load"], Z[:2], FZ[:2]), table(["Travel", "Load"], Z[2:], FZ[2:])
    assert_agrees(campaign(tmp_path, SIMPLE.format(z="mm", fz="N"), f"{first}\n\n{rest}"))


@pytest.mark.parametrize(
    ("mark", "name"), [(";", None), (";", ";"), ("\t", "tab"), (" ", "space"), (" ", None)]
)
def test_decimal_commas_and_other_separators(tmp_path: Path, mark: str, name: str | None) -> None:
    rows = [[f"{v:.4f}".replace(".", ",") for v in each] for each in (Z, FZ)]
    content = table(["Travel", "Load"], *rows, mark=mark)
    layout = f'[file]\nseparator = "{name}"\n' if name else ""
    assert_agrees(campaign(tmp_path, layout + SIMPLE.format(z="mm", fz="N"), content))


def test_a_number_that_allows_two_readings_is_refused_with_the_question(tmp_path: Path) -> None:
    content, columns = "Travel;Load\n1;2.500\n4;7.250\n", SIMPLE.format(z="mm", fz="N")
    assert_refused(tmp_path, columns, content, "2.500 may be 2.500 or 2500", "decimal =")
    found = campaign(tmp_path, '[file]\ndecimal = ","\nthousands = "."\n' + columns, content)
    assert_agrees(found, np.array([1.0, 4.0]), np.array([2500.0, 7250.0]))
    found = campaign(tmp_path, '[file]\ndecimal = "."\n' + columns, content)
    assert_agrees(found, np.array([1.0, 4.0]), np.array([2.5, 7.25]))


def test_a_logger_without_header_in_cp1252(tmp_path: Path) -> None:
    """Time, travel and force, parted by blanks, with a decimal comma and a thousands mark."""
    content = "Prüfung 3 ±1µ\n" + "".join(
        f"11:23:0{k} {z:.4f} {1000 * f:,.1f}\n".replace(",", "_").replace(".", ",").replace("_", ".")
        for k, (z, f) in enumerate(zip(Z, FZ, strict=True))
    )
    layout = (
        '[file]\nencoding = "cp1252"\nheader_row = 0\nskip = 1\nseparator = "space"\n'
        'decimal = ","\nthousands = "."\ntime_column = "#1"\n'
        '[columns]\n"#2" = { is = "z", unit = "mm" }\n"#3" = { is = "fz", unit = "mN" }\n'
    )
    assert_agrees(campaign(tmp_path, layout, content.encode("cp1252")))
    assert_refused(
        tmp_path,
        layout.replace('encoding = "cp1252"\n', ""),
        content.encode("cp1252"),
        "line 1",
        'encoding = "cp1252"',
    )


def test_words_for_no_reading_are_those_that_were_declared(tmp_path: Path) -> None:
    content = "Travel,Load\n0,0\n---,-5\nOVL,-10\nNaN,-15\n-2.0828,-20\n"
    layout = '[file]\nmissing = ["---", "OVL"]\n' + SIMPLE.format(z="mm", fz="N")
    found = campaign(tmp_path, layout, content)
    assert (
        np.isnan(found.tests[0].data.displacement[1:4, 2]).all()
        and found.tests[0].data.wrench[:, 2].tolist() == FZ.tolist()
    )
    assert_refused(
        tmp_path, SIMPLE.format(z="mm", fz="N"), content, "line 3, column 'Travel': holds '---'", "line 4"
    )


def test_sign_and_zero_are_those_of_the_reading(tmp_path: Path) -> None:
    columns = '[columns]\n"Travel" = { is = "z", unit = "mm", sign = -1, zero = 3.2 }\n'
    columns += '"Load" = { is = "fz", unit = "N", zero = "first_row" }\n'
    content = table(["Travel", "Load"], 3.2 - Z, FZ + 17.0)
    found = campaign(tmp_path, columns, content)
    assert_agrees(found)
    assert any("z = -'Travel' less 3.2" in each for each in found.remarks)


def test_a_first_row_is_that_of_each_test(tmp_path: Path) -> None:
    zero = 'unit = "N", zero = "first_row"'
    columns = f'[columns]\n"Travel" = {{ is = "z", unit = "mm" }}\n"Load" = {{ is = "fz", {zero} }}\n'
    force = np.concatenate([FZ + 17.0, FZ - 2.0])
    content = table(["test", "Travel", "Load"], ["load"] * 5 + ["again"] * 5, np.tile(Z, 2), force)
    found = campaign(tmp_path, columns, content, tests=TWO)
    assert_agrees(found)
    assert_agrees(found, test=1)


@pytest.mark.parametrize(
    ("columns", "content", "said"),
    [
        ('"Travel" = { is = "?" }', "Travel,Load\n0,0\n", 'is = "?" is not decided yet'),
        (
            '"Travel" = { is = "z", unit = "mm" }',
            "Travel,Load\n0,0\n",
            "column 'Load': is not declared, write under [columns]: \"Load\" = { is = ... }",
        ),
        (
            '"Travel" = { is = "z" }\n"Load" = { is = "ignore" }',
            "Travel,Load\n0,0\n",
            "has no unit, write unit",
        ),
        (
            '"Travel (in)" = { is = "z", unit = "mm" }',
            "Travel (in)\n0\n",
            "has the unit mm, but the file says in",
        ),
        (
            '"Travel" = { is = "fz", unit = "kg" }',
            "Travel\n0\n",
            "kg is a mass; is the force meant that it weighs? Then write kgf",
        ),
        ('"Travel" = { is = "rz", unit = "grad" }', "Travel\n0\n", "a degree (write deg) or a gon"),
        ('"Travel" = { is = "z", unit = "N" }', "Travel\n0\n", "N is a force, this is a length"),
        ('"Travel" = { is = "zz", unit = "N" }', "Travel\n0\n", "is = 'zz' is unknown, did you mean 'z'?"),
        ('"Travel" = { is = "z", unit = "mm", sign = 2 }', "Travel\n0\n", "sign is 2, allowed is 1 or -1"),
        (
            '"a" = { is = "z", unit = "mm" }\n"b" = { is = "z", unit = "mm" }',
            "a,b\n0,0\n",
            "is z, as column 'a' is",
        ),
        (
            '"gone" = { is = "z", unit = "mm" }',
            "a\n0\n",
            "column 'gone': is under [columns] and not in the file, allowed: a",
        ),
        ('"a" = { is = "z", unit = "mm" }', "a,a\n0,0\n", "column 'a': is there twice"),
        ('"a" = { is = "z", unit = "mm" }', "a\n0,5\n", "line 2: has 2 cells, the header has 1"),
        ('"a" = { is = "sigma.z", unit = "mm" }', "a\n0\n", "is not read yet, write one sigma"),
    ],
)
def test_what_was_not_said_is_asked(tmp_path: Path, columns: str, content: str, said: str) -> None:
    assert_refused(tmp_path, f"[columns]\n{columns}\n", content, said)


def test_a_workbook_with_titles_a_row_of_units_and_merged_cells(tmp_path: Path) -> None:
    book = openpyxl.Workbook()
    sheet = book.active
    assert sheet is not None
    sheet.append(["Blade, series 4", None, None])
    sheet.append(["Test", "Travel", "Load"])
    sheet.append([None, "µm", "kN"])
    for name, row in (("load", 4), ("again", 9)):
        for k, (z, f) in enumerate(zip(Z, FZ, strict=True)):
            sheet.append([name if k == 0 else None, 1e3 * z, 1e-3 * f])
        sheet.merge_cells(f"A{row}:A{row + 4}")
    book.save(tmp_path / "blade.xlsx")
    layout = '[file]\npath = "blade.xlsx"\nheader_row = 2\nunits_row = 3\nfill_down = ["Test"]\ntest_column = "Test"\n'
    columns = '[columns]\n"Travel" = { is = "z" }\n"Load" = { is = "fz" }\n"Test" = { is = "test" }\n'
    found = campaign(tmp_path, layout + columns, tests=TWO)
    assert_agrees(found)
    assert_agrees(found, test=1)


@pytest.mark.long
def test_a_long_workbook_is_read_in_seconds(tmp_path: Path) -> None:
    book = openpyxl.Workbook(write_only=True)
    sheet = book.create_sheet("run")
    sheet.append(["Time (s)", "Travel (µm)", "Load (kN)"])
    for k in range(100_000):
        sheet.append([0.01 * k, -0.5 * k, -1e-6 * k])
    book.save(tmp_path / "run.xlsx")
    tables = '[file]\npath = "run.xlsx"\ntime_column = "Time (s)"\n'
    tables += '[columns]\n"Travel (µm)" = { is = "z" }\n"Load (kN)" = { is = "fz" }\n'
    start = perf_counter()
    found = campaign(tmp_path, tables)
    assert perf_counter() - start < 5.0
    assert found.tests[0].data.wrench[-1, 2] == pytest.approx(-99.999)


@pytest.mark.parametrize("how", ["sheet", "file", "own", "blank_row"])
def test_a_sheet_a_file_or_a_block_of_rows_for_each_test(tmp_path: Path, how: str) -> None:
    tests, columns = TWO, SIMPLE.format(z="mm", fz="N")
    rows = list(zip(Z.tolist(), FZ.tolist(), strict=True))
    if how == "sheet":
        book = openpyxl.Workbook()
        book.remove(book.worksheets[0])
        for name in ("again", "load"):
            sheet = book.create_sheet(name)
            for row in [("Travel", "Load"), *rows]:
                sheet.append(row)
        book.save(tmp_path / "a.xlsx")
        layout = '[file]\npath = "a.xlsx"\ntest_from = "sheet"\n'
    elif how == "blank_row":
        (tmp_path / "a.txt").write_text(
            table(["Travel", "Load"], Z, FZ) + "\n" + table(["x", "y"], Z, FZ).split("\n", 1)[1]
        )
        layout = '[file]\npath = "a.txt"\ntest_from = "blank_row"\n'
    else:
        for name in ("load", "again"):
            (tmp_path / f"{name}.dat").write_text(table(["Travel", "Load"], Z, FZ))
        layout = '[file]\npath = "*.dat"\ntest_from = "file"\n' if how == "file" else ""
        if how == "own":
            tests = "".join(TEST.format(id=n) + f'file = {{ path = "{n}.dat" }}\n' for n in ("load", "again"))
    found = campaign(tmp_path, layout + columns, tests=tests)
    assert [test.id for test in found.tests] == ["load", "again"]
    assert_agrees(found)
    assert_agrees(found, test=1)


def test_of_many_rows_the_ends_and_the_turns_are_kept(tmp_path: Path) -> None:
    z = np.concatenate([np.linspace(0.0, 1.0, 38), np.linspace(1.0, -0.5, 57)[1:], [-0.4]])
    content = table(["Travel", "Load"], z, 3.0 * z)
    found = campaign(tmp_path, "[file]\nevery = 10\n" + SIMPLE.format(z="mm", fz="N"), content)
    kept = found.tests[0].data.displacement[:, 2]
    assert (
        kept[0] == 0.0
        and kept[-1] == -0.4
        and {1.0, -0.5} <= set(kept)
        and len(kept) == len(range(0, 95, 10)) + 3
    )


@pytest.mark.parametrize("times", [["0,0", "0,5", "0,4"], ["11:23:03", "11:23:05", "11:23:04"]])
def test_a_time_that_goes_back_is_said_and_midnight_is_passed(tmp_path: Path, times: list[str]) -> None:
    content = table(["t", "Travel", "Load"], times, Z[:3].astype(str), FZ[:3].astype(str), mark=";")
    layout = '[file]\ntime_column = "t"\n' + SIMPLE.format(z="mm", fz="N")
    assert_refused(
        tmp_path, layout, content, f"line 4, column 't': is '{times[2]}', earlier than the row before it"
    )
    clock = ["23:59:59", "00:00:01", "00:00:02"]
    midnight = table(["t", "Travel", "Load"], clock, Z[:3].astype(str), FZ[:3].astype(str))
    assert_agrees(campaign(tmp_path, layout, midnight), Z[:3], FZ[:3])


def test_the_files_are_told_by_their_digests(tmp_path: Path) -> None:
    for name in ("load", "again"):
        (tmp_path / f"{name}.dat").write_text(table(["Travel", "Load"], Z, FZ))
    layout = '[file]\npath = "*.dat"\ntest_from = "file"\n' + SIMPLE.format(z="mm", fz="N")
    found = dict(campaign(tmp_path, layout, tests=TWO).digests)
    assert list(found) == ["campaign.toml", "again.dat", "load.dat"]
    assert found["load.dat"] == sha256((tmp_path / "load.dat").read_bytes()).hexdigest()


def test_channels_of_a_group(tmp_path: Path) -> None:
    with TdmsWriter(str(tmp_path / "a.tdms")) as writer:
        writer.write_segment(
            [
                GroupObject("g"),
                ChannelObject("g", "Travel", Z, properties={"unit_string": "mm"}),
                ChannelObject("g", "Load", FZ / 9.80665, properties={"unit_string": "kgf"}),
            ]
        )
    layout = (
        '[file]\npath = "a.tdms"\nunits_row = 2\n[columns]\n"Travel" = { is = "z" }\n"Load" = { is = "fz" }\n'
    )
    assert_agrees(campaign(tmp_path, layout))


@pytest.mark.parametrize("name", ["a.xlsx", "a.tdms", "a.doc", "a.csv"])
def test_a_file_that_is_none_is_said(tmp_path: Path, name: str) -> None:
    layout = f'[file]\npath = "{name}"\n' + SIMPLE.format(z="mm", fz="N")
    assert_refused(tmp_path, layout, b"PK\x03\x04broken\x00\xff", name, name=name)


def test_a_cell_at_another_point_and_turned(tmp_path: Path) -> None:
    """f = s R f', m = s R m' + r x f for a random wrench; checked by the moment about another point, and back."""
    rng = np.random.default_rng(5)
    wrench = rng.normal(size=(4, 6)) * [10, 10, 10, 300, 300, 300]
    r, half = np.array([12.0, -30.0, 45.0]), np.sqrt(0.5)
    turn = np.array([[half, -half, 0.0], [half, half, 0.0], [0.0, 0.0, 1.0]])
    moment = wrench[:, 3:] - np.cross(r, wrench[:, :3])
    read_f, read_m = -wrench[:, :3] @ turn, -moment @ turn
    columns = "[columns]\n" + "".join(
        f'"{n}" = {{ is = "{n}", unit = "{u}" }}\n'
        for n, u in zip(["fx", "fy", "fz", "mx", "my", "mz"], ["N"] * 3 + ["Nm"] * 3, strict=True)
    )
    cell = "[cell]\nat_mm = [12.0, -30.0, 45.0]\nturned_deg = [0, 0, 45]\nsign = -1\n"
    content = table(["fx", "fy", "fz", "mx", "my", "mz"], *read_f.T, *(1e-3 * read_m).T)
    found = campaign(tmp_path, columns + cell, content)
    np.testing.assert_allclose(found.tests[0].data.wrench, wrench, rtol=1e-9)
    fewer = columns.replace('"fy" = { is = "fy"', '"fy" = { is = "ignore"')
    assert_refused(tmp_path, fewer + cell, content, "[cell]: fx at the platform needs fy of the cell as well")


def test_two_dials_are_an_angle(tmp_path: Path) -> None:
    angle = np.array([0.0, 1e-3, -2e-3])
    first = np.array([5.0, 6.0, 7.0])
    content = table(["Dial 1", "Dial 2", "Load"], first, first + 1e3 * 60.0 * np.tan(angle), FZ[:3])
    tables = '[columns]\n"Load" = { is = "fz", unit = "N" }\n'
    tables += '[derived]\nrz = { of = { "Dial 2" = 1, "Dial 1" = -1 }, unit = "um", over_mm = 60.0 }\n'
    found = campaign(tmp_path, tables, content)
    np.testing.assert_allclose(found.tests[0].data.displacement[:, 5], angle, atol=1e-12)
    twice = tables.replace("[columns]\n", '[columns]\n"Dial 1" = { is = "z", unit = "um" }\n')
    assert_refused(
        tmp_path, twice, content, "is used by [derived] already, allowed is one use of each: delete"
    )


def test_every_quantity_comes_out_in_the_unit_of_the_contract(tmp_path: Path) -> None:
    names = [*DISPLACEMENTS, *WRENCHES, "temperature_C"]
    units = ["in", "mm", "um", "deg", "mrad", "arcsec", "kgf", "lbf", "kN", "Nm", "lbf·ft", "kgf·cm", "°F"]
    whats = [*(n.split("_")[0] for n in names[:-1]), "temperature"]
    columns = "[columns]\n" + "".join(
        f'"c{k}" = {{ is = "{w}", unit = "{u}" }}\n'
        for k, (w, u) in enumerate(zip(whats, units, strict=True))
    )
    found = campaign(tmp_path, columns, table([f"c{k}" for k in range(13)], *np.ones((13, 2))))
    data = found.tests[0].data
    degree = np.pi / 180.0
    np.testing.assert_allclose(
        data.displacement[0], [25.4, 1.0, 1e-3, degree, 1e-3, degree / 3600.0], rtol=1e-12
    )
    np.testing.assert_allclose(
        data.wrench[0], [9.80665, 4.4482216152605, 1e3, 1e3, 1355.8179483314, 98.0665], rtol=1e-12
    )
    assert data.temperature is not None and data.temperature[0] == pytest.approx(-155.0 / 9.0)
