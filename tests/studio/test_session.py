"""The studio without a browser: the same models and sentences as on the command line, and nothing is lost."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from pathlib import Path
from time import monotonic, sleep

import pytest

from pipeline.add.command import add_effects
from pipeline.campaign import write
from pipeline.errors import InputError
from pipeline.inference.model_reading import read_model_file
from pipeline.page.command import report_campaign
from pipeline.plan.command import plan_campaign
from pipeline.studio.command import studio
from pipeline.studio.session import Session
from pipeline.studio.state import panel
from tests.conftest import Done
from tests.pipeline.bench import bench
from tests.studio.ahead import unmeasured

PATIENCE = 120.0
"""Seconds; two cores are shared."""


@pytest.fixture(scope="module")
def session() -> Iterator[Session]:
    it = Session()
    yield it
    it.close()


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    write(tmp_path / "bench", bench("modulus_error.scale", 0.95))
    return tmp_path / "bench"


def until(session: Session, done: Callable[[Session], bool]) -> None:
    end = monotonic() + PATIENCE
    while not done(session):
        assert monotonic() < end, (session.busy, session.complaint, session.remark)
        sleep(0.02)
        session.poll()


def idle(session: Session) -> bool:
    return session.busy is None


def opened(session: Session, folder: Path) -> Session:
    session.open(folder)
    until(session, idle)
    return session


@pytest.mark.long
def test_add_remove_and_save_are_those_of_the_command_line(
    session: Session, folder: Path, tmp_path: Path
) -> None:
    it = opened(session, folder)
    assert it.page is not None and it.page.effects == () and not it.dirty and not it.complaint
    plain = it.page.error[0].fit
    it.add(["bar_geometric_nonlinearity", "load_offset"])
    until(it, idle)
    it.remove("load_offset")
    until(it, idle)
    it.add(["modulus_error"])
    until(it, idle)
    assert it.page.effects == ("bar_geometric_nonlinearity", "modulus_error") and it.dirty
    assert it.page.error[-1].fit < 1.2 < plain and it.page.verdict == "within_noise"
    assert sorted(p.name for p in folder.iterdir()) == ["campaign.toml", "measurements.csv"]
    it.save()
    assert not it.dirty and it.remark == f"saved: {folder / 'model.toml'}"
    saved = read_model_file(folder / "model.toml")
    write(tmp_path / "other", bench("modulus_error.scale", 0.95))
    add_effects(tmp_path / "other", saved.model.names, quiet=True)
    other = read_model_file(tmp_path / "other" / "model.toml")
    # Both end where no step promises a thousandth of chi-square, from different sides.
    std = other.uncertainty["modulus_error.scale"].std
    assert std is not None and abs(saved.model.values[0] - other.model.values[0]) < 0.1 * std
    it.export(tmp_path / "out")
    until(it, idle)
    assert it.remark == f"report: {tmp_path / 'out' / 'index.html'}"
    assert json.loads((tmp_path / "out" / "page.json").read_text())["effects"] == list(saved.model.names)


def test_a_complaint_is_the_sentence_of_the_command_line(
    session: Session, folder: Path, tmp_path: Path
) -> None:
    text = (folder / "campaign.toml").read_text()
    (folder / "campaign.toml").write_text(text.replace("length_mm", "lenght_mm", 1))
    with pytest.raises(InputError) as caught:
        report_campaign(folder, tmp_path / "out")
    it = opened(session, folder)
    assert it.complaint == str(caught.value) and "lenght_mm" in it.complaint
    assert opened(session, tmp_path / "nowhere").complaint.startswith(
        f"{tmp_path / 'nowhere'}: does not exist"
    )


def test_a_campaign_that_is_edited_is_read_again_and_the_work_is_kept(session: Session, folder: Path) -> None:
    it = opened(session, folder)
    it.add(["bar_geometric_nonlinearity"])
    until(it, idle)
    whole = (folder / "measurements.csv").read_text()
    (folder / "measurements.csv").write_text(whole + "nonsense\n")
    until(it, lambda s: bool(s.complaint))
    assert "measurements.csv" in it.complaint and it.page is not None
    assert it.page.effects == ("bar_geometric_nonlinearity",)
    text = (folder / "campaign.toml").read_text()
    (folder / "measurements.csv").write_text(whole)
    (folder / "campaign.toml").write_text(text.replace('name = "small"', 'name = "renamed"'))
    until(it, lambda s: s.busy is None and s.page is not None and s.page.campaign == "renamed")
    assert it.page.effects == ("bar_geometric_nonlinearity",) and it.dirty and not it.complaint


@pytest.mark.long
def test_two_studios_do_not_overwrite_each_other_unsaid(session: Session, folder: Path) -> None:
    other = Session()
    try:
        for it, name in ((session, "bar_geometric_nonlinearity"), (other, "load_offset")):
            opened(it, folder).add([name])
            until(it, idle)
        other.save()
        kept = (folder / "model.toml").read_bytes()
        session.save()
        assert "was changed since it was read" in session.complaint
        assert (folder / "model.toml").read_bytes() == kept and session.dirty
        session.save()
        assert read_model_file(folder / "model.toml").model.names == ("bar_geometric_nonlinearity",)
    finally:
        other.close()


@pytest.mark.long
def test_a_cancelled_diagnosis_changes_nothing_and_the_next_task_works(
    session: Session, folder: Path
) -> None:
    it = opened(session, folder)
    before = it.page
    it.diagnose()
    until(it, lambda s: ":" in s.progress)
    it.add(["load_offset"])
    assert "is not finished, allowed is to cancel it" in it.complaint
    it.cancel()
    assert it.busy is None and it.page is before and "cancelled" in it.remark
    it.add(["load_offset"])
    until(it, idle)
    assert it.page is not None and it.page.effects == ("load_offset",)


def test_a_plan_before_measuring_is_that_of_the_command_line(
    session: Session, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    write(tmp_path / "ahead", unmeasured())
    it = opened(session, tmp_path / "ahead")
    assert panel(it)["headline"].startswith("Not measured yet") and it.plan is None
    assert not panel(it)["measured"] and not panel(it)["planned"]
    it.look_ahead()
    until(it, lambda s: ":" in s.progress)
    it.cancel()
    assert it.plan is None and it.busy is None and "looking at what these tests show: cancelled" in it.remark
    it.look_ahead()
    until(it, idle)
    assert it.plan == plan_campaign(tmp_path / "ahead", quiet=True) and it.planned is it.page
    shown, said = panel(it), capsys.readouterr().out
    assert "Not measured yet, sensors as in [noise]: axial, lateral." in said
    assert shown["following"][0] in " ".join(said.split()) and "Not measured yet" in shown["about"]
    assert len(shown["sizes"]) == len(it.plan.sizes) and any(row["alike"] for row in shown["sizes"])
    it.add(["modulus_error"])
    until(it, idle)
    assert "has changed since: Plan looks again" in panel(it)["about"]


def test_a_process_that_dies_is_said_and_replaced(session: Session, folder: Path) -> None:
    it = opened(session, folder)
    it.diagnose()
    until(it, lambda s: ":" in s.progress)
    it._worker._process.kill()
    until(it, idle)
    assert "has ended" in it.complaint
    assert opened(it, folder).page is not None and not it.complaint


def test_the_command_line_refuses_what_the_page_would(
    pipeline_command: Callable[..., Done], tmp_path: Path
) -> None:
    done = pipeline_command("studio", "nowhere", "--no-browser", cwd=tmp_path)
    assert done.code == 2 and done.err.startswith("error: nowhere: does not exist, allowed is a folder with")


def test_without_libegl_the_package_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    def missing(name: str) -> None:
        raise OSError(name)

    # The studio clears the command line for the server.
    monkeypatch.setattr("sys.argv", ["pytest"])
    monkeypatch.setattr("reports.shapes.ctypes.CDLL", missing)
    monkeypatch.setattr("reports.shapes.sys.platform", "linux")
    with pytest.raises(InputError, match="libegl1"):
        studio(None, 0, browser=False)
