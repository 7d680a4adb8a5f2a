"""campaign.toml with kind = "manipulator": what it makes, the way there and back, and its complaints."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

from pipeline.campaign import BadCampaign, BarRig, ManipulatorRig, read, write
from pipeline.campaign.reading import DESCRIPTION, MEASUREMENTS
from pipeline.cli import app
from pipeline.compare.models import compare_models
from pipeline.errors import InputError
from pipeline.inference.model import Model
from pipeline.inference.model_file import ModelFile, write_model
from pipeline.inference.model_reading import read_model_file
from pipeline.manipulator.description import SHIPPED
from tests.pipeline.campaign.example import CSV, TOML
from tests.pipeline.inference import manipulators
from tests.pipeline.manipulator.machines import TRIPTERON
from vjm.effects import catalogue

Change = Callable[[str], str]
LINKS = """
schema = 1
name = "links"
[rig]
kind = "manipulator"
file = "tripteron.toml"
[noise]
x_mm = 0.005
fx_N = 1.0
[[tests]]
id = "home"
at_mm = [0.0, 0.0, 0.0]
role = "fit"
control = { x = "force", y = "force", z = "force", rx = "force", ry = "force", rz = "force" }
"""


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    write(tmp_path / "c", manipulators.campaign(weight=40.0))
    return tmp_path / "c"


def test_there_and_back(folder: Path) -> None:
    before, after = manipulators.campaign(weight=40.0), read(folder)
    assert after.rig.kind == "manipulator" and after.rig.file == "orthoglide"
    assert after.rig.manipulator is not None and after.rig.length == 310.0
    assert after.rig.platform_weight == 40.0
    for one, other in zip(before.tests, after.tests, strict=True):
        assert (one.id, one.control, one.rig.point) == (other.id, other.control, other.rig.point)
        np.testing.assert_array_equal(one.data.displacement, other.data.displacement)
    # Tests at one point share their rig, so that they are solved together.
    assert after.tests[0].rig is after.tests[1].rig is not after.tests[2].rig


def test_a_file_beside_the_campaign_goes_first(folder: Path) -> None:
    text = (SHIPPED / "orthoglide.toml").read_text(encoding="utf-8")
    (folder / "mine.toml").write_text(text.replace('name = "Orthoglide"', 'name = "mine"'), encoding="utf-8")
    described = folder / DESCRIPTION
    described.write_text(described.read_text().replace('"orthoglide"', '"mine.toml"'))
    found = read(folder).rig.manipulator
    assert found is not None and found.name == "mine"


def swapped(old: str, new: str) -> Change:
    def change(text: str) -> str:
        assert old in text
        return text.replace(old, new, 1)

    return change


BAD: dict[str, tuple[Change, str]] = {
    "file": (swapped('"orthoglide"', '"orthoglid"'), "rig.file: orthoglid: No such file or directory"),
    "no file": (swapped('file = "orthoglide"\n', ""), "rig, file: is missing"),
    "key": (swapped("file =", "length_mm = 3.0\nfile ="), "length_mm is given, allowed only with kind"),
    "weight": (swapped("gravity = [0.0, 0.0, -2.0]\n", ""), "a weight is given without its direction"),
    "no place": (swapped("at_mm = [0.0, 0.0, 0.0]\n", ""), "test 'free_0': at_mm is missing"),
    "out of reach": (swapped("[50.0, -40.0, 60.0]", "[50.0, -40.0, 360.0]"), "does not reach this pose"),
    "angle": (swapped('role = "fit"', 'role = "fit"\nq_deg = 3.0'), "a manipulator has at_mm instead"),
    "own rig": (swapped('role = "fit"', 'role = "fit"\nrig = { file = "x" }'), "differ in at_mm only"),
    "gauge": (
        swapped("[[tests]]", '[[gauges]]\nname = "g"\nstation = 0.5\ndirection = "y"\n\n[[tests]]'),
        "campaigns have no gauges yet",
    ),
}


@pytest.mark.parametrize("name", BAD)
def test_complaints_name_the_place(name: str, folder: Path) -> None:
    change, said = BAD[name]
    path = folder / DESCRIPTION
    path.write_text(change(path.read_text(encoding="utf-8")), encoding="utf-8")
    with pytest.raises(BadCampaign) as caught:
        read(folder)
    assert said.split(": ")[-1] in str(caught.value), str(caught.value)
    assert DESCRIPTION in str(caught.value)


def test_a_parallelogram_has_no_point(tmp_path: Path) -> None:
    (tmp_path / DESCRIPTION).write_text(TOML.replace("q_deg = 30.0", "q_deg = 30.0\nat_mm = [0.0, 0.0, 0.0]"))
    (tmp_path / MEASUREMENTS).write_text(CSV)
    with pytest.raises(BadCampaign, match="at_mm is given, allowed only with kind"):
        read(tmp_path)


def test_a_saved_model_of_a_manipulator_is_that_of_its_parallelograms(tmp_path: Path) -> None:
    model = Model().with_effects([catalogue()["axis_flexibility"]])
    write_model(tmp_path / "model.toml", ModelFile(model))
    assert read_model_file(tmp_path / "model.toml", rig=ManipulatorRig).model.names == ("axis_flexibility",)
    with pytest.raises(InputError, match="needs a rig of kind parallelogram, not bar"):
        read_model_file(tmp_path / "model.toml", rig=BarRig)


def test_a_campaign_on_a_machine_without_a_parallelogram(tmp_path: Path) -> None:
    """Drives a fifth softer than drawn: all three models miss the slope alike, and the sentence says so."""
    (tmp_path / "tripteron.toml").write_text(TRIPTERON, encoding="utf-8")
    (tmp_path / DESCRIPTION).write_text(LINKS, encoding="utf-8")
    loads = [0.0, 50.0, 100.0, 150.0, 200.0, 150.0, 100.0, 50.0, 0.0]
    rows = [f"home,{k},{load / 485.29},{load}" for k, load in enumerate(loads)]
    (tmp_path / MEASUREMENTS).write_text("\n".join(["test,step,x_mm,fx_N", *rows, ""]), encoding="utf-8")
    found = compare_models(read(tmp_path))
    assert [model.failed for model in found.models] == [None] * 3
    assert {round(model.fit or 0.0, 2) for model in found.models} == {7.18}
    said = CliRunner().invoke(app, ["add", str(tmp_path), "modulus_error"])
    assert said.exit_code == 2 and "need a parallelogram, Tripteron has none" in said.output


def as_columns(folder: Path) -> tuple[str, str]:
    """The campaign with one test, whose postures are columns of its table, in the units of the contract."""
    campaign = read(folder)
    (folder / "model.toml").unlink(missing_ok=True)
    text = (folder / DESCRIPTION).read_text(encoding="utf-8")
    head, first, _ = text.split("[[tests]]", 2)
    first = first.replace("at_mm = [0.0, 0.0, 0.0]\n", "").replace(campaign.tests[0].id, "all")
    header, *rows = (folder / MEASUREMENTS).read_text(encoding="utf-8").splitlines()
    places = {test.id: ",".join(map(str, test.rig.point or ())) for test in campaign.tests}
    lines = [f"all,{k},{row.split(',', 2)[2]},{places[row.split(',')[0]]}" for k, row in enumerate(rows)]
    table = "\n".join([f"{header},at_x_mm,at_y_mm,at_z_mm", *lines, ""])
    (folder / DESCRIPTION).write_text(f"{head}[[tests]]{first}", encoding="utf-8")
    (folder / MEASUREMENTS).write_text(table, encoding="utf-8")
    return f"{head}[[tests]]{first}", table


def test_postures_may_be_columns_of_the_table(folder: Path) -> None:
    before = read(folder)
    as_columns(folder)
    after = read(folder)
    points: list[object] = []
    for test in before.tests:
        if not points or points[-1] != test.rig.point:
            points.append(test.rig.point)
    assert [test.rig.point for test in after.tests] == points and len(points) > 1
    assert [test.id for test in after.tests] == [f"all {k + 1}" for k in range(len(points))]
    for name in ("displacement", "wrench"):
        whole = [np.vstack([getattr(test.data, name) for test in it.tests]) for it in (before, after)]
        np.testing.assert_array_equal(*whole)


@pytest.mark.parametrize(
    ("part", "old", "new", "said"),
    [
        ("table", ",at_z_mm", "", "cells, the header has"),
        ("table", ",0.0\n", ",\n", "has rows without at_x_mm, at_y_mm, at_z_mm"),
        ("table", ",0.0\n", ",900.0\n", "the platform is to stand at [0.0, 0.0, 900.0] mm: "),
        ("description", 'id = "all"', 'id = "all"\nat_mm = [0, 0, 0]', "has at_mm and columns"),
        ("description", "x_mm =", "at_x_mm = 1.0\nx_mm =", "noise.at_x_mm: is unknown"),
    ],
)
def test_what_a_posture_cannot_be_is_said(folder: Path, part: str, old: str, new: str, said: str) -> None:
    description, table = as_columns(folder)
    text, name = (table, MEASUREMENTS) if part == "table" else (description, DESCRIPTION)
    assert old in text
    (folder / name).write_text(text.replace(old, new, 1), encoding="utf-8")
    with pytest.raises(BadCampaign) as caught:
        read(folder)
    assert said in str(caught.value), caught.value


def test_postures_of_a_logger_are_read_in_its_units_and_are_of_machines_alone(
    folder: Path, tmp_path: Path
) -> None:
    description, table = as_columns(folder)
    columns = "".join(
        f'"P{a.upper()} (cm)" = {{ is = "at_{a}" }}\n"{n}" = {{ is = "{n[:-3]}", unit = "mm" }}\n'
        for a, n in (("x", "x_mm"), ("y", "y_mm"), ("z", "z_mm"))
    )
    head, mark, tests = description.partition("[[tests]]")
    (folder / DESCRIPTION).write_text(f"{head}[columns]\n{columns}{mark}{tests}", encoding="utf-8")
    header, *rows = table.splitlines()
    for a in "xyz":
        header = header.replace(f"at_{a}_mm", f"P{a.upper()} (cm)")
    (folder / MEASUREMENTS).write_text("\n".join([header, *rows]), encoding="utf-8")
    with pytest.raises(BadCampaign, match="the platform is to stand at"):
        read(folder)
    (tmp_path / DESCRIPTION).write_text(TOML)
    (tmp_path / MEASUREMENTS).write_text(
        "\n".join(f"{line},{'at_x_mm' if k == 0 else 3}" for k, line in enumerate(CSV.splitlines()))
    )
    with pytest.raises(BadCampaign, match="column at_x_mm: is of a manipulator"):
        read(tmp_path)
