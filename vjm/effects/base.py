"""What a physical effect is: parameters with a null value, and a change of the mechanism.

At its null values an effect changes nothing, exactly. Effects compose by being applied in turn, and commute
as far as the physics does. An effect that happens at the sensors adds one of `vjm.sensors`.
"""

from __future__ import annotations

import copy
from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import partial
from typing import Any, ClassVar, Literal, Protocol, Self, TypeAlias, TypeVar, runtime_checkable

import numpy as np

from vjm.frames import Array
from vjm.link import Link
from vjm.mechanisms.bar import Bar
from vjm.mechanisms.parallelogram import Parallelogram
from vjm.mechanisms.sites import Tagged, chosen

Rig: TypeAlias = Parallelogram | Bar
Where = TypeVar("Where", bound=Tagged)
Values = Mapping[str, float]


Parts = Literal["hinges", "bars", "links", "drives", "base", "platform", "sensors"]


class Viewed(Protocol[Where]):
    """What effects can change: it shows a rig of bars and hinges, and takes what has been made of that.

    places: its single parts of a kind, with their tags (`vjm.mechanisms.sites`); at each it shows a rig and takes what
    has been made of it there.
    """

    @property
    def view(self) -> Rig: ...

    def changed(self, view: object) -> Self: ...

    def places(self, parts: str) -> tuple[Where, ...]: ...

    def seen_at(self, place: Where) -> Rig: ...

    def changed_at(self, place: Where, view: object) -> Self: ...


@runtime_checkable
class OfLegs(Protocol):
    """A machine, whose legs have parts of their own."""

    def with_parts(self, change: Callable[[Any], Any], site: str) -> Self:
        """It with every part of its legs changed, or of the leg of this name; itself where nothing is. ValueError for a
        name that no leg has."""
        ...


Changing = TypeVar("Changing", bound=Viewed[Any])


@dataclass(frozen=True)
class Parameter:
    """One number of an effect.

    null: where the effect is absent. typical: the size of a real one, from null. low, high: bounds.
    one_sided: only one direction from null has a meaning. along: "x" to "rz", where it is a compliance that carries the
    whole rig: its sizes then go with what the rig gives in that direction.
    """

    name: str
    unit: str
    null: float
    typical: float
    low: float
    high: float
    meaning: str
    along: str = ""

    @property
    def one_sided(self) -> bool:
        """Whether null is a bound."""
        return self.null in (self.low, self.high)

    def times(self, factor: float) -> Parameter:
        """All its sizes so many times as large."""
        if factor == 1.0:
            return self
        values = {name: factor * getattr(self, name) for name in ("null", "typical", "low", "high")}
        return replace(self, **values)


class Sizes(Protocol):
    """By how much sizes of a rig differ from those of the catalogue."""

    def __call__(self, unit: str, along: str = "") -> float:
        """Of a number in this unit, and of a compliance of the whole rig in a direction."""
        ...


class Effect(ABC):
    """A physical effect.

    name: canonical. title: in words. equation, signature (what it looks like in data), limits, source: text.
    parameters: none for an effect that is there or not. parts: what it acts on; "": hinges if it needs one, else bars.
    kinds: of rig that can have it. hinge: the one it needs of a single bar, "" for none; a parallelogram has all.
    smooth: False where the response has a kink or a dead zone in the parameters, so that a fit needs several
    starts and a derivative at null says little. probes: values of the first parameter at which to look for such an
    effect. history: whether the order of load steps matters. includes: effects that it cannot be without. nominal:
    names of tolerances of which it is the excess; with none of them it is not looked for. tags: of the parts that
    have it, joined by dots, where it is not all of them alike.
    """

    name: ClassVar[str]
    title: ClassVar[str]
    equation: ClassVar[str]
    signature: ClassVar[str]
    limits: ClassVar[str]
    source: ClassVar[str]
    parameters: ClassVar[tuple[Parameter, ...]] = ()
    parts: ClassVar[Parts | Literal[""]] = ""
    kinds: ClassVar[tuple[str, ...]] = ("parallelogram", "bar")
    hinge: ClassVar[Literal["", "base", "any"]] = ""
    smooth: ClassVar[bool] = True
    probes: ClassVar[tuple[float, ...]] = ()
    history: ClassVar[bool] = False
    includes: ClassVar[tuple[str, ...]] = ()
    nominal: ClassVar[tuple[str, ...]] = ()
    tags: str = ""

    def at(self, tags: str) -> Self:
        """The same effect at the parts with these tags alone, named after them: `joint_friction@tip`. Which tags there
        are is said by the rig that it is put in. ValueError for none."""
        if not all(tags.split(".")):
            raise ValueError(f"{tags!r} are no tags, allowed are names joined by dots, as in {self.name}@tip")
        it, own = copy.copy(self), type(self)
        vars(it).update(name=f"{own.name}@{tags}", title=f"{own.title}, at {tags}", tags=tags)
        return it

    @abstractmethod
    def change(self, rig: Rig, values: Values) -> Rig:
        """The mechanism with the effect at values that are not all null."""

    def apply(self, mechanism: Changing, values: Values, site: str = "") -> Changing:
        """The mechanism with the effect; itself where all values are null.

        values: by parameter name, complete. site: tags of the parts that have it, joined by dots; "": its own `tags`.
        ValueError for a kind of rig that cannot have it, and for a site at which there is nothing it acts on.
        """
        self._check(mechanism.view)
        site = site or self.tags
        if not site:
            return (
                mechanism if self.absent(values) else mechanism.changed(self.change(mechanism.view, values))
            )
        chosen_places, before = chosen(mechanism.places(self.acts_on), site), mechanism
        if self.absent(values):
            return mechanism
        for place in chosen_places:
            mechanism = mechanism.changed_at(place, self.change(mechanism.seen_at(place), values))
        if mechanism is before:
            raise ValueError(f"{self.name} changes nothing at {site!r}, allowed is a place that it acts on")
        return mechanism

    def refusal(self, rig: Rig) -> str:
        """Why a rig cannot have it by the numbers that were written of it, which a fit may go beyond; "" if it can."""
        return ""

    @property
    def acts_on(self) -> str:
        """The parts it acts on."""
        return self.parts or ("hinges" if self.hinge else "bars")

    def _check(self, view: Rig) -> None:
        """ValueError for a kind of rig that cannot have it."""
        if kind_of(view) not in self.kinds:
            raise ValueError(
                f"{self.name} needs a rig of kind {' or '.join(self.kinds)}, not {kind_of(view)}"
            )
        if self.hinge and not _hinged(view, self.hinge):
            where = "at its base" if self.hinge == "base" else "at either end"
            raise ValueError(f"{self.name} needs a bar with a hinge {where}")

    def sized_by(self, factor: Sizes) -> Self:
        """The effect with typical sizes, bounds and probes so many times those of its class, by their unit."""
        own, it = type(self), copy.copy(self)
        parameters = tuple(p.times(factor(p.unit, p.along)) for p in own.parameters)
        probes = tuple(value * factor(own.parameters[0].unit) for value in own.probes)
        # Attributes of the instance stand before those of its class.
        vars(it).update(parameters=parameters, probes=probes)
        return it

    def absent(self, values: Values) -> bool:
        """Whether the values leave every mechanism as it is."""
        return bool(self.parameters) and all(values[p.name] == p.null for p in self.parameters)

    @property
    def nulls(self) -> dict[str, float]:
        """The null value of every parameter."""
        return {p.name: p.null for p in self.parameters}

    @property
    def typicals(self) -> dict[str, float]:
        """Every parameter one typical size above null."""
        return {p.name: p.null + p.typical for p in self.parameters}


def kind_of(rig: Rig) -> str:
    """The rig's kind as a campaign names it."""
    return "parallelogram" if isinstance(rig, Parallelogram) else "bar"


def _hinged(rig: Rig, which: Literal["base", "any"]) -> bool:
    if isinstance(rig, Parallelogram):
        return True
    return rig.base == "pinned" or (which == "any" and rig.tip == "pinned")


def for_bars(rig: Rig, change: Callable[[Link], Link], only: int | None = None) -> Rig:
    """The mechanism with all bars changed, or only that number (0, 1)."""
    return rig.altered(partial(_one, change, only))


def _one(change: Callable[[Link], Link], only: int | None, number: int, link: Link) -> Link:
    return change(link) if only is None or number == only else link


def vector(values: Values, *names: str) -> Array:
    """(k,) values of k names, in their order."""
    return np.array([values[name] for name in names])


def adding(link: Link, **gives: Array) -> Link:
    """The bar with compliances added between it and its hinges."""
    return replace(link, **{name: getattr(link, name) + give for name, give in gives.items()})
