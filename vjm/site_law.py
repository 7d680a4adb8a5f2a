"""A law at a site as an effect: found in measurements, written by hand, or both."""

from __future__ import annotations

import copy
from collections.abc import Mapping
from dataclasses import replace
from typing import Any, ClassVar, Self

import numpy as np

from vjm.effects.base import Changing, Effect, Parameter, Rig, Values
from vjm.forms import forms
from vjm.forms.base import Form, Quantity
from vjm.law_sites import SITE_KINDS, SiteKind
from vjm.laws import Law
from vjm.mechanisms.sites import chosen
from vjm.mirrored import mirrored
from vjm.site_joint import SiteJoint

ROOM = 1e3
"""Bounds of an amplitude, in typical sizes."""
UNSEEN = 0.01
"""Of what a law says in all, the typical size of a part that was found to be nothing."""


class SiteLaw(Effect):
    """A law of one form (`vjm.forms`) at a site (`vjm.law_sites`), the same function at all parts that the site names.

    site: kind of place, and after @ the tags of the parts that have it. form: by name. parameters: the form's numbers,
    named as `Quantity.identifier` says, in its order. mirrored: whether it acts on the coordinate of the other sign at
    the tips of the bars; the same for an odd law. held: shapes that are no numbers of a fit. A class is as a user would
    write it: `name`, `site`, `form`, `parameters`; `of` makes one by itself.
    """

    site: ClassVar[str]
    form: ClassVar[str]
    mirrored: ClassVar[bool] = False
    held: ClassVar[Mapping[str, float]] = {}
    title = "law at a site"
    equation = ""
    signature = "what the law does there"
    limits = "within the range in which it was found"
    source = "found in measurements"

    @classmethod
    def of(cls, **attributes: Any) -> Self:
        """One with these attributes, as if a class had them. ValueError for a site, a form or a form there that is
        none."""
        it = copy.copy(_Plain())
        vars(it).update(attributes)
        it._completed()
        return it  # type: ignore[return-value]

    def __init__(self) -> None:
        if getattr(self, "form", None) is not None:
            self._completed()

    def _completed(self) -> None:
        kind, form = self.kind, self.law_form
        place = "series" if kind.series else "parallel"
        if place not in form.places:
            raise ValueError(f"the form {form.name} is none for {kind.name}: it is one in {form.places[0]}")
        vars(self).update(
            parts=kind.parts,
            equation=self.equation or form.equation,
            smooth=not form.memory and not form.kinked,
            history=form.memory,
            probes=(self.parameters[0].null + self.parameters[0].typical,)
            if form.memory or form.kinked
            else (),
        )

    @property
    def kind(self) -> SiteKind:
        """Of its site. ValueError for a name that is none."""
        name = self.site.partition("@")[0]
        if name not in SITE_KINDS:
            raise ValueError(f"{name!r} is no site of a law, allowed are {', '.join(SITE_KINDS)}")
        return SITE_KINDS[name]

    @property
    def law_form(self) -> Form:
        """ValueError for a name that is none."""
        if self.form not in forms():
            raise ValueError(f"{self.form!r} is no form of a law, allowed are {', '.join(forms())}")
        return forms()[self.form]

    def at(self, tags: str) -> Self:
        """ValueError: its site says where it is."""
        raise ValueError(f"{self.name} is at {self.site}, allowed is a class of its own for another site")

    def absent(self, values: Values) -> bool:
        return all(values[self._identifier(q)] == 0.0 for q in self.law_form.amplitudes)

    def _identifier(self, quantity: Quantity) -> str:
        return quantity.identifier(self.kind.gives, self.kind.over)

    def law(self, values: Values) -> Law:
        """Its law at these values, as a force or moment over a displacement."""
        form, known = self.law_form, {**self.held, **values}
        amplitudes, shapes = (
            np.array([known[self._identifier(q)] for q in some]) for some in (form.amplitudes, form.shapes)
        )
        return form.law(amplitudes, shapes, self.kind.series)

    def apply(self, mechanism: Changing, values: Values, site: str = "") -> Changing:
        self._check(mechanism.view)
        if self.kind.parts == "base":
            return (
                mechanism if self.absent(values) else mechanism.changed(self.change(mechanism.view, values))
            )
        tags = site or self.site.partition("@")[2]
        every = mechanism.places(self.kind.parts)
        places = chosen(every, tags) if tags else every
        if not places:
            raise ValueError(f"{self.name} needs hinges, and this rig has none")
        if self.absent(values):
            return mechanism
        law = self.law(values)
        for place in places:
            other = self.mirrored and "tip" in place.tags
            there = mirrored(law) if other else law
            mechanism = mechanism.changed_at(place, self._with(mechanism.seen_at(place), there))
        return mechanism

    def change(self, rig: Rig, values: Values) -> Rig:
        return self._with(rig, self.law(values))

    def _with(self, rig: Rig, law: Law) -> Rig:
        kind = self.kind
        if not kind.series:
            return replace(rig, hinges=(*rig.hinges, law))
        joint = SiteJoint(kind.axis, law)
        if kind.parts == "base":
            return replace(rig, base_joints=(*rig.base_joints, joint))
        return rig.altered(
            lambda _, link: replace(
                link, base_joints=(*link.base_joints, joint), tip_joints=(joint, *link.tip_joints)
            )
        )


class _Plain(SiteLaw):
    """One without anything of its own."""

    name = ""

    def __init__(self) -> None:
        pass


def parameters_of(
    form: Form, kind: SiteKind, values: Mapping[str, float], largest: float
) -> tuple[Parameter, ...]:
    """The numbers of a form at a kind of site as parameters of an effect, sized by values found, by name of the form.

    largest: of the coordinate, up to which the law was seen.
    """
    low, high = form.bounds(largest)
    bounds = dict(zip((q.name for q in form.shapes), zip(low, high, strict=True), strict=True))
    # An amplitude that is zero is sized by what the others say at the largest coordinate.
    said = max((abs(values[q.name]) * largest ** (-q.of_x) for q in form.amplitudes), default=0.0)
    out = []
    for quantity in form.quantities:
        if quantity.name in form.fixed:
            continue
        name, unit = (
            quantity.identifier(kind.gives, kind.over),
            quantity.unit(kind.gives, kind.over),
        )
        size = abs(values[quantity.name]) or UNSEEN * said * largest**quantity.of_x or 1.0
        if quantity in form.shapes:
            least, most = bounds[quantity.name]
            null, lowest, highest = values[quantity.name], float(least), float(most)
        else:
            null, highest = 0.0, ROOM * size
            lowest = 0.0 if quantity.positive else -highest
        out.append(Parameter(name, unit, null, size, lowest, highest, quantity.meaning))
    return tuple(out)
