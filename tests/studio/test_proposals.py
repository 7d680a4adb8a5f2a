"""What a diagnosis proposes: shown whole, taken or not; headline, bars and curves are always of one model."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache
from pathlib import Path

import pytest

from pipeline.add.fitting import add
from pipeline.answer.record import Answer
from pipeline.campaign import read, write
from pipeline.errors import InputError
from pipeline.inference.model import Model
from pipeline.inference.suitable import known_effects
from pipeline.page.collect import Subject, collect
from pipeline.page.record import RivalPage
from pipeline.studio import tolerances
from pipeline.studio.files import edited
from pipeline.studio.session import Session
from pipeline.studio.state import panel
from pipeline.studio.work import Done, Proposal, Task
from tests.pipeline.bench import bench

SETS = (("bar_geometric_nonlinearity", "modulus_error"), ("bar_geometric_nonlinearity", "load_offset"))


@pytest.fixture
def session(tmp_path: Path) -> Iterator[Session]:
    it = Session()
    write(tmp_path / "bench", bench("modulus_error.scale", 0.95))
    task = Task("open", tmp_path / "bench", tmp_path)
    plain = collect(Subject(read(tmp_path / "bench"), Model(), known_effects(), {}))
    it._finish(task, Done("open", "plain", "plain", plain, names=(("modulus_error", "stiffness scaled"),)))
    yield it
    it.close()


@cache
def found(names: tuple[str, ...]) -> Answer:
    known = known_effects().effects
    return add(bench("modulus_error.scale", 0.95), Model(), [known[name] for name in names]).answer


def proposal(names: tuple[str, ...], verdict: str, rivals: tuple[RivalPage, ...] = ()) -> Proposal:
    """As a diagnosis makes one, of a set that was fitted."""
    answer = found(names)
    said = f"{verdict}: {' + '.join(names)}; the error falls."
    answer = answer.model_copy(update={"verdict": verdict, "sentences": (said,)})
    campaign = bench("modulus_error.scale", 0.95)
    subject = Subject(campaign, Model(), known_effects(), {}, answer, rivals=rivals)
    return Proposal(collect(subject), " + ".join(names), "kept", answer)


def diagnosed(session: Session, *proposals: Proposal) -> None:
    task = Task("diagnose", session.folder or Path(), Path())
    session._finish(task, Done("diagnose", answer=proposals[0].answer, proposals=proposals))


def same(session: Session) -> None:
    """Headline, bars and effects are of the page that is shown."""
    page, seen = session.shown, panel(session)
    assert page is not None
    assert [it["name"] for it in seen["effects"]] == list(page.effects)
    assert all(f">{it.fit:.3g}<" in seen["bars"].replace("0.9990", "0.999") for it in page.error)
    for it in seen["effects"]:
        assert it["title"] in seen["headline"] or not page.diagnosed


def test_what_is_proposed_is_shown_and_back_shows_what_was(session: Session) -> None:
    before = session.page
    diagnosed(session, proposal(SETS[0], "identified"))
    assert session.shown is not before and session.page is before and not session.dirty
    assert panel(session)["proposed"] and panel(session)["headline"].startswith(
        "Identified: geometric nonlinearity"
    )
    assert "_" not in panel(session)["headline"]
    same(session)
    session.back()
    assert session.shown is before and "what was found" in panel(session)["standing"].lower()
    same(session)
    session.choose(0)
    session.accept()
    assert session.page is session.shown is not before
    assert session.page is not None and session.page.effects == SETS[0]
    assert session.dirty and session.model == " + ".join(SETS[0]) and not session.proposals
    assert panel(session)["next"] == ["Save model keeps it with the campaign."]
    same(session)


@pytest.mark.long
def test_an_ambiguous_verdict_offers_every_set_and_no_single_one(session: Session) -> None:
    rivals = tuple(
        RivalPage(effects=names, error=found(names).error[-1], parameters=found(names).parameters)
        for names in SETS
    )
    diagnosed(session, *(proposal(names, "ambiguous", rivals) for names in SETS))
    seen = panel(session)
    assert seen["ambiguous"] and [it["code"] for it in seen["rivals"]] == [" + ".join(n) for n in SETS]
    assert all(it["open"] and it["values"] for it in seen["rivals"])
    assert seen["rivals"][0]["fit"] != seen["rivals"][1]["fit"]
    session.choose(1)
    assert session.shown is not None and session.shown.effects == SETS[1]
    same(session)
    session.accept()
    assert session.page is not None and session.page.effects == SETS[1] and not panel(session)["ambiguous"]
    assert not any(it["open"] for it in panel(session)["rivals"])


def test_tolerances_are_written_by_saving_alone(session: Session) -> None:
    folder = session.folder
    assert folder is not None and session.page is not None
    file = folder / "campaign.toml"
    text = file.read_text(encoding="utf-8") + "# kept\n"
    file.write_text(text, encoding="utf-8")
    session._seen = ()
    typed = {row["key"]: row["value"] for row in panel(session)["tolerances"]}
    assert set(typed.values()) == {"exact"}
    session.tolerate({**typed, "EA": "0,01", "length_mm": "0.1"})
    shown = {row["key"]: row["value"] for row in panel(session)["tolerances"]}
    assert (shown["EA"], shown["length_mm"], shown["GJ"]) == ("0.01", "0.1", "exact")
    assert file.read_text(encoding="utf-8") == text
    # Of a campaign that was edited meanwhile nothing is written.
    session.save_tolerances()
    assert "edited meanwhile" in session.complaint and file.read_text(encoding="utf-8") == text
    assert session.tolerance is not None
    known, shown_there = session.tolerance, session.page.tolerances
    edited(folder, lambda text: tolerances.with_tolerances(text, known, shown_there), "")
    now = read(folder).tolerance
    assert {key: value for key, value in now.items() if value} == {"EA": 0.01, "length_mm": 0.1}
    assert file.read_text(encoding="utf-8").endswith("# kept\n")


@pytest.mark.parametrize(
    ("text", "said"), [("much", "allowed is a number"), ("0.9", "from 0 to 0.2"), ("-1", "from 0")]
)
def test_a_tolerance_that_cannot_be_is_refused(session: Session, text: str, said: str) -> None:
    assert session.page is not None
    with pytest.raises(InputError, match=said) as caught:
        tolerances.typed({"EA": text}, session.page.tolerances)
    assert str(caught.value).startswith("axial stiffness EA of the bars: ")
