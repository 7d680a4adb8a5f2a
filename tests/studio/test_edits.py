"""What buttons write in campaign.toml: read again at once, and taken back."""

from __future__ import annotations

import shutil
from collections.abc import Iterator
from pathlib import Path

import pytest

from pipeline.campaign import read
from pipeline.studio.session import Session
from pipeline.studio.state import panel
from tests.cases.test_small_tables import DATA
from tests.studio.test_session import idle, opened, until


@pytest.fixture
def session() -> Iterator[Session]:
    it = Session()
    yield it
    it.close()


def diagnosed(session: Session, name: str, tmp_path: Path) -> Path:
    folder = tmp_path / "rig"
    shutil.copytree(DATA / name, folder)
    opened(session, folder).diagnose()
    until(session, idle)
    return folder


def test_a_sensor_that_was_not_zeroed_is_written_read_and_taken_back(
    session: Session, tmp_path: Path
) -> None:
    folder = diagnosed(session, "t08_offset_identified_as_dimension", tmp_path)
    file = folder / "campaign.toml"
    before = file.read_bytes()
    (it,) = panel(session)["mends"]
    assert it == {"words": "x starts at 2.95 mm", "lines": ['[[tests]] t0: zero = "fitted"']}
    session.mend(1)
    assert session.busy is None and file.read_bytes() == before
    session.mend(0)
    until(session, idle)
    assert [test.zero for test in read(folder).tests] == ["fitted"] and not panel(session)["mends"]
    assert session.page is not None and any("unknown zeros" in it for it in session.page.assumptions)
    assert panel(session)["undo"] == '[[tests]] t0: zero = "fitted"'
    # What was edited since is not written over.
    file.write_bytes(file.read_bytes() + b"# by hand\n")
    session.undo()
    assert "was edited since" in session.complaint and file.read_bytes().endswith(b"# by hand\n")
    until(session, lambda s: s.busy is None and s.remark.endswith("read again"))
    file.write_bytes(file.read_bytes().removesuffix(b"# by hand\n"))
    until(session, lambda s: s.busy is None and s.undo() is None and not s.edits)
    until(session, idle)
    assert file.read_bytes() == before and panel(session)["undo"] == ""


@pytest.mark.long
def test_a_lost_sign_is_written_as_a_line_and_the_table_is_explained(
    session: Session, tmp_path: Path
) -> None:
    folder = diagnosed(session, "n_e_flip", tmp_path)
    it, right = panel(session)["mends"]
    assert right == {"words": "the table was looked up and is right", "lines": ["table_checked = true"]}
    assert it["words"] == "all forces have the wrong sign" and it["lines"][0].startswith("[columns] fx_N = ")
    left = session.page.error[-1].fit if session.page is not None else 0.0
    session.mend(0)
    until(session, idle)
    assert session.page is not None and session.page.error[-1].fit < 0.5 * left
    assert "sign = -1" in (folder / "campaign.toml").read_text(encoding="utf-8")


def test_tolerances_that_were_saved_are_taken_back(session: Session, tmp_path: Path) -> None:
    folder = tmp_path / "rig"
    shutil.copytree(DATA / "t08_offset_identified_as_dimension", folder)
    before = (folder / "campaign.toml").read_bytes()
    it = opened(session, folder)
    it.tolerate({row["key"]: row["value"] for row in panel(it)["tolerances"]} | {"EA": "0.013"})
    it.save_tolerances()
    until(it, idle)
    assert read(folder).tolerance["EA"] == 0.013 and it.tolerance is None
    assert next(row["value"] for row in panel(it)["tolerances"] if row["key"] == "EA") == "0.013"
    it.undo()
    until(it, idle)
    assert (folder / "campaign.toml").read_bytes() == before and read(folder).tolerance["EA"] != 0.013


def test_a_reading_is_set_aside_and_comes_back(session: Session, tmp_path: Path) -> None:
    folder = tmp_path / "rig"
    shutil.copytree(DATA / "n_i_outlier_f", folder)
    before = (folder / "campaign.toml").read_bytes()
    it = opened(session, folder)
    assert not panel(it)["set_aside"]
    it.count("axial", 5, "mz_Nmm", "set_aside")
    assert "set_aside: mz_Nmm was not read in step 5" in it.complaint and it.busy is None
    assert (folder / "campaign.toml").read_bytes() == before and not it.edits
    it.count("axial", 5, "x_mm", "set_aside")
    until(it, idle)
    (row,) = panel(it)["set_aside"]
    assert (row["test"], row["step"], row["column"], row["said"]) == ("axial", 5, "x_mm", "set aside by hand")
    assert read(folder).tests[0].set_aside == ((5, "x_mm"),) and it.page is not None
    axial = it.page.tests[0]
    assert axial.curves[0].measured[axial.steps.index(5)] is None
    assert any("by hand set aside: x_mm of axial step 5" in said for said in it.page.remarks)
    it.count(row["test"], row["step"], row["column"], row["counts"])
    until(it, idle)
    assert (folder / "campaign.toml").read_bytes() == before and not panel(it)["set_aside"]


@pytest.mark.long
def test_what_a_diagnosis_sets_aside_is_kept_once_it_is_put_back(session: Session, tmp_path: Path) -> None:
    """That nothing of the step is set aside then: tests/pipeline/selection/adequacy/test_bad_readings.py."""
    folder = diagnosed(session, "n_i_outlier_f", tmp_path)
    (row,) = panel(session)["set_aside"]
    assert row["said"] == "−14.8 sigma off, by the diagnosis" and row["button"] == "Put back"
    session.count(row["test"], row["step"], row["column"], row["counts"])
    until(session, idle)
    assert read(folder).tests[0].keep == ((5, "x_mm"),)
    (row,) = panel(session)["set_aside"]
    assert row["said"] == "kept by hand, however far off it is"
