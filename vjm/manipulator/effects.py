"""Physical effects on a whole manipulator: each parallelogram, if there is one, has them as it would on the bench.

What an effect does to bars and hinges it does to every parallelogram of every leg; what happens between the base and
the ground, or at the sensors, happens once, at the base frame and at the platform point.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from vjm.effects.base import Effect, Values
from vjm.frames import exp
from vjm.manipulator.parts import AsBuilt, Manipulator, Parallelogram
from vjm.mechanisms.assembly import Alteration, as_built
from vjm.mechanisms.parallelogram import Parallelogram as Bench
from vjm.parts import Frame, Leg, Part


def with_effect(manipulator: Manipulator, effect: Effect, values: Values) -> Manipulator:
    """The manipulator with the effect; itself where all values are null.

    values: by parameter name, complete. Drives and inverse kinematics still go by the drawing. ValueError for an
    effect that it cannot have, as that of bars where there is no parallelogram.
    """
    return effect.apply(_Shown(manipulator), values).manipulator


@dataclass(frozen=True, eq=False)
class _Shown:
    """A manipulator for effects to change (`vjm.effects.base.Viewed`)."""

    manipulator: Manipulator

    @property
    def view(self) -> Bench:
        return view_of(self.manipulator)

    def changed(self, view: object) -> _Shown:
        return _Shown(with_view(self.manipulator, view))


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
    same = all(getattr(rig, name) is getattr(first, name) for name in ("bar", "hinges", "line_load"))
    if same and not more and not tilted and rig.wider == first.wider:
        return replace(manipulator, sensors=rig.sensors)

    def changed(part: Part) -> Part:
        if not isinstance(part, Parallelogram):
            return part
        drawn, model = part.as_built, rig.bar
        if model is None or model is first.bar:
            model = drawn.model
        links = as_built(part.link, 2, (_as_it_is(drawn), *more))
        return replace(
            part, bars="pair", built=AsBuilt(links, model, (rig.hinges,) * 4, rig.wider, rig.line_load)
        )

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
    if not parts:
        return _surroundings(manipulator)
    part, built = parts[0], parts[0].as_built
    return Bench(
        part.length,
        part.width,
        part.bar_stiffness,
        bar=built.model,
        hinges=built.hinges[0],
        alterations=(_as_it_is(built),),
        wider=built.wider,
        mount=manipulator.mount,
        line_load=built.line_load,
        gravity=manipulator.gravity,
        sensors=manipulator.sensors,
        fibre_y=part.fibre_y,
        fibre_z=part.fibre_z,
    )


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
