"""What the widgets of the studio show, as plain values; no number here that is not in a page or an answer."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from pipeline.answer.record import SetAside
from pipeline.answer.value import Value
from pipeline.campaign.edited import Counts
from pipeline.campaign.reading import DESCRIPTION
from pipeline.page.record import ByHand, Page, RivalPage, TestPage
from pipeline.parameter_names import parted
from pipeline.selection.mending import Mend
from pipeline.studio import found_laws, tolerances
from pipeline.studio.planning import planning
from pipeline.studio.session import Session
from reports import bars
from reports.campaign import tables, words
from reports.campaign.doubt import mistakes
from reports.campaign.names import channel_label, measured, test_label, unit_label
from reports.formats import MINUS, number
from reports.load import Json
from reports.quantities import estimate, phrase, sigma

NEAREST = 6
"""Candidates that were not chosen and are shown beside the model."""
LINES = 3
"""Of a mend that are shown."""
DEEP = 3
"""Folders below the present one in which campaigns are looked for."""
ROW, HEAD = 15, 90
"""Pixels of a row of the map at least, and of what stands around it."""


def panel(session: Session) -> dict[str, Any]:
    """Everything but the plots."""
    page = session.shown
    return {
        "complaint": session.complaint,
        "remark": session.remark,
        "progress": session.progress,
        "busy": session.busy or "",
        "dirty": session.dirty,
        "ready": page is not None,
        "proposals": len(session.proposals),
        "choice": -1 if session.choice is None else session.choice,
        "proposed": session.proposal is not None,
        "standing": _standing(session),
        "addable": [] if page is None else _addable(session, page),
        "edited": session.tolerance is not None,
        "mends": [_mend(it) for it in session.mends],
        "undo": session.edits[-1].words if session.edits else "",
        **(EMPTY if page is None else _of_page(session, page)),
        **planning(session),
    }


EMPTY: dict[str, Any] = {
    "campaign": "",
    "headline": "",
    "measured": False,
    "ambiguous": False,
    "bars": "",
    "effects": [],
    "certain": [],
    "next": [],
    "mistakes": [],
    "sentences": [],
    "candidates": [],
    "nearest": [],
    "rivals": [],
    "tolerances": [],
    "set_aside": [],
    "sigmas": [],
    **found_laws.NOTHING,
    "look_for_laws": False,
    "map_height": "330px",
}


def _of_page(session: Session, page: Page) -> dict[str, Any]:
    """What is shown of the model that is seen."""
    record = page.model_dump()
    return {
        "campaign": page.campaign,
        "headline": words.headline(record),
        "measured": measured(record),
        "ambiguous": bool(session.proposals) and page.verdict == "ambiguous" and page.diagnosed,
        "bars": str(bars.html(tables.bars(record))),
        "effects": [_effect(page, name) for name in page.effects],
        "certain": words.sure(record),
        "next": _next(session, page),
        "mistakes": mistakes(record),
        "sentences": words.others(record) if page.diagnosed else [],
        "candidates": [_candidate(it) for it in record["candidates"]],
        "nearest": [_candidate(it) for it in record["candidates"] if not it["chosen"]][:NEAREST],
        "rivals": [_rival(session, page, it, k) for k, it in enumerate(page.rivals)],
        "tolerances": tolerances.rows(page, session.tolerance),
        "set_aside": _readings(page),
        "sigmas": [
            [
                channel_label(it.column),
                number(it.value, 3),
                unit_label(it.unit),
                "given" if it.given else "estimated",
            ]
            for it in page.sigmas
        ],
        **found_laws.found_laws(session, page),
        "look_for_laws": page.diagnosed and page.verdict == "unknown" and not page.doctor,
        "map_height": f"{max(330, HEAD + ROW * len(page.tests))}px",
    }


def _readings(page: Page) -> list[dict[str, Any]]:
    """Readings that do not count, or count by hand, and what a button makes of each."""
    out = [
        _reading(it, f"{sigma(it.sigma).replace('-', MINUS)} sigma off, by the diagnosis", "Put back", "keep")
        for it in page.set_aside
    ]
    for it in page.by_hand:
        said = "kept by hand, however far off it is" if it.kept else "set aside by hand"
        out.append(_reading(it, said, "Leave it to the diagnosis" if it.kept else "Put back", "as it is"))
    return out


def _reading(it: SetAside | ByHand, said: str, button: str, counts: Counts) -> dict[str, Any]:
    return {
        "test": it.test,
        "step": it.step,
        "column": it.column,
        "said": said,
        "button": button,
        "counts": counts,
    }


def _mend(it: Mend) -> dict[str, Any]:
    more = len(it.lines) - LINES
    return {"words": it.words, "lines": [*it.lines[:LINES], *([f"and {more} more"] if more > 0 else [])]}


def _standing(session: Session) -> str:
    """Whether what is seen is the model, or one that is not accepted yet."""
    if session.proposal is not None and len(session.proposals) > 1:
        page = session.proposal.page
        return f"Bars, map and curves show one of the sets: {words.set_of(page.effects, page.titles)}."
    if session.proposal is not None:
        return "Bars, map and curves show the proposed model. It is not accepted yet."
    if session.proposals:
        return "Bars, map and curves show the model before. What was found is kept beside it."
    return "Not saved yet." if session.dirty else ""


def _next(session: Session, page: Page) -> list[str]:
    """What to do next; of a model that was accepted no longer that."""
    if session.dirty and session.proposal is None and page.effects:
        return ["Save model keeps it with the campaign."]
    return [it.words for it in page.following]


def tests(page: Page) -> list[str]:
    """Names of the tests as the map has them."""
    return [test_label(test.model_dump()) for test in page.tests]


def test_of(page: Page, label: str) -> TestPage:
    """The test with a label, or the first."""
    return next((test for test in page.tests if test_label(test.model_dump()) == label), page.tests[0])


def channels(test: TestPage) -> list[str]:
    """Channels that a test predicts."""
    return [channel_label(curve.channel) for curve in test.curves]


def campaigns(here: Path) -> list[str]:
    """Folders with a campaign below this one."""
    found = (path.parent for depth in range(DEEP) for path in here.glob(f"{'*/' * depth}{DESCRIPTION}"))
    return sorted(str(path.relative_to(here)) for path in found)


def _effect(page: Page, name: str) -> dict[str, Any]:
    mine = {parted(key)[1]: it for key, it in page.parameters.items() if parted(key)[0] == name}
    title = page.titles.get(name, name)
    return {"name": name, "title": title, "values": [_value(it) for it in mine.values()]}


def _value(it: Value) -> str:
    return phrase(it.meaning, estimate(it.model_dump()), it.unit, number)


def _addable(session: Session, page: Page) -> list[dict[str, str]]:
    return [
        {"value": name, "title": f"{title} ({name})"}
        for name, title in session.names
        if name not in page.effects
    ]


def _candidate(it: Json) -> dict[str, Any]:
    return {
        "name": it["effect"],
        "title": it["title"],
        "left": sigma(it["screen"] if it["fit"] is None else it["fit"]),
        "behind": number(it["evidence"], 3),
        "why": it["why"],
        "chosen": it["chosen"],
    }


def _rival(session: Session, page: Page, it: RivalPage, at: int) -> dict[str, Any]:
    """One of the sets; open: whether it may still be taken."""
    return {
        "title": words.capital(words.set_of(it.effects, page.titles)),
        "code": " + ".join(it.effects),
        "fit": f"fitted {sigma(it.error.fit)} sigma{_held(it)}",
        "values": [_value(value) for value in it.parameters.values()],
        "open": at < len(session.proposals),
    }


def _held(it: RivalPage) -> str:
    return "" if it.error.holdout is None else f", held out {sigma(it.error.holdout)}"
