"""Single hinges and bars of a rig, so that an effect can act on some of them.

A place is named by tags: of a bar its number, "1" or "2", of a hinge that and its end, "base" or "tip". A site, tags
joined by dots, stands for all places that carry them all.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import Field, dataclass, fields, replace
from typing import Any, ClassVar, Protocol, Self, TypeVar

import numpy as np

from vjm.laws import Law
from vjm.link import Link
from vjm.mechanisms.assembly import Alteration


class Tagged(Protocol):
    """Something that a site may name by its tags, the outermost first."""

    @property
    def tags(self) -> tuple[str, ...]: ...


class Rig(Protocol):
    """A rig of bars and hinges; a frozen dataclass, whose further fields are those of the whole."""

    __dataclass_fields__: ClassVar[dict[str, Field[Any]]]

    @property
    def hinges(self) -> tuple[Law, ...]: ...

    @property
    def alterations(self) -> tuple[Alteration, ...]: ...

    def changed(self, view: object) -> Self: ...

    @property
    def links(self) -> tuple[Link, ...]: ...

    @property
    def hinged(self) -> tuple[bool, bool]: ...

    @property
    def hinge_laws(self) -> tuple[tuple[Law, ...], ...]: ...


One = TypeVar("One", bound=Tagged)
Same = TypeVar("Same", bound=Rig)


@dataclass(frozen=True)
class Place:
    """A bar, number 0 or 1, or its hinge at one end, 0 at the base and 1 at the tip."""

    bar: int
    end: int | None = None

    @property
    def tags(self) -> tuple[str, ...]:
        """Its number, and the name of the end."""
        return (str(self.bar + 1), *(() if self.end is None else (("base", "tip")[self.end],)))


def places(rig: Rig, parts: str) -> tuple[Place, ...]:
    """All places of a rig: its "hinges" or its "bars"; none for other parts."""
    bars = range(len(rig.links))
    if parts == "bars":
        return tuple(Place(bar) for bar in bars)
    ends = [k for k, there in enumerate(rig.hinged) if there] if parts == "hinges" else []
    return tuple(Place(bar, end) for bar in bars for end in ends)


def chosen(every: Iterable[One], site: str) -> tuple[One, ...]:
    """Those that carry all tags of a site. ValueError where there is none, with what is allowed."""
    them, tags = tuple(every), set(site.split("."))
    found = tuple(each for each in them if tags <= set(each.tags))
    if not found:
        if not them:
            raise ValueError(f"no part is at {site!r}: what acts there acts on the whole, without a site")
        known = ", ".join(".".join(each.tags) for each in them)
        raise ValueError(f"no part is at {site!r}, allowed are some of the tags of: {known}")
    return found


def seen_at(rig: Same, place: Place) -> Same:
    """The rig with the laws of one hinge as those of all, which an effect then changes."""
    if place.end is None:
        return rig
    return replace(rig, hinges=rig.hinge_laws[2 * place.bar + place.end], single_hinges=())


def changed_at(rig: Same, place: Place, view: Same) -> Same:
    """The rig with what has been made of `seen_at`, at that place only; itself where that is nothing.

    ValueError where more than a bar or a hinge has been changed.
    """
    seen = seen_at(rig, place)
    apart = {"hinges", "single_hinges", "alterations"} if place.end is not None else {"alterations"}
    names = [each.name for each in fields(rig) if each.name not in apart]
    if other := [name for name in names if _differ(getattr(view, name), getattr(seen, name))]:
        raise ValueError(f"{other[0]} is not that of one part, allowed is the effect without a site")
    only = _Only(place, view.alterations[len(seen.alterations) :])
    old = rig.links[place.bar]
    new = only(place.bar, old)
    same = all(not _differ(getattr(new, each.name), getattr(old, each.name)) for each in fields(Link))
    if same and view.hinges == seen.hinges:
        return rig
    alterations = rig.alterations if same else (*rig.alterations, only)
    if place.end is None:
        return replace(rig, alterations=alterations)
    laws = list(rig.hinge_laws)
    laws[2 * place.bar + place.end] = view.hinges
    return replace(rig, hinges=(), single_hinges=tuple(laws), alterations=alterations)


def _differ(one: object, other: object) -> bool:
    if isinstance(one, np.ndarray) and isinstance(other, np.ndarray):
        return not np.array_equal(one, other)
    return one is not other and one != other


@dataclass(frozen=True)
class _Only:
    """Alterations at one place: of a bar all that they change, of a hinge what gives and slides there."""

    place: Place
    alterations: tuple[Alteration, ...]

    def __call__(self, number: int, link: Link) -> Link:
        if number != self.place.bar:
            return link
        new = link
        for alter in self.alterations:
            new = alter(number, new)
        if self.place.end is None:
            return new
        if self.place.end == 0:
            return replace(link, base_give=new.base_give, slides=new.slides, base_joints=new.base_joints)
        return replace(link, tip_give=new.tip_give, tip_joints=new.tip_joints)


class WithPlaces:
    """A rig of the bench for effects to change, whole or at single places (`vjm.effects.base.Viewed`)."""

    @property
    def view(self) -> Self:
        """What effects see of it: itself."""
        return self

    def changed(self, view: object) -> Self:
        """It as its view has been changed. ValueError for something else than such a rig."""
        if not isinstance(view, type(self)):
            raise ValueError(f"an effect makes {type(view).__name__} of a {type(self).__name__.lower()}")
        return view

    def places(self: Rig, parts: str) -> tuple[Place, ...]:
        """Its "hinges" or "bars" one by one; none for other parts."""
        return places(self, parts)

    def seen_at(self: Same, place: Place) -> Same:
        """What effects see of it at one of these."""
        return seen_at(self, place)

    def changed_at(self: Same, place: Place, view: object) -> Same:
        """It as what is `seen_at` a place has been changed. ValueError where more has been changed."""
        return changed_at(self, place, self.changed(view))
