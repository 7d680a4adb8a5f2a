"""`init` says what a file says by itself and asks what only its owner knows; `check` refuses until that is answered."""

from __future__ import annotations

import json
import re
import tomllib
from collections.abc import Callable
from pathlib import Path

import numpy as np
import openpyxl
import pytest

from pipeline.campaign import BadCampaign, read
from pipeline.campaign.formats import by_suffix
from pipeline.campaign.mapped.grid import BadTable
from pipeline.errors import InputError
from pipeline.init.command import init
from pipeline.init.found import looked
from pipeline.init.words import WORDS, quantity_of
from tests.conftest import Done

DATA = Path(__file__).parents[2] / "cases" / "data"
ANSWERS = {
    'length_mm = "?"': "length_mm = 300.0",
    'EA_N = "?"': "EA_N = 1.3e7",
    'EIy_Nmm2 = "?"': "EIy_Nmm2 = 1.04e8",
    'EIz_Nmm2 = "?"': "EIz_Nmm2 = 1.04e9",
    'GJ_Nmm2 = "?"': "GJ_Nmm2 = 1.56e8",
    'sign = "?"': "sign = -1",
}


def filled_in(folder: Path, **columns: str) -> None:
    path = folder / "campaign.toml"
    text = path.read_text(encoding="utf-8")
    for question, answer in ANSWERS.items():
        text = text.replace(question, answer)
    for name, what in columns.items():
        text = re.sub(rf'("{name}" = \{{ is = )"\?"', rf"\1{what}", text)
    path.write_text(text, encoding="utf-8")


@pytest.mark.long
def test_a_workbook_is_read_once_its_questions_are_answered(
    tmp_path: Path, pipeline_command: Callable[..., Done]
) -> None:
    init(tmp_path, DATA / "c11" / "xlsx" / "measurements.xlsx", "bar")
    done = pipeline_command("check", str(tmp_path), cwd=tmp_path)
    assert done.code == 2 and "columns.'Dial': is = \"?\" is not decided yet" in done.err
    assert 'sign = "?" is not decided yet' in done.err and "rig.length_mm: is '?'" in done.err
    lines = [line for line in done.err.splitlines() if "columns." in line]
    assert len({re.search(r"line (\d+)", line)[1] for line in lines}) == 2  # type: ignore[index]
    filled_in(tmp_path, Dial='"z", unit = "in"', Weight='"fz", unit = "lbf"')
    path = tmp_path / "campaign.toml"
    assert 'id = "load"' in path.read_text()
    (test,) = read(tmp_path).tests
    np.testing.assert_allclose(
        test.data.displacement[:, 2], 25.4 * np.array([0, 0.02, 0.04, 0.06, 0.081, 0.101, 0.12])
    )
    done = pipeline_command("check", str(tmp_path), cwd=tmp_path)
    assert done.code == 0 and "sha256" in done.out and "1 in = 25.4 mm" in done.out, done.err


@pytest.mark.parametrize(
    ("file", "separator", "decimal", "header", "units"),
    [
        ("c10_raw_logger_file/measurements.csv", "space", ",", 0, None),
        ("c10_raw_logger_file/instron_raw/measurements.csv", ",", ".", 1, 2),
        ("c11/semicolons_comma/measurements.csv", ";", ",", 1, None),
        ("c11/units_row/measurements.csv", ",", ".", 1, 2),
        ("c11/spaces_in_header/measurements.csv", ",", ".", 1, None),
        ("c11/xlsx/measurements.xlsx", None, ".", 4, 5),
    ],
)
def test_the_layout_of_a_file_is_found(
    file: str, separator: str | None, decimal: str, header: int, units: int | None
) -> None:
    found = looked(DATA / file)
    assert (found.separator, found.decimal, found.header_row, found.units_row) == (
        separator,
        decimal,
        header,
        units,
    )
    assert not found.question


def test_titles_another_encoding_and_numbers_of_two_readings(tmp_path: Path) -> None:
    path = tmp_path / "a.txt"
    path.write_bytes("Prüfung 3; M. Müller\n\nWeg/µm;Kraft (N)\n1;1.300\n2;2.500\n".encode("cp1252"))
    found = looked(path)
    assert (found.encoding, found.header_row, found.names) == ("cp1252", 3, ("Weg/µm", "Kraft (N)"))
    assert found.decimal is None and "1.300 may be 1.300 or 1300" in found.question
    init(tmp_path / "out", path, "bar")
    with pytest.raises(BadCampaign, match="decimal"):
        read(tmp_path / "out")


@pytest.mark.parametrize("content", ["", "a,b\n", "one\ntwo\n", "1\n2\n3\n"])
def test_a_file_without_a_table_is_said(tmp_path: Path, content: str) -> None:
    (tmp_path / "a.csv").write_text(content)
    with pytest.raises(BadTable, match="no rows of numbers"):
        looked(tmp_path / "a.csv")
    with pytest.raises(InputError, match=r"a\.csv: has no rows of numbers"):
        init(tmp_path / "out", tmp_path / "a.csv", "bar")
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize("kind", ["bar", "parallelogram", "manipulator"])
def test_an_empty_campaign_asks_for_everything_and_no_more(tmp_path: Path, kind: str) -> None:
    init(tmp_path, None, kind)
    with pytest.raises(BadCampaign) as caught:
        read(tmp_path)
    *asked, empty = caught.value.complaints
    assert all("is '?'" in said for said in asked)
    assert "measurements.csv" in empty and "no rows" in empty
    filled_in(tmp_path)
    path = tmp_path / "campaign.toml"
    path.write_text(
        path.read_text()
        .replace('width_mm = "?"', "width_mm = 80.0")
        .replace('q_deg = "?"', "q_deg = 0.0")
        .replace('file = "?"', 'file = "orthoglide"')
    )
    table = "test,step,z_mm,fz_N,at_x_mm,at_y_mm,at_z_mm\ntest-1,0,0.0,0.0,0,0,0\ntest-1,1,0.1,2.0,0,0,0\n"
    if kind != "manipulator":
        table = "\n".join(line.rsplit(",", 3)[0] for line in table.splitlines())
    (tmp_path / "measurements.csv").write_text(table)
    assert read(tmp_path).rig.kind == kind
    with pytest.raises(InputError, match="is there already"):
        init(tmp_path, None, kind)


@pytest.mark.parametrize(
    ("name", "beside", "what"),
    [
        ("Kraft Z [N]", "", "force"),
        ("Load", "kN", "force"),
        ("LoadCell1", "", "force"),
        ("Extension (mm)", "", "length"),
        ("Traverse Position", "", "length"),
        ("Torque", "N·m", "moment"),
        ("Zeit", "s", "time"),
        ("Temp_C", "", "temperature"),
        # What says nothing, or two things, is asked about.
        ("CH1", "", None),
        ("Load", "mm", None),
        ("Force Moment", "", None),
        ("Value", "V", None),
    ],
)
def test_a_quantity_is_that_of_the_unit_or_of_the_words(name: str, beside: str, what: str | None) -> None:
    assert quantity_of(name, beside) == what


def test_no_word_is_of_two_quantities() -> None:
    every = [word for words in WORDS.values() for word in words]
    assert len(every) == len(set(every)) and all(word == word.lower() for word in every)


def test_headers_of_real_loggers_are_guessed_or_asked_about_and_never_wrong() -> None:
    tables = tomllib.loads((Path(__file__).parent / "headers.toml").read_text(encoding="utf-8"))["tables"]
    found = [(what, quantity_of(name, unit), name) for it in tables for name, unit, what in it["columns"]]
    assert not [each for each in found if each[1] is not None and each[1] != each[0]]
    known = [each for each in found if each[0]]
    guessed = [each for each in known if each[1] is not None]
    # Of those that say what they are.
    assert (len(found), len(known), len(guessed)) == (58, 44, 44)


@pytest.mark.parametrize(
    ("content", "others"),
    [
        ("0,0\n0.1,5\n\n0,0\n0.1,5\n0.2,6\n0.3,7\n", ()),
        ("0,0\n0.1,5\n\nTravel (mm),Load (N)\n0,0\n0.1,5\n0.2,6\n", ()),
        ("0,0\n0.1,5\n# dial touched\n0.2,6\n0.3,7\n0.4,8\n", (4,)),
        ("0,0\n0.1,5,ok\n0.2,6\n0.3,7\n0.4,8\n", (3,)),
        ("0,0\n0.1,5\nOVL,OVL\n0.2,6\n0.3,7\n0.4,8\n", (4,)),
    ],
)
def test_what_interrupts_a_table_takes_no_rows_away(
    tmp_path: Path, content: str, others: tuple[int, ...]
) -> None:
    (tmp_path / "a.csv").write_text("Travel (mm),Load (N)\n" + content)
    found = looked(tmp_path / "a.csv")
    assert (found.header_row, found.units_row, found.skip, found.others) == (1, None, 0, others)
    assert found.names == ("Travel (mm)", "Load (N)")
    init(tmp_path / "out", tmp_path / "a.csv", "bar")
    text = (tmp_path / "out" / "campaign.toml").read_text()
    assert "skip =" not in text and ("not like them" in text) is bool(others)


@pytest.mark.parametrize(
    ("content", "separator", "decimal", "header"),
    [
        ("Weg Kraft\n0,5 1,5\n0,6 1,7\n0,7 1,9\n", "space", ",", 1),
        ("Weg;Kraft\n2,500;1 234\n2,501;1 235\n", ";", None, 1),
        ("s;F\n0,5;1,5\n0,6;1,7\n", ";", ",", 1),
        ("Titel\n\nWeg;Kraft\nmm;N\n0,5;1,5\n0,6;1,7\n", ";", ",", 3),
        ("Travel\tLoad\n0.1\t5.0\n0.2\t6.0\n", "tab", ".", 1),
    ],
)
def test_marks_and_headers_that_may_mislead(
    tmp_path: Path, content: str, separator: str, decimal: str | None, header: int
) -> None:
    (tmp_path / "a.txt").write_text(content)
    found = looked(tmp_path / "a.txt")
    assert (found.separator, found.decimal, found.header_row) == (separator, decimal, header)


@pytest.mark.parametrize(
    "name",
    ["Fz_min", "Probe_h", "T_in", "Probe 1", "Reading", "Sample", "Crosshead speed (mm/min)", "Extension (%)"]
    + ["Load rate [N/s]", "Tension [V]", "Strain gauge [µm/m]", "Stiffness [N/mm]", "Temp gradient (K/m)"],
)
def test_what_may_be_something_else_is_asked_about(name: str) -> None:
    assert quantity_of(name) is None


def test_of_several_sheets_with_numbers_one_is_asked_for(tmp_path: Path) -> None:
    book = openpyxl.Workbook()
    cover = book.active
    assert cover is not None
    cover.append(["Blade", "series 4"])
    for name in ("First", "Second"):
        sheet = book.create_sheet(name)
        for row in (("Travel (mm)", "Load (N)"), (0.0, 0.0), (0.1, 5.0)):
            sheet.append(row)
    book.save(tmp_path / "a.xlsx")
    assert looked(tmp_path / "a.xlsx").sheets == ("First", "Second")
    init(tmp_path / "out", tmp_path / "a.xlsx", "bar")
    assert 'sheet = "?"' in (tmp_path / "out" / "campaign.toml").read_text()
    (tmp_path / "a.xlsx").write_bytes(b"another")
    (tmp_path / "out" / "campaign.toml").unlink()
    with pytest.raises(InputError):
        init(tmp_path / "out", tmp_path / "a.xlsx", "bar")


@pytest.mark.parametrize(
    ("content", "header", "names"),
    [
        ('"Travel\n(mm)","Load\n(N)"\n0,0\n0.1,5\n0.2,6\n', 1, ("Travel (mm)", "Load (N)")),
        ('Run 3\n\n"Travel\n\n(mm)",Load (N)\n0,0\n0.1,5\n0.2,6\n', 3, ("Travel (mm)", "Load (N)")),
        ("# bench 3\n# Travel (mm),Load (N)\n0,0\n0.1,5\n0.2,6\n", 2, ("Travel (mm)", "Load (N)")),
        ("# Travel_mm Load_N\n0 0\n0.1 5\n0.2 6\n", 1, ("Travel_mm", "Load_N")),
        ("%Travel_mm\tLoad_N\n0\t0\n0.1\t5\n%stopped\n0.2\t6\n", 1, ("Travel_mm", "Load_N")),
    ],
)
def test_a_header_over_several_lines_or_behind_a_mark(
    tmp_path: Path, content: str, header: int, names: tuple[str, ...]
) -> None:
    (tmp_path / "a.csv").write_text(content)
    found = looked(tmp_path / "a.csv")
    assert (found.header_row, found.names) == (header, names)
    init(tmp_path / "out", tmp_path / "a.csv", "bar")
    filled_in(tmp_path / "out")
    path = tmp_path / "out" / "campaign.toml"
    text = path.read_text().replace('is = "?"', 'is = "z"', 1).replace('is = "?"', 'is = "fz"', 1)
    path.write_text(text)
    (test,) = read(tmp_path / "out").tests
    assert test.data.displacement[:, 2].tolist() == [0.0, -0.1, -0.2]
    assert test.data.wrench[:, 2].tolist() == [0.0, -5.0, -6.0]


def test_of_a_date_and_its_time_the_one_that_goes_on_is_the_time(tmp_path: Path) -> None:
    rows = "\n".join(f"2026-11-25,10:0{k}:00,{0.1 * k},{5 * k}" for k in range(4))
    (tmp_path / "a.csv").write_text(f"Date,Time,Travel (mm),Load (N)\n{rows}\n")
    init(tmp_path / "out", tmp_path / "a.csv", "bar")
    raw = tomllib.loads((tmp_path / "out" / "campaign.toml").read_text())
    assert raw["file"]["time_column"] == "Time" and raw["columns"]["Date"] == {"is": "ignore"}


@pytest.mark.parametrize("kind", ["bar", "parallelogram"])
def test_the_tests_are_those_that_the_rows_name(tmp_path: Path, kind: str) -> None:
    rows = "\n".join(
        f'"{test}",{0.1 * k},{5 * k}' for test in ("lateral", "axial +30", "lateral") for k in range(3)
    )
    (tmp_path / "a.csv").write_text(f"Test,Travel (mm),Load (N)\n{rows}\n")
    init(tmp_path / "out", tmp_path / "a.csv", kind)
    raw = tomllib.loads((tmp_path / "out" / "campaign.toml").read_text())
    assert [test["id"] for test in raw["tests"]] == ["lateral", "axial +30"]
    assert raw["tests"][0] == {**raw["tests"][1], "id": "lateral"}


ROOT = Path(__file__).parents[3]


@pytest.mark.parametrize("kind", ["bar", "parallelogram"])
@pytest.mark.parametrize("source", ["plain_i_bar", str(ROOT / "reports" / "validation" / "result.json")])
def test_a_bar_may_be_taken_from_a_case_or_a_result(tmp_path: Path, kind: str, source: str) -> None:
    """The case's rigidities are those of its section, the result's K_b is the identified one."""
    init(tmp_path, None, kind, source)
    path = tmp_path / "campaign.toml"
    path.write_text(path.read_text().replace('q_deg = "?"', "q_deg = 0.0"))
    (tmp_path / "measurements.csv").write_text("test,step,z_mm,fz_N\ntest-1,0,0.0,0.0\ntest-1,1,0.1,2.0\n")
    rig = read(tmp_path).rig
    assert rig.length == 310.0 and rig.spread == (80.0 if kind == "parallelogram" else None)
    if source == "plain_i_bar":
        area = 2 * 12.0 * 2.2 + 4.0 * (15.5 - 2 * 2.2)
        assert rig.bar is not None and pytest.approx(7e4 * area, rel=1e-12) == rig.bar.EA
        return
    identified = json.loads(Path(source).read_text())["bar"]["stiffness"]
    np.testing.assert_allclose(rig.stiffness, identified, rtol=1e-6, atol=1e-6 * np.abs(identified).max())


@pytest.mark.parametrize(
    ("kind", "source", "said"),
    [
        ("bar", "orthoglide", "its bar is searched for; run it, and give its result.json"),
        ("bar", "nothing", "case 'nothing' is unknown"),
        ("bar", "nothing.json", "nothing.json: is missing"),
        ("manipulator", "plain_i_bar", "a manipulator is described in its own file"),
    ],
)
def test_a_bar_that_is_not_there_is_said(tmp_path: Path, kind: str, source: str, said: str) -> None:
    with pytest.raises(InputError, match=said):
        init(tmp_path / "c", None, kind, source)
    assert not (tmp_path / "c").exists()
    (tmp_path / "a.json").write_text("{}")
    with pytest.raises(InputError, match="is no result of run"):
        init(tmp_path / "c", None, "bar", str(tmp_path / "a.json"))


@pytest.mark.parametrize("suffix", sorted(by_suffix()))
def test_a_file_that_is_not_there_is_missing_whatever_its_format(suffix: str, tmp_path: Path) -> None:
    file = tmp_path / f"none{suffix}"
    with pytest.raises(InputError) as caught:
        init(tmp_path / "out", file, "bar")
    assert str(caught.value) == f"{file} is missing, allowed is a file of readings"


@pytest.mark.parametrize("row", ["0,0000,-0,0024", "50,-0,0024"])
def test_decimal_commas_between_commas_are_refused(tmp_path: Path, row: str) -> None:
    file = tmp_path / "r.csv"
    file.write_text("\n".join(["Load [N],Dial [mm]", *[row] * 5]) + "\n")
    with pytest.raises(BadTable, match="decimal commas between commas"):
        looked(file)


@pytest.mark.parametrize("row", ["5,7,", "5,7,,", "5.5,7.5", "5,7"])
def test_whole_numbers_and_empty_cells_are_not(tmp_path: Path, row: str) -> None:
    file = tmp_path / "r.csv"
    file.write_text("\n".join(["Load [N],Dial [mm]", *[row] * 5]) + "\n")
    assert looked(file).separator == ","
