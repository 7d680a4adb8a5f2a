"""What might be read as something else than the file says: each of these is read right, or refused with a sentence."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import openpyxl
import pytest
from nptdms import ChannelObject, GroupObject, TdmsWriter

from pipeline.campaign import BadCampaign, Campaign, read
from tests.pipeline.campaign.mapped_tables import (
    FZ,
    ONE,
    SIMPLE,
    TEST,
    TWO,
    Z,
    assert_agrees,
    assert_refused,
    campaign,
    table,
)

S = SIMPLE.format(z="mm", fz="N")
GAUGES = '[[gauges]]\nname = "{0}"\nstation = 0.5\ndirection = "z"\n'


def forces(found: Campaign, test: int = 0) -> list[float]:
    return found.tests[test].data.wrench[:, 2].tolist()


@pytest.mark.parametrize("remark", ['"', '"hit the stop'])
def test_a_lone_quote_mark_swallows_no_rows(tmp_path: Path, remark: str) -> None:
    content = f"Travel,Load,Remark\n0,0,start\n0.1,5,{remark}\n0.2,10,{remark}\n0.3,15,\n"
    assert_refused(
        tmp_path, S + '"Remark" = { is = "ignore" }\n', content, "line 3: cannot be split", "lone quote mark"
    )


@pytest.mark.parametrize(
    ("head", "unit"),
    [
        ("Load (lbs)", "N"),
        ("Load (kg)", "N"),
        ("Load (KN)", "N"),
        ("Load [kN]", "N"),
        ("Load (mm)", "N"),
        ("Load/kN", "N"),
    ],
)
def test_a_unit_that_differs_is_refused_whatever_it_is(tmp_path: Path, head: str, unit: str) -> None:
    columns = f'[columns]\n"{head}" = {{ is = "fz", unit = "{unit}" }}\n'
    assert_refused(tmp_path, columns, f"{head}\n1\n", f"has the unit {unit}, but the file says")


@pytest.mark.parametrize(
    ("head", "unit"), [("Load (lbs)", "lbf"), ("Load (KN)", "kN"), ("Load (left)", "N"), ("Load CH1", "N")]
)
def test_what_a_spelling_may_mean_is_what_was_declared(tmp_path: Path, head: str, unit: str) -> None:
    columns = f'[columns]\n"{head}" = {{ is = "fz", unit = "{unit}" }}\n'
    assert forces(campaign(tmp_path, columns, f"{head}\n0\n0\n")) == [0, 0]


def test_a_row_of_units_is_compared_too(tmp_path: Path) -> None:
    assert_refused(
        tmp_path, "[file]\nunits_row = 2\n" + S, "Travel,Load\nmil,lbs\n0,0\n", "but the file says lbs"
    )


def test_a_zero_of_the_first_row_is_that_of_a_test_over_all_its_files_in_the_order_of_their_numbers(
    tmp_path: Path,
) -> None:
    for number, (z, fz) in {1: ("0", "100"), 2: ("0.1", "105"), 10: ("0.2", "110")}.items():
        (tmp_path / f"run_{number}.csv").write_text(f"t,Travel,Load\n{number},{z},{fz}\n")
    columns = S.replace('unit = "N"', 'unit = "N", zero = "first_row"')
    found = campaign(tmp_path, '[file]\npath = "run_*.csv"\ntime_column = "t"\n' + columns)
    assert forces(found) == [0.0, 5.0, 10.0]
    (tmp_path / "run_2.csv").write_text("t,Travel,Load\n11,0.1,105\n")
    with pytest.raises(
        BadCampaign, match=r"run_10\.csv line 2, column 't': is '10', earlier than the row before it"
    ):
        read(tmp_path)


def test_a_zero_that_was_not_read_is_asked_about(tmp_path: Path) -> None:
    columns = '[file]\nmissing = ["OVL"]\n' + S.replace('unit = "mm"', 'unit = "mm", zero = "first_row"')
    assert_refused(
        tmp_path,
        columns,
        "Travel,Load\nOVL,0\n1,5\n",
        "has no reading in the first row of test 'load', which is to be its zero",
    )


def test_a_sensor_that_was_not_used_in_a_test_needs_no_zero_there(tmp_path: Path) -> None:
    tests = "".join(TEST.format(id=n) for n in ("load", "again"))
    columns = S.replace('unit = "mm"', 'unit = "mm", zero = "first_row"')
    content = "test,Travel,Load\nload,2.5,0\nload,2.6,5\nagain,,0\nagain,,7\n"
    found = campaign(tmp_path, columns, content, tests=tests)
    np.testing.assert_allclose(found.tests[0].data.displacement[:, 2], [0.0, 0.1], atol=1e-12)
    assert np.isnan(found.tests[1].data.displacement[:, 2]).all()


def test_rows_without_a_test_are_not_left_out_in_silence(tmp_path: Path) -> None:
    content = "test,Travel,Load\nload,0,0\n,0.1,5\n,0.2,7\n,,pause\n"
    columns = '[file]\nmissing = ["pause"]\n' + S
    said = "line 3, column 'test': 2 rows from here on have numbers and no test"
    assert_refused(tmp_path, columns, content, said, "write fill_down = ['test'] under [file]")


def test_rows_of_a_shared_file_are_counted_once(tmp_path: Path) -> None:
    content = "test,Travel,Load\nload,0,0\nload,0.1,5\nagain,0,0\nagain,0.2,7\n"
    (tmp_path / "all.csv").write_text(content)
    tests = "".join(TEST.format(id=n) + 'file = { path = "all.csv" }\n' for n in ("load", "again"))
    found = campaign(tmp_path, S, tests=tests)
    assert forces(found) == [0.0, 5.0] and forces(found, 1) == [0.0, 7.0]


def test_a_test_with_its_own_file_has_no_rows_of_a_shared_pattern(tmp_path: Path) -> None:
    for name, factor in (("load", 1.0), ("again", 1e-3)):
        (tmp_path / f"{name}.dat").write_text(table(["Travel", "Load"], Z, factor * FZ))
    own = 'file = { path = "again.dat" }\ncolumns = { "Load" = { is = "fz", unit = "kN" } }\n'
    tests = ONE + TEST.format(id="again") + own
    found = campaign(tmp_path, '[file]\npath = "*.dat"\ntest_from = "file"\n' + S, tests=tests)
    assert_agrees(found)
    assert_agrees(found, test=1)


def test_blocks_are_counted_over_all_files_and_names_must_differ(tmp_path: Path) -> None:
    for name in ("a", "b"):
        (tmp_path / f"{name}.txt").write_text(table(["Travel", "Load"], Z, FZ))
    found = campaign(tmp_path, '[file]\npath = "?.txt"\ntest_from = "blank_row"\n' + S, tests=TWO)
    assert_agrees(found)
    assert_agrees(found, test=1)
    assert_refused(
        tmp_path, '[file]\npath = "?.txt"\ntest_from = "blank_row"\n' + S, "", "has 2 blocks of rows"
    )
    for name in ("a", "b"):
        (tmp_path / name).mkdir()
        (tmp_path / name / "load.txt").write_text(table(["Travel", "Load"], Z, FZ))
    assert_refused(
        tmp_path, '[file]\npath = "*/load.txt"\ntest_from = "file"\n' + S, "", "so both would be test 'load'"
    )


def test_errors_and_formulas_without_a_value_are_no_empty_cells(tmp_path: Path) -> None:
    book = openpyxl.Workbook()
    sheet = book.active
    assert sheet is not None
    for row in (("Travel", "Load", "Note"), (0.0, 0.0, "#N/A"), (0.1, "=B2+1", None)):
        sheet.append(row)
    sheet["B2"].value, sheet["B2"].data_type = "#DIV/0!", "e"
    book.save(tmp_path / "a.xlsx")
    tables = '[file]\npath = "a.xlsx"\n' + S + '"Note" = { is = "ignore" }\n'
    said = ("line 2, column 'Load': holds '#DIV/0!'", "line 3, column 'Load': holds '=B2+1 (never computed)'")
    assert_refused(tmp_path, tables, "", *said)


def test_channels_that_make_no_rows_and_text_in_channels(tmp_path: Path) -> None:
    def written(*channels: ChannelObject) -> None:
        with TdmsWriter(str(tmp_path / "a.tdms")) as writer:
            writer.write_segment([GroupObject("g"), *channels])

    layout = '[file]\npath = "a.tdms"\nunits_row = 2\ndecimal = ","\nthousands = "."\n' + S
    written(ChannelObject("g", "Travel", Z[:3]), ChannelObject("g", "Load", FZ))
    assert_refused(tmp_path, layout, "", "channels of different lengths (3, 5)")
    written(ChannelObject("g", "Travel", Z[:2]), ChannelObject("g", "Load", ["1.234", "2.345,5"]))
    assert forces(campaign(tmp_path, layout)) == [1234.0, 2345.5]


def test_a_row_that_is_too_short_is_said_without_a_header_too(tmp_path: Path) -> None:
    layout = '[file]\nheader_row = 0\nseparator = "space"\n[columns]\n"#1" = { is = "ignore" }\n'
    layout += '"#2" = { is = "z", unit = "mm" }\n"#3" = { is = "fz", unit = "N" }\n'
    assert_refused(
        tmp_path, layout, "0.0 0.00 0.0\n0.0 10.0\n0.0 0.30 15.0\n", "line 2: has 2 cells, others have 3"
    )


@pytest.mark.parametrize(
    ("derived", "said"),
    [
        (
            'rz = { of = { "D1 (in)" = 1 }, unit = "um", over_mm = 60.0 }',
            "has the unit µm, but the file says in",
        ),
        (
            'z = { of = { "D1 (in)" = 1 }, unit = "in", over_mm = 60.0 }',
            "has over_mm, which gives an angle",
        ),
        ('rz = { of = { "D1 (in)" = 1 }, unit = "in" }', "in is a length, this is an angle"),
    ],
)
def test_sums_of_columns_are_looked_at_as_columns_are(tmp_path: Path, derived: str, said: str) -> None:
    tables = f'[columns]\n"Load" = {{ is = "fz", unit = "N" }}\n[derived]\n{derived}\n'
    assert_refused(tmp_path, tables, "D1 (in),Load\n0,0\n", said)


def test_a_mean_of_two_thermometers_is_a_temperature(tmp_path: Path) -> None:
    tables = S + '[derived]\ntemperature = { of = { "T1" = 0.5, "T2" = 0.5 }, unit = "degF" }\n'
    found = campaign(tmp_path, tables, "Travel,Load,T1,T2\n0,0,68,68\n")
    assert found.tests[0].data.temperature == pytest.approx([20.0])


def test_a_column_of_the_contract_in_a_mapped_table_is_read_by_its_name(tmp_path: Path) -> None:
    found = campaign(tmp_path, S, "Travel,Load,temperature_C\n0,0,21.5\n")
    assert found.tests[0].data.temperature == pytest.approx([21.5])


def test_words_for_no_reading_may_be_numbers_and_are_no_load(tmp_path: Path) -> None:
    layout = '[file]\nmissing = ["-99"]\n' + S
    found = campaign(tmp_path, layout, "Travel,Load\n0,0\n-99.0,5\n")
    assert np.isnan(found.tests[0].data.displacement[1, 2])
    said = "line 3, column fz_N: has a word for no reading, but test 'load'"
    assert_refused(tmp_path, layout, "Travel,Load\n0,0\n0.1,-99\n", said)


def test_a_cell_needs_its_components_in_every_row(tmp_path: Path) -> None:
    columns = '[columns]\n"fx" = { is = "fx", unit = "N" }\n"fy" = { is = "fy", unit = "N" }\n'
    columns += "[cell]\nturned_deg = [0, 0, 45]\n"
    assert_refused(
        tmp_path, columns, "fx,fy\n0,0\n2,\n", "line 3, [cell]: fx at the platform needs fy as well"
    )


@pytest.mark.parametrize(
    ("file", "content", "said"),
    [
        ('decimal = ","\nthousands = ","', "Travel,Load\n0,0\n", "thousands is the decimal mark"),
        ('encoding = "punycode"', "Travel,Load\n0,0\n", "encoding"),
        ('time_column = "t"', "t,Travel,Load\n0,0,0\nMax,0.2,10\n", "is 'Max', which is no time"),
        (
            'time_column = "t"',
            "t,Travel,Load\n01.02.2024 10:00:00,0,0\n01.02.2024 09:00:00,0.2,10\n",
            "earlier than the row",
        ),
        ('time_column = "t"', "t,Travel,Load\n50000,0,0\n0,0.2,10\n", "earlier than the row before it"),
        ("", "Travel,,Load\n0,7,0\n", "column '#2': is not declared"),
        ("", "Travel,Load,step,Step\n0,0,0,1\n", "column 'Step': is not declared"),
    ],
)
def test_what_does_not_fit_is_said(tmp_path: Path, file: str, content: str, said: str) -> None:
    assert_refused(tmp_path, f"[file]\n{file}\n" + S, content, said)


@pytest.mark.parametrize(
    ("entry", "said"),
    [
        ('"T" = { is = "temperature", unit = "degC", sign = -1 }', "a temperature has neither"),
        ('"T" = { is = "step", zero = 3 }', "step has none"),
        ('"T" = { is = "mx", unit = "N/mm" }', "'N/mm' is no unit that is known"),
        ('"T" = { is = "z", unit = "mm", sign = "-" }', "sign is '-', allowed is 1 or -1"),
        ('"T" = { is = "z", unit = "mm", zero = "3.2" }', "zero is '3.2', allowed is a number or"),
    ],
)
def test_an_entry_that_makes_no_sense_is_one_sentence(tmp_path: Path, entry: str, said: str) -> None:
    assert_refused(tmp_path, f"[columns]\n{entry}\n", "T\n0\n", said)


def test_mistakes_of_the_description_and_of_its_files_come_at_once(tmp_path: Path) -> None:
    """A column that is not decided yet is one complaint; the rest of the table is looked at all the same."""
    tables = '[columns]\n"a" = { is = "?" }\n"b" = { is = "fz", unit = "N" }\n[cell]\nat_mm = [0, 0, 5]\n'
    with pytest.raises(BadCampaign) as caught:
        campaign(tmp_path, tables, "a,b\n0,0\n1,bad\n")
    first, second = caught.value.complaints
    assert "campaign.toml line 14, columns.'a'" in first and "not decided yet" in first
    assert "measurements.csv line 3, column 'b': holds 'bad'" in second, second


def test_a_file_that_is_no_table_of_toml_is_said(tmp_path: Path) -> None:
    assert_refused(tmp_path, S, "Travel,Load\n0,0\n", "file", "a table", tests=ONE + 'file = "load.csv"\n')


def test_two_columns_of_steps_and_a_gauge_with_a_taken_name(tmp_path: Path) -> None:
    columns = S + '"a" = { is = "step" }\n"b" = { is = "step" }\n'
    assert_refused(tmp_path, columns, "Travel,Load,a,b\n0,0,0,0\n", "column 'b': is step, as column 'a' is")
    assert_refused(
        tmp_path, GAUGES.format("time") + S, "Travel,Load\n0,0\n", "a gauge named time cannot be told"
    )


def test_fill_down_repeats_over_nothing_but_empty_cells(tmp_path: Path) -> None:
    layout = '[file]\nfill_down = ["test"]\nmissing = ["OVL"]\n' + S
    found = campaign(tmp_path, layout, "test,Travel,Load\nload,0,0\n,OVL,5\n")
    assert np.isnan(found.tests[0].data.displacement[1, 2]) and forces(found) == [0.0, 5.0]


def test_skipped_rows_are_rows_of_data(tmp_path: Path) -> None:
    layout = '[file]\nskip = 1\ncomment = "#"\n' + S
    found = campaign(tmp_path, layout, "Travel,Load\n\n# cold\n9.9,99\n0,0\n0.1,5\n")
    assert forces(found) == [0.0, 5.0]


@pytest.mark.parametrize(
    ("content", "file"),
    [
        ("Travel\tLoad\n0.0\t0.0\n0.5\t5.0\n", ""),
        ("Travel;Load\n0.0;0.0;\n0.5;5.0;\n", ""),
        ("Travel;Load\n0,0;0\n0,5;5\n", ""),
        ("Travel;Load\n0.0E+00;0\n5.000E-01;5\n", ""),
        ("Travel;Load\n0,0;0\n0,5;5,000\n", 'decimal = ","'),
    ],
)
def test_good_files_are_not_refused(tmp_path: Path, content: str, file: str) -> None:
    found = campaign(tmp_path, f"[file]\n{file}\n" + S, content)
    assert found.tests[0].data.displacement[:, 2].tolist() == [0.0, 0.5] and forces(found) == [0.0, 5.0]


def test_groups_of_typesetting_are_groups(tmp_path: Path) -> None:
    layout = '[file]\ndecimal = ","\nthousands = " "\n' + S
    assert forces(campaign(tmp_path, layout, "Travel;Load\n0,5;1\u202f234,5\n")) == [1234.5]
    columns = SIMPLE.format(z="mm", fz="mN")
    found = campaign(tmp_path, '[file]\nthousands = " "\n' + columns, "Travel;Load\n2,5;1 234\n2,75;5\n")
    assert found.tests[0].data.displacement[0, 2] == 2.5 and forces(found) == [1.234, 0.005]


@pytest.mark.parametrize("said", [1, 2, 4])
def test_a_header_in_another_line_is_one_sentence_with_the_line_to_write(tmp_path: Path, said: int) -> None:
    content = f"Board A,tested by M.\nroom,19 degC\n{table(['Travel', 'Load'], Z, FZ)}"
    with pytest.raises(BadCampaign) as caught:
        campaign(tmp_path, f"[file]\nheader_row = {said}\n{S}", content)
    (sentence,) = str(caught.value).splitlines()
    assert f"line {said}: holds none of the 2 columns that are declared, line 3 holds 2" in sentence
    assert sentence.endswith("write header_row = 3 under [file]")
    assert_agrees(campaign(tmp_path, f"[file]\nheader_row = 3\n{S}", content))
