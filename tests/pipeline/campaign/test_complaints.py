"""Bad campaigns: every mistake is a sentence that names file, place, what was found and what is allowed."""

from pathlib import Path

import pytest

from pipeline.campaign import BadCampaign, read
from pipeline.errors import InputError
from tests.pipeline.campaign.example import BAR, BAR_CSV, CSV, TOML, laid


def refused(folder: Path) -> BadCampaign:
    """What is raised, after a look at the form of its sentences."""
    with pytest.raises(BadCampaign) as caught:
        read(folder)
    assert isinstance(caught.value, InputError) and caught.value.complaints
    for sentence in caught.value.complaints:
        assert str(folder) in sentence and sentence.isprintable() and ":" in sentence
    return caught.value


def changed(text: str, old: str, new: str) -> str:
    assert old in text
    return text.replace(old, new, 1)


SIX = (
    "rig = { bar_stiffness = ["
    + ",".join(str([float(9 * (i == j)) for j in range(6)]) for i in range(6))
    + "]"
)
DESCRIPTION = {
    "other schema": ("schema = 1", "schema = 2", "line 1, schema: is 2, allowed is 1"),
    "schema is text": ("schema = 1", 'schema = "1"', "line 1, schema: is '1', allowed is: a valid integer"),
    "no schema": ("schema = 1", "", "schema: is missing"),
    "no toml": ("[rig]", "[rig", "is no TOML: Expected ']' at the end of a table declaration (at line 4"),
    "unknown table": ("[noise]", "[noises]", "line 14, noises: is not a key of this table, did you mean 'noise'?"),
    "unknown key": ("length_mm = 310.0", "lenght_mm = 310.0", "line 6, rig.lenght_mm: is not a key of this table, "
                    "did you mean 'length_mm'?"),
    "missing key": ("length_mm = 310.0\n", "", "line 4, rig.length_mm: is missing"),
    "kind": ('"parallelogram"', '"delta"', "rig.kind: is 'delta', allowed is: 'bar', 'manipulator' or 'parallelogram'"),
    "length": ("length_mm = 310.0", "length_mm = -310.0", "rig.length_mm: is -310.0, allowed is: at least 0.001"),
    "true is no number": ("width_mm = 80.0", "width_mm = true", "rig.width_mm: is True, allowed is: a valid number"),
    "infinite": ("width_mm = 80.0", "width_mm = inf", "rig.width_mm: is inf, allowed is: a finite number"),
    "no width": ("width_mm = 80.0", "", "rig: width_mm is missing, a parallelogram needs it"),
    "neither": ("\nbar = {", "\n# {", "none of bar_stiffness, bar_from, bar and section is given, allowed is one"),
    "both": ("gravity", f"{SIX[8:]}\ngravity", "rig: bar_stiffness and bar are given, allowed is one"),
    "key of bar": ("GJ_Nmm2", "GJ_Nm2", "rig.bar.GJ_Nm2: is not a key of this table, did you mean 'GJ_Nmm2'?"),
    "no use": ("EIy_Nmm2 = 1.98e8", "EIy_Nmm2 = 1e-3", "the 6x6 of bar at this length cannot be used: K33 is"),
    "base": ("width_mm = 80.0", 'width_mm = 80.0\nbase = "clamped"', 'base is given, allowed only with kind = "bar"'),
    "weight": ("gravity = [0, 0, -2]", "", "a weight is given without its direction"),
    "no gravity": ("[0, 0, -2]", "[0, 0, 0]", "rig.gravity: allowed is a direction other than zero"),
    "sigma zero": ("x_mm = 0.001", "x_mm = 0.0", "line 15, noise.x_mm: is 0.0, allowed is: at least 1e-12"),
    "sigma negative": ("x_mm = 0.001", "x_mm = -0.001", "noise.x_mm: is -0.001, allowed is: at least"),
    "sigma of what": ("x_mm = 0.001", "x_m = 0.001", "noise.x_m: has the unit m, allowed is x_mm"),
    "sigma of no gauge": ("mid_mm =", "midd_mm =", "noise.midd_mm: is unknown, did you mean 'mid_mm'?"),
    "station": ("station = 0.5", "station = 1.5", "gauge 'mid', station: is 1.5, allowed is: at most 1"),
    "bar number": ("bar = 1", "bar = 3", "gauge 'mid', bar: is 3, allowed is: at most 2"),
    "direction": ('"-y"', '"up"', "gauge 'mid', direction: is 'up', allowed is: 'x', 'y', 'z', '-x', '-y' or '-z'"),
    "gauge twice": ("[[tests]]", '[[gauges]]\nname="mid"\nstation=1\ndirection="x"\n[[tests]]', "gauge 'mid': is"),
    "gauge is column": ('name = "mid"', 'name = "z"', "gauge 'z': is taken"),
    "gauge is word": ('name = "mid"', 'name = "force"', "gauge 'force': is taken"),
    "role itself": ('"fit"', '"train"', "test 'axial_q+30', role: is 'train', allowed is: 'fit' or 'holdout'"),
    "no fit": ('"fit"', '"holdout"', 'tests: no test has role = "fit", allowed are one or more'),
    "angle": ("q_deg = 30.0", "q_deg = 90.0", "line 32, test 'axial_q+30', q_deg: is 90.0, allowed is: at most 85"),
    "no angle": ("q_deg = 30.0", "", "test 'axial_q+30': q_deg is missing"),
    "id twice": ('"lateral"', '"axial_q+30"', "line 37, test 'axial_q+30': is there twice"),
    "id": ('"lateral"', '"lateral "', "allowed is printable text without blanks at its ends"),
    "no such gauge": ('"mid", z', '"middle", z', "y is 'middle', neither displacement nor force nor held nor a gauge"),
    "control": ('y = "mid"', 'y = "Force"', "y is 'Force', neither displacement nor force nor held nor a gauge; did"),
    "control missing": ('rx = "force", ', "", "test 'axial_q+30', control: rx missing"),
    "no coordinate": ("rx =", "Rx =", "'Rx' is no coordinate, did you mean 'rx'?"),
    "gauge for two": ('x = "force", y = "mid"', 'x = "mid", y = "mid"', "gauge mid controls two coordinates"),
    "zero": ('"first_row"', '"tare"', "test 'lateral', zero: is 'tare', allowed is: 'nominal'"),
    "override kind": ("{ length_mm = 250.0 }", '{ kind = "bar" }', "test 'lateral', rig: kind is 'bar', a test keeps"),
    "override key": ("{ length_mm = 250.0 }", "{ lenght_mm = 9 }", "test 'lateral', rig, lenght_mm: is not a key"),
    "table for list": ("[[gauges]]", "[gauges]", "gauges: is a table, allowed is: a list"),
}  # fmt: skip


@pytest.mark.parametrize("name", DESCRIPTION)
def test_description_is_refused_with_a_sentence(name: str, tmp_path: Path) -> None:
    old, new, said = DESCRIPTION[name]
    error = refused(laid(tmp_path, changed(TOML, old, new)))
    assert said in str(error) and str(tmp_path / "campaign.toml") in str(error), str(error)


BARS = {
    "unsymmetric": ("0.0, -2400.0, 0.0, 0.0, 0.0, 6.4e5", "0.0, -2000.0, 0.0, 0.0, 0.0, 6.4e5",
                    "rig.bar_stiffness: K26 is -2400 but K62 is -2000, a difference of 0.14"),
    "indefinite": ("6.4e5", "4.7e5", "lowest eigenvalue is -0.01"),
    "diagonal": ("4000.0,", "-4000.0,", "K11 is -4000, allowed on the diagonal"),
    "not six": ("    [4000.0, 0.0, 0.0, 0.0, 0.0, 0.0],\n", "", "has 5 rows of [6] numbers, allowed are 6 rows of 6"),
    "width": ("length_mm = 400.0", "length_mm = 400.0\nwidth_mm = 8.0", "width_mm is given, allowed only with kind"),
    "tip": ('"guided"', '"welded"', "rig.tip: is 'welded', allowed is: 'free', 'pinned' or 'guided'"),
    "held": ('z = "force"', 'z = "force", rz = "displacement"', "rz is held by the guided tip already"),
    "angle": ('role = "fit"', 'role = "fit"\nq_deg = 10.0', "q_deg is 10.0, a bar lies along x"),
    "length of a 6x6": ('role = "fit"', 'role = "fit"\nrig = { length_mm = 300.0 }', "length_mm is overridden"),
    "second bar": ("[[tests]]", '[[gauges]]\nname="g"\nbar=2\nstation=1\ndirection="x"\n[[tests]]', "bar is 2"),
}  # fmt: skip


@pytest.mark.parametrize("name", BARS)
def test_bar_is_refused_with_a_sentence(name: str, tmp_path: Path) -> None:
    old, new, said = BARS[name]
    assert said in str(refused(laid(tmp_path, changed(BAR, old, new), BAR_CSV)))


HEADERS = {
    "x_m": "has the unit m, allowed is x_mm (millimetres): convert the numbers, not only the name",
    "x (µm)": "has the unit µm, allowed is x_mm",
    "x": "names no unit, allowed is x_mm (millimetres)",
    "X_mm": "is spelled in another way, allowed is x_mm",
    "x_MM": "has its unit in another case, allowed is x_mm",
    "rx_deg": "has the unit deg, allowed is rx_rad (radians)",
    "Fx_N": "is spelled in another way, allowed is fx_N",
    "fx_kN": "has the unit kN, allowed is fx_N (newtons)",
    "fx [N]": "is spelled in another way, allowed is fx_N",
    "mx_Nm": "has the unit Nm, allowed is mx_Nmm (newton millimetres)",
    "temperature_K": "has the unit K, allowed is temperature_C (degrees Celsius)",
    "mid_um": "has the unit um, allowed is mid_mm",
    "colour": "is unknown, allowed: test, step, x_mm",
    "temprature_C": "is unknown, did you mean 'temperature_C'?",
}


@pytest.mark.parametrize("name", HEADERS)
def test_another_unit_is_refused_and_never_guessed(name: str, tmp_path: Path) -> None:
    rows = CSV.splitlines()
    csv = "\n".join([f"{rows[0]},{name}", *(f"{row},0.0" for row in rows[1:])])
    error = refused(laid(tmp_path, csv=csv))
    # One complaint, and what else can be done with such a table.
    assert len(error.complaints) == 2 and error.complaints[1].endswith(
        f"init NEW {tmp_path / 'measurements.csv'} writes both"
    )
    said = error.complaints[0].removeprefix(f"{tmp_path / 'measurements.csv'} line 1, column {name}: ")
    assert said.startswith(HEADERS[name]) or (name in ("colour", "temprature_C") and HEADERS[name] in said), (
        said
    )


MEASUREMENTS = {
    "missing column": ("test,step,x_mm", "test,step,w_mm", "column x_mm: is missing, but test 'axial_q+30' controls x"),
    "no test column": ("test,step", "tset,step", "line 1, column test: is missing"),
    "column twice": ("y_mm,z_mm", "y_mm,y_mm", "line 1, column y_mm: is there twice"),
    "column without name": ("temperature_C\n", "\n", "line 1: column 10 has no name"),
    "empty controlled": ("2,0.01,", "2,,", "line 3, column x_mm: is empty, but test 'axial_q+30' controls x by disp"),
    "empty gauge": ("9.5,0.25", "9.5,", "line 6, column mid_mm: is empty, but test 'lateral' controls y by gauge mid"),
    "steps unsorted": ("q+30,2", "q+30,7", "line 4, test 'axial_q+30': step 5 comes after step 7"),
    "step is no number": ("q+30,2", "q+30,two", "line 3, column step: holds 'two', allowed is a whole number"),
    "step is a fraction": ("q+30,2", "q+30,2.5", "line 3, column step: holds '2.5'"),
    "unknown test": ("lateral,2", "laterel,2", "names test 'laterel', which campaign.toml does not have; did you mean"),
    "no test": ("lateral,2", ",2", "line 6, column test: is empty"),
    "nan": ("430.25", "NaN", "line 3, column fx_N: holds 'NaN', allowed is a finite number, or an empty cell"),
    "inf": ("430.25", "-inf", "column fx_N: holds '-inf', allowed is a finite number"),
    "text": ("430.25", "430.25 N", "column fx_N: holds '430.25 N', allowed is a number"),
    "underscore": ("430.25", "43_0.25", "column fx_N: holds '43_0.25', allowed is a number"),
    "other digits": ("430.25", "٤٣٠", "column fx_N: holds '٤٣٠', allowed is a number"),
    "huge": ("430.25", "1e400", "column fx_N: holds '1e400', allowed is a magnitude up to 1e+09"),
    "decimal comma": ("430.25", '"430,25"', "line 3, column fx_N: holds '430,25', a decimal comma"),
    "decimal comma bare": ("430.25", "430,25", "line 3: has 11 cells, the header has 10; is there a decimal comma"),
    "too few": (",430.25,,0.001,20.6", "", "line 3: has 6 cells, the header has 10"),
    "open quote": ("430.25", '"430.25', "line 3: cannot be split into cells: unexpected end of data"),
    "degrees": ("-1e-05", "2.5", "line 3, column rz_rad: reads 2.5 rad in test 'axial_q+30', allowed is at most 1;"),
    "micrometres": ("2,0.01,0.0003", "2,0.01,2000.0", "column y_mm: reads 2000 mm in test 'axial_q+30', bars of 310"),
    "too cold": ("20.6", "-300", "column temperature_C: reads -300, allowed is -273.15"),
}  # fmt: skip


@pytest.mark.parametrize("name", MEASUREMENTS)
def test_measurements_are_refused_with_a_sentence(name: str, tmp_path: Path) -> None:
    old, new, said = MEASUREMENTS[name]
    error = refused(laid(tmp_path, csv=changed(CSV, old, new)))
    assert said in str(error) and str(tmp_path / "measurements.csv") in str(error), str(error)


def test_other_separators_are_one_sentence(tmp_path: Path) -> None:
    for mark, named in ((";", "semicolons"), ("\t", "tabs")):
        error = refused(laid(tmp_path, csv=CSV.replace(".", ",").replace(",", mark)))
        first, otherwise = error.complaints
        assert f"line 1: cells are separated by {named}" in first and "init NEW" in otherwise


def test_temperature_needs_its_reference(tmp_path: Path) -> None:
    error = refused(laid(tmp_path, changed(TOML, "reference_temperature_C = 20.0", "")))
    assert len(error.complaints) == 2 and "reference_temperature_C" in str(error)


def test_a_test_without_rows_is_named(tmp_path: Path) -> None:
    error = refused(laid(tmp_path, csv=CSV[: CSV.index("lateral")]))
    assert "test 'lateral': has no rows" in str(error)


FILES = {
    "empty": (b"", "is empty"),
    "blank": (b" \n\n", "is empty"),
    "no header": (
        CSV.partition("\n")[2].encode(),
        "line 1: is no header: it has none of the column names test",
    ),
    "header only": (CSV.splitlines()[0].encode(), "has a header but no rows"),
    "binary": (CSV.encode() + b"\x00\x01", "line 7: is a binary file, allowed is text"),
    "not utf-8": (CSV.replace("430.25", "4\xb530").encode("latin-1"), "line 3: byte 0xb5 is no UTF-8"),
    "utf-16": (CSV.encode("utf-16"), "is written in UTF-16, allowed is UTF-8"),
    "endless cell": (CSV.encode() + b"lateral,3," + b"1" * 200_000, "line 7: cannot be split into cells"),
}


@pytest.mark.parametrize("name", FILES)
def test_what_is_no_table_is_refused(name: str, tmp_path: Path) -> None:
    content, said = FILES[name]
    error = refused(laid(tmp_path, csv=content))
    strange = "header" in name and name != "header only"
    assert len(error.complaints) == 1 + strange and said in str(error)
    assert ("init NEW" in error.complaints[-1]) == strange


def test_missing_files_and_folders_are_named(tmp_path: Path) -> None:
    assert [s.rpartition("/")[2] for s in refused(tmp_path).complaints] == [
        "campaign.toml: is missing",
        "measurements.csv: is missing",
    ]
    (tmp_path / "readings.xlsx").touch()
    (said,) = [s for s in refused(tmp_path).complaints if "measurements.csv" in s]
    assert (
        "measurements.csv: is missing, readings.xlsx lies beside it: " in said
        and '[file] path = "readings.xlsx"' in said
    )
    (tmp_path / "campaign.toml").mkdir()
    assert "cannot be read: Is a directory" in str(refused(tmp_path))
    assert "does not exist, allowed is a folder with campaign.toml" in str(refused(tmp_path / "nowhere"))
    (tmp_path / "file").touch()
    assert "is a file, allowed is a folder" in str(refused(tmp_path / "file"))


def test_a_deep_toml_is_no_crash(tmp_path: Path) -> None:
    assert "is no TOML" in str(refused(laid(tmp_path, "a = " + "[" * 100_000)))


def test_all_mistakes_of_a_file_come_at_once(tmp_path: Path) -> None:
    toml = TOML
    for old, new in [
        ("length_mm = 310.0", "length_mm = 0"),
        ("x_mm = 0.001", "x_mm = 0"),
        ('"-y"', '"up"'),
        ('"fit"', '"f"'),
        ('"mid", z', '"middle", z'),
    ]:
        toml = changed(toml, old, new)
    text = str(refused(laid(tmp_path, toml)))
    for place in (
        "rig.length_mm",
        "noise.x_mm",
        "gauge 'mid', direction",
        "test 'axial_q+30', role",
        "'middle', neither",
    ):
        assert place in text
    assert len(text.splitlines()) == 5, "no mistake is told twice, in its consequences"


def test_mistakes_of_both_files_come_at_once(tmp_path: Path) -> None:
    toml = changed(TOML, "length_mm = 310.0", "length_mm = 0")
    text = str(refused(laid(tmp_path, toml, CSV.replace("430.25", "bad"))))
    assert [("rig.length_mm" in line, "column fx_N: holds 'bad'" in line) for line in text.splitlines()] == [
        (True, False),
        (False, True),
    ]


def test_lines_are_those_of_an_editor(tmp_path: Path) -> None:
    """A cell of two lines and a blank line before the mistake."""
    csv = changed(CSV, "axial_q+30,1", '"axial_q+30\n",1').replace("430.25", "bad")
    assert "line 5, column fx_N: holds 'bad'" in str(refused(laid(tmp_path, csv="\n" + csv)))


def test_no_line_is_named_where_text_may_look_like_a_key(tmp_path: Path) -> None:
    toml = TOML.replace('name = "bench-07"', 'name = """\nq_deg = 1"""').replace(
        "q_deg = 30.0", "q_deg = 99.0"
    )
    error = refused(laid(tmp_path, toml))
    assert "campaign.toml, test 'axial_q+30', q_deg: is 99.0" in str(error) and "toml line" not in str(error)


def test_what_has_no_picture_is_written_as_its_code(tmp_path: Path) -> None:
    error = refused(laid(tmp_path, csv=changed(CSV, "x_mm", "x_\x01m")))
    assert "\\x01m" in str(error) and "\x01" not in str(error)


def test_sensors_with_offsets_may_read_far(tmp_path: Path) -> None:
    """Only what moved since the first row is judged where the sensors were not zeroed at the nominal pose."""
    csv = BAR_CSV.replace(",1.5,", ",901.5,").replace("push,0,,0,", "push,0,,700.0,")
    assert "column y_mm: reads 901.5" in str(refused(laid(tmp_path / "a", BAR, csv)))
    fitted = changed(BAR, 'role = "fit"', 'role = "fit"\nzero = "fitted"')
    assert read(laid(tmp_path / "b", fitted, csv)).tests[0].data.displacement[1, 1] == 901.5


def test_a_long_list_is_capped(tmp_path: Path) -> None:
    rows = "".join(f"none{k},1,0,0,0,0,0,0,0,0\n" for k in range(57))
    error = refused(laid(tmp_path, csv=CSV + rows))
    assert len(error.complaints) == 57 and str(error).count("\n") == 20
    assert str(error).endswith("... and 37 more")


def test_a_column_of_text_is_a_few_sentences(tmp_path: Path) -> None:
    rows = "".join(f"axial_q+30,{k + 9},ab,0,0,0,0,,0,\n" for k in range(1000))
    error = refused(laid(tmp_path, csv=CSV + rows))
    assert len(error.complaints) == 7 and "995 more such cells" in str(error)
