"""What the widgets of the studio show, as plain values; no number here that is not in a page or an answer."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from pipeline.answer import Answer
from pipeline.campaign.reading import DESCRIPTION
from pipeline.page.record import Page, TestPage
from pipeline.page.words import why
from pipeline.parameter_names import parted
from pipeline.studio.planning import planning
from pipeline.studio.session import Session
from pipeline.value import Value
from reports.campaign.names import channel_label, measured, test_label
from reports.formats import number
from reports.quantities import estimate, phrase, sigma

DEEP = 3
"""Folders below the present one in which campaigns are looked for."""


def panel(session: Session) -> dict[str, Any]:
    """Everything but the plots."""
    page, answer = session.page, session.answer
    named = (
        ()
        if answer is None
        else tuple(n for n in answer.effects if page is not None and n not in page.effects)
    )
    return {
        "complaint": session.complaint,
        "remark": session.remark,
        "progress": session.progress,
        "busy": session.busy or "",
        "dirty": session.dirty,
        "ready": page is not None,
        "campaign": "" if page is None else page.campaign,
        "headline": session.headline,
        "effects": [] if page is None else [_effect(page, name) for name in page.effects],
        "addable": [] if page is None else _addable(session, page),
        "candidates": [] if answer is None else _candidates(session, answer),
        "sentences": [] if answer is None else list(answer.sentences[1:]),
        "named": list(named),
        "errors": "" if page is None else _errors(page),
        "measured": page is not None and measured(page.model_dump()),
        **planning(session),
    }


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


def _errors(page: Page) -> str:
    first, last = page.error[0], page.error[-1]
    held = "" if last.holdout is None else f", held out {sigma(last.holdout)}"
    return f"{sigma(first.fit)} → {sigma(last.fit)} sigma{held}"


def _effect(page: Page, name: str) -> dict[str, Any]:
    mine = {parted(key)[1]: it for key, it in page.parameters.items() if parted(key)[0] == name}
    return {"name": name, "values": [_value(key, it) for key, it in mine.items()]}


def _value(name: str, it: Value) -> str:
    return phrase(name, estimate(it.model_dump()), it.unit, number)


def _addable(session: Session, page: Page) -> list[dict[str, str]]:
    return [
        {"value": name, "title": f"{name}: {title}"}
        for name, title in session.names
        if name not in page.effects
    ]


def _candidates(session: Session, answer: Answer) -> list[dict[str, Any]]:
    there = () if session.page is None else session.page.effects
    return [
        {
            "name": it.effect,
            "left": sigma(it.screen if it.fit is None else it.fit),
            "behind": number(it.evidence, 3),
            "why": why(it, answer),
            "chosen": it.effect in answer.effects,
            "there": it.effect in there,
        }
        for it in answer.candidates
    ]
