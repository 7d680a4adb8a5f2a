"""Sites, forms and thresholds of laws beyond the catalogue."""

from __future__ import annotations

from collections.abc import Callable

from docs.made.lists import rows
from pipeline.discover import criteria
from pipeline.discover.sites import SEEN
from vjm.forms import forms
from vjm.law_sites import SITE_KINDS

_THRESHOLDS = {
    "proposed": criteria.PROPOSED,
    "left out": criteria.LEFT_OUT,
    "alike": criteria.ALIKE,
    "alike share in percent": 100.0 * criteria.ALIKE_SHARE,
    "seen": SEEN,
    "few tests": criteria.FEW_TESTS,
    "laws": criteria.LAWS,
    "beyond": criteria.BEYOND,
    "unknown beyond": criteria.UNKNOWN_BEYOND,
    "preferred": criteria.PREFERRED,
    "several": criteria.SEVERAL,
}


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


PIECES: dict[str, Callable[[], str]] = {"law sites": sites, "law forms": form_table}
for _name, _value in _THRESHOLDS.items():
    PIECES[f"law threshold {_name}"] = lambda value=_value: f"{value:g}"  # type: ignore[misc]
