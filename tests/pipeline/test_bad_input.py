"""Bad input: one sentence that names place, found and allowed; exit 2; never a traceback."""

import re
from collections.abc import Callable
from pathlib import Path

import pytest

from pipeline.command import redraw
from pipeline.errors import InputError
from pipeline.validation.case import SHIPPED, load_case, shipped_cases
from tests.conftest import Done

PLAIN = (SHIPPED / "plain_i_bar.toml").read_text()
TUBE_WITH_A_LOOSE_LUG = """section = { kind = "tube", outer_diameter_mm = 20.0, wall_mm = 1.0 }
lug = { length_mm = 6.0, width_mm = 8.0, height_mm = 8.0 }

"""
EXACT = (SHIPPED / "orthoglide.toml").read_text()

BAD = {
    "negative length": (PLAIN, "length_mm = 310.0", "length_mm = -310.0", "linkage.length_mm is -310.0"),
    "no number": (PLAIN, "width_mm = 80.0", 'width_mm = "wide"', "linkage.width_mm is 'wide'"),
    "infinite": (PLAIN, "length_mm = 310.0", "length_mm = inf", "linkage.length_mm is inf"),
    "angle": (PLAIN, "[0.0, 30.0]", "[0.0, 75.0]", "angles_deg.1 is 75.0"),
    "no angle": (PLAIN, "[0.0, 30.0]", "[]", "angles_deg"),
    "poisson": (PLAIN, "nu = 0.33", "nu = 0.5", "material.nu is 0.5"),
    "unknown key": (PLAIN, "[mesh]", "colour = 1\n[mesh]", "bar.colour is not a key"),
    "missing table": (PLAIN, "[mesh]", "[mash]", "mash is not a key"),
    "missing key": (PLAIN, "E_MPa = 70000.0", "", "material.E_MPa is missing"),
    "unknown section": (PLAIN, '"i_section"', '"z_section"', "bar.section"),
    "not toml": (PLAIN, "[linkage]", "[linkage", "not a readable TOML file"),
    "two ways": (PLAIN, "[bar]", '[bar]\nfamily = "i_section"\nmeets = "paper"', "allowed is one of the two"),
    "unsymmetric": (EXACT, "[0.0, 1.81e1, 0.0, 0.0", "[0.0, 1.81e1, 9.0, 0.0", "symmetric"),
    "not six": (
        EXACT,
        "    [2.20e4, 0.0, 0.0, 0.0, 0.0, 0.0],\n    [0.0, 1.81e1",
        "    [0.0, 1.81e1",
        "6 rows",
    ),
    "no paper": (
        PLAIN,
        "section = {",
        'family = "i_section"\nmeets = "paper"\nlug_length_mm = 6.0 #',
        "[paper]",
    ),
}


@pytest.mark.parametrize("name", BAD)
def test_case_file_is_refused_with_a_sentence(name: str, tmp_path: Path) -> None:
    text, old, new, expected = BAD[name]
    assert old in text
    path = tmp_path / "case.toml"
    path.write_text(text.replace(old, new, 1))
    with pytest.raises(InputError) as caught:
        load_case(str(path))
    sentence = str(caught.value)
    assert str(path) in sentence and expected in sentence and "\n" not in sentence.split("TOML file")[0]


COMMANDS = {
    "unknown case": (None, ["no_such_case"], "case 'no_such_case' is unknown, allowed are"),
    "web wider than flange": (("web_mm = 4.0", "web_mm = 14.0"), [], "web is 14 mm, allowed is less than"),
    "flange too thick": (
        ("thickness_mm = 2.2", "thickness_mm = 9.0"),
        [],
        "flange_thickness is 9 mm, allowed",
    ),
    "mesh too coarse": (("size_mm = 6.0", "size_mm = 100.0"), [], "mesh size is 100 mm, allowed is at most"),
    "mesh too fine": (("size_mm = 6.0", "size_mm = 0.001"), [], "cells; allowed are"),
    "both levels": (None, ["orthoglide", "--coarse", "--fine"], "allowed is one of the two"),
}


@pytest.mark.parametrize("name", COMMANDS)
def test_command_ends_with_one_sentence_and_two(
    name: str, tmp_path: Path, command_here: Callable[..., Done]
) -> None:
    change, arguments, expected = COMMANDS[name]
    if change is not None:
        path = tmp_path / "case.toml"
        path.write_text(PLAIN.replace(*change))
        arguments = [str(path)]
    done = command_here("run", *arguments, "--out", str(tmp_path / "out"), cwd=tmp_path)
    assert done.code == 2
    assert expected in done.err and done.err.count("\n") == 1 and "Traceback" not in done.err
    assert not (tmp_path / "out" / "result.json").exists()


def test_report_of_nothing_is_refused(tmp_path: Path, command_here: Callable[..., Done]) -> None:
    done = command_here("report", str(tmp_path), cwd=tmp_path)
    assert done.code == 2 and "result.json" in done.err and "Traceback" not in done.err


def test_unknown_command_is_refused(tmp_path: Path, pipeline_command: Callable[..., Done]) -> None:
    done = pipeline_command("solve", cwd=tmp_path)
    assert done.code == 2 and "Traceback" not in done.err


def test_shipped_cases_load() -> None:
    assert shipped_cases() == ["orthoglide", "plain_i_bar"]
    assert [load_case(name).name for name in shipped_cases()] == shipped_cases()


MORE = {
    "true is no number": ("E_MPa = 70000.0", "E_MPa = true", "material.E_MPa is True"),
    "text is no number": ("length_mm = 310.0", 'length_mm = "310"', "linkage.length_mm is '310'"),
    "angle twice": ("[0.0, 30.0]", "[30.0, 30.0]", "each once"),
    "name leads elsewhere": ('name = "plain_i_bar"', 'name = ".."', "name is '..'"),
    "other schema": ("schema = 1", "schema = 2", "schema is 2"),
}


@pytest.mark.parametrize("name", MORE)
def test_case_file_is_taken_at_its_word(name: str, tmp_path: Path) -> None:
    old, new, expected = MORE[name]
    path = tmp_path / "case.toml"
    path.write_text(PLAIN.replace(old, new, 1))
    with pytest.raises(InputError, match=re.escape(expected)):
        load_case(str(path))


@pytest.mark.parametrize(
    ("change", "expected"),
    [
        (("width_mm = 80.0", "width_mm = 15.0"), "linkage.width_mm is 15, allowed is above the bars' height"),
        (
            (PLAIN[PLAIN.index("section = ") : PLAIN.index("[mesh]")], TUBE_WITH_A_LOOSE_LUG),
            "lug of 8 by 8 mm fits into the bore",
        ),
    ],
)
def test_geometry_that_cannot_be_leaves_nothing_behind(
    change: tuple[str, str], expected: str, tmp_path: Path, command_here: Callable[..., Done]
) -> None:
    path = tmp_path / "case.toml"
    path.write_text(PLAIN.replace(*change, 1))
    done = command_here("run", str(path), "--out", "out", cwd=tmp_path)
    assert done.code == 2 and expected in done.err and "Traceback" not in done.err
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize("text", ["", "[1, 2]", '{"bar": 1}', "\x00\x01"])
def test_damaged_result_is_refused(text: str, tmp_path: Path) -> None:
    (tmp_path / "result.json").write_text(text)
    with pytest.raises(InputError, match="is not a saved result") as said:
        redraw(tmp_path, quiet=True)
    assert "\n" not in str(said.value)


def test_damaged_result_ends_the_command(tmp_path: Path, pipeline_command: Callable[..., Done]) -> None:
    (tmp_path / "result.json").write_text("{}")
    done = pipeline_command("report", str(tmp_path), cwd=tmp_path)
    assert done.code == 2 and "is not a saved result" in done.err and done.err.count("\n") == 1
