"""Models of one elastic bar as part of a chain, and the lumped one of Eq. 1."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Literal, Protocol

import numpy as np

from vjm.chain import Element, Fixed, Joint, Role
from vjm.frames import Array, move_stiffness
from vjm.laws import Spring

SpringAt = Literal["tip", "middle", "base"]
STATION: dict[SpringAt, float] = {"base": 0.0, "middle": 0.5, "tip": 1.0}

X, Y, Z = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)


@dataclass(frozen=True, eq=False)
class Limb:
    """A bar along x from its base to its tip.

    elements: the chain's part. stiffness: (v, v) of its virtual coordinates. springs: further laws, their
    coordinates counted from the bar's first one.
    """

    elements: tuple[Element, ...]
    stiffness: Array
    springs: tuple[Spring, ...] = ()

    def numbered_from(self, first: int) -> tuple[Spring, ...]:
        """The further laws for a chain whose coordinate number `first` is the bar's first one."""
        return tuple(replace(s, coordinates=tuple(first + c for c in s.coordinates)) for s in self.springs)


class BarModel(Protocol):
    """How a bar of given length, mm, and stiffness (6, 6) at its tip, base clamped, becomes part of a chain.

    limb: the bar from base to tip. reach: elements from its base to the point of its axis at `station`
    (0 base, 1 tip); ValueError for a station outside. Unloaded, every model has the stiffness given.
    """

    def limb(self, length: float, stiffness: Array) -> Limb: ...

    def reach(self, length: float, stiffness: Array, station: float) -> tuple[Element, ...]: ...


def spring_joints() -> tuple[Joint, ...]:
    """The six virtual joints of Eq. 1 in its order: T_x T_y T_z R_x R_y R_z."""
    shifts = tuple(Joint("translation", axis, Role.VIRTUAL) for axis in (X, Y, Z))
    return shifts + tuple(Joint("rotation", axis, Role.VIRTUAL) for axis in (X, Y, Z))


@dataclass(frozen=True)
class Lumped:
    """All six springs at one place of an otherwise rigid bar (Eq. 1: at the tip)."""

    spring_at: SpringAt = "tip"

    def limb(self, length: float, stiffness: Array) -> Limb:
        before = STATION[self.spring_at] * length
        elements: tuple[Element, ...]
        elements = (Fixed(before * np.eye(3)[0]), *spring_joints(), Fixed((length - before) * np.eye(3)[0]))
        return Limb(elements, move_stiffness(stiffness, [before - length, 0.0, 0.0]))

    def reach(self, length: float, stiffness: Array, station: float) -> tuple[Element, ...]:
        check_station(station)
        place = STATION[self.spring_at]
        if station < place:
            return (Fixed(station * length * np.eye(3)[0]),)
        *front, _ = self.limb(length, stiffness).elements
        return (*front, Fixed((station - place) * length * np.eye(3)[0]))


def check_station(station: float) -> None:
    """ValueError unless the station lies on the bar."""
    if not 0.0 <= station <= 1.0:
        raise ValueError(f"a station lies between 0 (base) and 1 (tip), got {station}")
