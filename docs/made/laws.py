"""Sites and forms of laws beyond the catalogue."""

from __future__ import annotations

from collections.abc import Callable

from docs.made.lists import rows
from pipeline.discover.sites import SEEN
from pipeline.selection.criteria import CRITERIA
from vjm.forms import forms
from vjm.law_sites import SITE_KINDS


def sites() -> str:
    """Every kind of site with the units of its law."""
    lines = [
        (f"`{it.name}`", it.title, it.over, it.gives, "displacement" if it.series else "force")
        for it in SITE_KINDS.values()
    ]
    return rows(("site", "what it is", "over", "gives", "the law says"), lines)


def form_table() -> str:
    """Every form with its equation."""
    lines = [
        (
            f"`{it.name}`",
            it.title,
            it.equation.replace("|", r"\|"),
            " and ".join(sorted(it.places)),
            "yes" if it.memory else "",
        )
        for it in forms().values()
    ]
    return rows(("form", "in words", "equation", "where", "remembers"), lines)


PIECES: dict[str, Callable[[], str]] = {
    "law sites": sites,
    "law forms": form_table,
    "law site seen": lambda: f"{SEEN:g}",
    "law_alike_share in percent": lambda: f"{100.0 * CRITERIA.law_alike_share:g}",
}
