"""What a model of one elastic bar gives to a chain."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Protocol

import numpy as np

from vjm.chain import Chain, Element, Joint, Mark, Role
from vjm.frames import Array
from vjm.laws import Spring
from vjm.link import Link

X, Y, Z = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)


@dataclass(frozen=True, eq=False)
class Limb:
    """A bar along x from its base to its tip, with v virtual coordinates.

    elements: the chain's part. stiffness: (v, v) of its virtual coordinates. springs: further laws, their
    coordinates counted from the bar's first one. rest: (v,) coordinates of the unloaded bar. stretch: (v,)
    change of them with a stress-free lengthening by 1 mm. stations: points that share out a line load, each with
    its share of the length; statically they replace it between the nodes.
    """

    elements: tuple[Element, ...]
    stiffness: Array
    rest: Array
    stretch: Array
    springs: tuple[Spring, ...] = ()
    stations: tuple[tuple[Mark, float], ...] = ()

    def numbered_from(self, first: int) -> tuple[Spring, ...]:
        """The further laws for a chain whose coordinate number `first` is the bar's first one."""
        return tuple(replace(s, coordinates=tuple(first + c for c in s.coordinates)) for s in self.springs)


class BarModel(Protocol):
    """How a `Link` becomes part of a chain.

    limb: the bar from base to tip, without its slides. reach: elements from its base to the point of its axis
    at `station` (0 base, 1 tip); ValueError for a station outside. Unloaded, every model has the stiffness of
    the link.
    """

    def limb(self, link: Link) -> Limb: ...

    def reach(self, link: Link, station: float) -> tuple[Element, ...]: ...


def spring_joints() -> tuple[Joint, ...]:
    """The six virtual joints of Eq. 1 in its order: T_x T_y T_z R_x R_y R_z."""
    shifts = tuple(Joint("translation", axis, Role.VIRTUAL) for axis in (X, Y, Z))
    return shifts + tuple(Joint("rotation", axis, Role.VIRTUAL) for axis in (X, Y, Z))


def compliance_at_tip(limb: Limb) -> Array:
    """(6, 6) of the unloaded limb, base clamped: J K^-1 J^T with J by twists at its tip."""
    jacobian = Chain(limb.elements).jacobian(limb.rest)
    tangent = limb.stiffness.copy()
    for spring in limb.springs:
        numbers = np.array(spring.coordinates)
        strain = np.zeros(numbers.size)
        tangent[numbers[:, None], numbers] += spring.law.respond(strain, spring.law.initial_memory).tangent
    scale = 1.0 / np.sqrt(np.diag(tangent))
    inner = np.linalg.inv(scale[:, None] * tangent * scale)
    scaled = jacobian * scale
    return np.asarray(scaled @ inner @ scaled.T)


def check_station(station: float) -> None:
    """ValueError unless the station lies on the bar."""
    if not 0.0 <= station <= 1.0:
        raise ValueError(f"a station lies between 0 (base) and 1 (tip), got {station}")
