"""Laws in the studio: those of the command line, with progress and cancel, and the file that add takes."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from pipeline.add.command import add_effects
from pipeline.campaign import write
from pipeline.discover.command import Asked, discover_laws
from pipeline.inference.model_reading import read_model_file
from pipeline.studio.files import write_laws
from pipeline.studio.session import Session
from pipeline.studio.state import panel
from tests.pipeline.bench import bench
from tests.studio.test_session import idle, opened, until


@pytest.fixture
def session() -> Iterator[Session]:
    it = Session()
    yield it
    it.close()


@pytest.mark.long
def test_laws_are_those_of_the_command_line_and_enter_by_its_file(session: Session, tmp_path: Path) -> None:
    for name in ("here", "there"):
        write(tmp_path / name, bench("joint_friction.torque_Nmm", 600.0))
    here, there = tmp_path / "here", tmp_path / "there"
    it = opened(session, here)
    assert not panel(it)["laws"] and not panel(it)["laws_looked"]
    it.discover()
    until(it, lambda s: ": " in s.progress and not s.progress.endswith("reading"))
    it.cancel()
    assert it.laws is None and "looking for laws: cancelled" in it.remark
    it.discover()
    until(it, idle)
    record = discover_laws(Asked(there, write=there / "laws.py", quiet=True))
    assert it.laws is not None and it.laws.effect_file == (there / "laws.py").read_text(encoding="utf-8")
    assert it.laws.record.sentences == record.sentences and not (here / "laws.py").exists()
    seen = panel(it)
    (law,), (told,) = seen["laws"], record.laws
    assert law["title"].lower() == told.where and law["picture"].startswith("data:image/png;base64,")
    said = " ".join([*seen["laws_said"], *law["said"]])
    assert all(sentence.replace("`", "") in said for sentence in record.sentences)
    assert told.equation is not None and told.equation in said and "held out" in law["left"]
    assert seen["laws_add"] and "plain virtual springs on" in seen["laws_about"]
    it.add_laws()
    until(it, idle)
    assert it.page is not None and not it.complaint
    add_effects(there, it.laws.effects, effects_from=[there / "laws.py"], quiet=True)
    theirs = read_model_file(there / "model.toml").model
    assert it.page.effects == theirs.names == it.laws.effects
    assert not panel(it)["laws_add"] and "has changed since" in panel(it)["laws_about"]
    it.save()
    mine = read_model_file(here / "model.toml")
    assert mine.effects_from == ((here / "laws.py").resolve(),) and mine.model.names == theirs.names
    assert opened(it, here).page is not None and it.page.effects == theirs.names


def test_where_nothing_sits_it_is_said_and_nothing_is_offered(session: Session, tmp_path: Path) -> None:
    write(tmp_path / "bench", bench())
    it = opened(session, tmp_path / "bench")
    it.add_laws()
    assert it.busy is None and not panel(it)["laws_add"]
    it.discover()
    until(it, idle)
    seen = panel(it)
    assert seen["laws_said"][0].startswith("No law is found: ") and not seen["laws"] and not seen["laws_add"]
    it.add_laws()
    assert it.busy is None and not list((tmp_path / "bench").glob("*.py"))


def test_a_file_of_laws_overwrites_no_other(tmp_path: Path) -> None:
    first = write_laws(tmp_path, "one")
    assert first == tmp_path / "laws.py" and write_laws(tmp_path, "one") == first
    assert write_laws(tmp_path, "two") == tmp_path / "laws_2.py" and first.read_text() == "one"
