"""Known effects that laws are by another name: those of the catalogue as forms say, and laws of users."""

from __future__ import annotations

from collections.abc import Mapping

from pipeline.discover.search import Discovery, Law
from pipeline.selection.fit_cache import Names
from vjm.effects.base import Effect
from vjm.forms import forms
from vjm.forms.base import Form
from vjm.site_law import SiteLaw


def effects_of(found: Discovery, known: Mapping[str, Effect]) -> Names:
    """The known effects that the laws are by another name."""
    laws = [law for law in found.laws if law.ways]
    return frozenset(name for law in laws for name in called(law, law.ways[0].formed.form, known))


def called(law: Law, form: Form, known: Mapping[str, Effect]) -> Names:
    """Known effects that are this form at the place of a law: those of the catalogue as the form says, and laws of
    users at one of the sites that are not told apart."""
    sites = {each.site.name for each in law.group}
    own = [
        name
        for name, it in known.items()
        if isinstance(it, SiteLaw) and it.form == form.name and it.site in sites
    ]
    return frozenset((*form.effects.get(law.site.kind, ()), *own))


def held_by(found: Discovery, known: Mapping[str, Effect]) -> Names:
    """The known effects that the laws are, alone, as one of two side by side, or at some of their numbers."""
    laws = [law for law in found.laws if law.ways]
    parts = [(law, forms()[part]) for law in laws for part in law.ways[0].formed.form.name.split("+")]
    every = [(law, other) for law, form in parts for other in (form, *(forms()[name] for name in form.holds))]
    return frozenset(name for law, form in every for name in called(law, form, known))
