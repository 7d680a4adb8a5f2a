"""What the widgets of the studio show of laws, as plain values: of a diagnosis, or of a look for them alone."""

from __future__ import annotations

from base64 import b64encode
from functools import lru_cache
from typing import Any

from pipeline.answer.law import LawFound
from pipeline.discover.words import law_sentences, said_of
from pipeline.page.record import Page
from pipeline.studio.session import Session
from reports.campaign import words
from reports.campaign.names import BEFORE
from reports.laws import law_picture
from reports.quantities import sigma

NOTHING: dict[str, Any] = {
    "laws": [],
    "laws_looked": False,
    "laws_said": [],
    "laws_about": "",
    "laws_add": False,
    "laws_names": "",
}


def found_laws(session: Session, page: Page) -> dict[str, Any]:
    """Of the last look for laws; before there is one, of the diagnosis that is shown."""
    found = session.laws
    if found is None:
        return {**NOTHING, "laws": [_law(page.campaign, it) for it in page.laws]}
    record = found.record
    each = set(law_sentences(record))
    return {
        "laws": [_law(record.campaign, it) for it in record.laws],
        "laws_looked": True,
        "laws_said": [it.replace("`", "") for it in record.sentences if it not in each],
        "laws_about": _about(session),
        "laws_add": session.may_add_laws,
        "laws_names": " + ".join(found.effects),
    }


def _about(session: Session) -> str:
    """From which model on they were looked for."""
    assert session.laws is not None
    said = f"Looked for from {' + '.join(session.laws.record.error[0].effects) or BEFORE} on."
    return said if session.laws_fresh else f"{said} The model has changed since: Look for laws looks again."


def _law(campaign: str, it: LawFound) -> dict[str, Any]:
    """Where it sits, what is said of it, what it leaves, and its picture."""
    held = "" if it.holdout is None else f", {sigma(it.holdout)} in those held out"
    return {
        "title": words.capital(it.where),
        "said": list(said_of(it)),
        "left": ""
        if it.fit is None
        else f"With it {sigma(it.fit)} sigma are left in the fitted tests{held}.",
        "picture": "" if it.curve is None else _picture(campaign, it.model_dump_json()),
    }


@lru_cache(maxsize=32)
def _picture(campaign: str, law: str) -> str:
    """As an address that holds it; drawn once, however often the page is shown."""
    png = law_picture(campaign, LawFound.model_validate_json(law).model_dump())
    return f"data:image/png;base64,{b64encode(png).decode('ascii')}"
