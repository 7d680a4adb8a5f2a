"""Physical effects on a whole manipulator: each parallelogram, if there is one, has them as it would on the bench.

What an effect does to bars and hinges it does to every parallelogram of every leg; what happens between the base and
the ground, or at the sensors, happens once, at the base frame and at the platform point.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Self

import numpy as np

from vjm.effects.base import Effect, Values
from vjm.frames import exp
from vjm.laws import Law
from vjm.manipulator.parts import AsBuilt, Manipulator, Parallelogram
from vjm.mechanisms.assembly import Alteration, as_built
from vjm.mechanisms.parallelogram import Parallelogram as Bench
from vjm.mechanisms.sites import Place
from vjm.parts import Frame, Leg, Part
from vjm.sensors import Sensor


def with_effect(manipulator: Manipulator, effect: Effect, values: Values, site: str = "") -> Manipulator:
    """The manipulator with the effect; itself where all values are null.

    values: by parameter name, complete. site: see `vjm.effects.base.Effect.apply`; the outer tags of a part are its
    leg's name and "parallelogram", numbered from 1 where its leg has several. Drives and inverse kinematics still go by
    the drawing. ValueError for an effect that it cannot have, as that of bars where there is no parallelogram.
    """
    return effect.apply(Shown(manipulator), values, site).manipulator


@dataclass(frozen=True, eq=False)
class Shown:
    """A manipulator for effects to change (`vjm.effects.base.Viewed`)."""

    manipulator: Manipulator

    @property
    def view(self) -> Bench:
        """What effects see of it."""
        return view_of(self.manipulator)

    @property
    def length(self) -> float:
        """A characteristic length, mm."""
        return self.manipulator.length

    @property
    def sensors(self) -> tuple[Sensor, ...]:
        """From true pose and load to what is read."""
        return self.manipulator.sensors

    def changed(self, view: object) -> Self:
        """It as its view has been changed."""
        return self._made(with_view(self.manipulator, view))

    def places(self, parts: str) -> tuple[MachinePlace, ...]:
        """The hinges or bars of its parallelograms one by one; none for other parts."""
        return places(self.manipulator, parts)

    def seen_at(self, place: MachinePlace) -> Bench:
        """What effects see of it at one of these."""
        return seen_at(self.manipulator, place)

    def changed_at(self, place: MachinePlace, view: object) -> Self:
        """It as what is `seen_at` a place has been changed; itself where that is nothing."""
        return self._made(changed_at(self.manipulator, place, view))

    def with_parts(self, change: Callable[[Part], Part], site: str) -> Self:
        """It with every part of its legs changed, or of the leg of this name; itself where nothing is. ValueError for a
        name that no leg has."""
        names = [leg.name for leg in self.manipulator.legs]
        if site and site not in names:
            raise ValueError(f"there is no leg {site!r}, allowed are {', '.join(names)}")
        legs = tuple(
            _with_parts(leg, change) if site in ("", leg.name) else leg for leg in self.manipulator.legs
        )
        same = all(a is b for a, b in zip(legs, self.manipulator.legs, strict=True))
        return self if same else self._made(replace(self.manipulator, legs=legs))

    def _made(self, manipulator: Manipulator) -> Self:
        return self if manipulator is self.manipulator else replace(self, manipulator=manipulator)


@dataclass(frozen=True)
class MachinePlace:
    """A bar or a hinge of a parallelogram, by the numbers of its leg and its part; names: of both."""

    leg: int
    part: int
    names: tuple[str, str]
    inside: Place

    @property
    def tags(self) -> tuple[str, ...]:
        """Its names, the outermost first."""
        return (*self.names, *self.inside.tags)


def places(manipulator: Manipulator, parts: str) -> tuple[MachinePlace, ...]:
    """All bars or hinges of its parallelograms, leg after leg."""
    out = []
    for k, leg in enumerate(manipulator.legs):
        at = [n for n, part in enumerate(leg.parts) if isinstance(part, Parallelogram)]
        for count, n in enumerate(at, start=1):
            name = f"parallelogram{count}" if len(at) > 1 else "parallelogram"
            inside = _bench(manipulator, leg.parts[n]).places(parts)
            out += [MachinePlace(k, n, (leg.name, name), each) for each in inside]
    return tuple(out)


def seen_at(manipulator: Manipulator, place: MachinePlace) -> Bench:
    """What effects see of it at a place: the parallelogram as a rig, with what stands around the machine."""
    return _bench(manipulator, manipulator.legs[place.leg].parts[place.part]).seen_at(place.inside)


def changed_at(manipulator: Manipulator, place: MachinePlace, view: object) -> Manipulator:
    """The manipulator with what has been made of `seen_at`; other legs stay the same objects."""
    leg = manipulator.legs[place.leg]
    part = leg.parts[place.part]
    assert isinstance(part, Parallelogram)
    before = _bench(manipulator, part)
    # What an effect has seen is another object of the same values.
    rig = before.changed_at(place.inside, view)
    if rig is before:
        return manipulator
    built = AsBuilt(rig.links, part.as_built.model, rig.hinge_laws, rig.wider, rig.line_load)
    parts = list(leg.parts)
    parts[place.part] = replace(part, bars="pair", built=built)
    legs = list(manipulator.legs)
    legs[place.leg] = Leg(leg.name, tuple(parts))
    return replace(manipulator, legs=tuple(legs))


def _with_parts(leg: Leg, change: Callable[[Part], Part]) -> Leg:
    parts = tuple(change(part) for part in leg.parts)
    return leg if all(a is b for a, b in zip(parts, leg.parts, strict=True)) else Leg(leg.name, parts)


def linkages(manipulator: Manipulator) -> list[Parallelogram]:
    """Its parallelograms, leg after leg."""
    return [part for leg in manipulator.legs for part in leg.parts if isinstance(part, Parallelogram)]


def with_view(manipulator: Manipulator, rig: object) -> Manipulator:
    """The manipulator with what has been made of its `view_of`, done to every parallelogram.

    ValueError where it has been made something else. Legs in which nothing changes stay the same objects.
    """
    if not isinstance(rig, Bench):
        raise ValueError(f"an effect makes {type(rig).__name__} of a parallelogram")
    first = view_of(manipulator)
    more = rig.alterations[len(first.alterations) :]
    turned = exp(rig.mount) @ exp(manipulator.mount).T
    tilted = bool(np.any(rig.mount != manipulator.mount))
    same = rig.bar == first.bar and rig.hinges == first.hinges and rig.line_load is first.line_load
    if same and not more and not tilted and rig.wider == first.wider:
        return replace(manipulator, sensors=rig.sensors)

    def changed(part: Part) -> Part:
        if not isinstance(part, Parallelogram):
            return part
        drawn, model = part.as_built, rig.bar
        if model is None or model == first.bar:
            model = drawn.model
        links = as_built(part.link, 2, (_as_it_is(drawn), *more))
        laws = tuple(_with_laws(own, first.hinges, rig.hinges) for own in drawn.hinges)
        return replace(part, bars="pair", built=AsBuilt(links, model, laws, rig.wider, rig.line_load))

    legs = tuple(
        Leg(leg.name, (*((Frame(rotation=turned),) if tilted else ()), *map(changed, leg.parts)))
        for leg in manipulator.legs
    )
    return replace(manipulator, legs=legs, sensors=rig.sensors, mount=rig.mount)


def view_of(manipulator: Manipulator) -> Bench:
    """The first parallelogram as a rig of the bench at q = 0, with what stands around it; effects act on that.

    Without a parallelogram it is a `Surroundings`.
    """
    parts = linkages(manipulator)
    return _bench(manipulator, parts[0]) if parts else _surroundings(manipulator)


def _bench(manipulator: Manipulator, part: Part) -> Bench:
    """A parallelogram as a rig of the bench, with what stands around the machine."""
    assert isinstance(part, Parallelogram)
    built = part.as_built
    alike = all(laws == built.hinges[0] for laws in built.hinges)
    return Bench(
        part.length,
        part.width,
        part.bar_stiffness,
        bar=built.model,
        hinges=built.hinges[0] if alike else (),
        single_hinges=() if alike else built.hinges,
        alterations=(_as_it_is(built),),
        wider=built.wider,
        mount=manipulator.mount,
        line_load=built.line_load,
        gravity=manipulator.gravity,
        sensors=manipulator.sensors,
        fibre_y=part.fibre_y,
        fibre_z=part.fibre_z,
    )


def _with_laws(own: tuple[Law, ...], before: tuple[Law, ...], after: tuple[Law, ...]) -> tuple[Law, ...]:
    """Laws of a hinge when those of all have become others: what is added to them is added to it."""
    added = after[: len(before)] == before
    return (*own, *after[len(before) :]) if added else after


@dataclass(frozen=True, eq=False)
class Surroundings(Bench):
    """What stands around a manipulator without a parallelogram: its mount, its gravity, its sensors.

    name: of the manipulator. The bars are there for the form only: no effect can change them. ValueError for one that
    would.
    """

    name: str = "the manipulator"

    def __post_init__(self) -> None:
        super().__post_init__()
        changed = self.bar is not None or self.hinges or self.alterations or self.wider
        if changed or np.any(self.line_load):
            raise ValueError(f"effects of bars and hinges need a parallelogram, {self.name} has none")


def _surroundings(manipulator: Manipulator) -> Surroundings:
    length = manipulator.length
    return Surroundings(
        length,
        length,
        np.diag(np.repeat([1.0, length**2], 3)),
        mount=manipulator.mount,
        gravity=manipulator.gravity,
        sensors=manipulator.sensors,
        name=manipulator.name,
    )


def _as_it_is(built: AsBuilt) -> Alteration:
    return lambda number, _: built.links[number]
