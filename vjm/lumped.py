"""The bar as all its springs at one place (Eq. 1)."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Literal

import numpy as np

from vjm.bars import Limb, X, Y, Z, check_station, compliance_at_tip, spring_joints
from vjm.chain import Element, Fixed, Joint, Mark, Role
from vjm.frames import Array, move_stiffness
from vjm.link import ByValue, Link
from vjm.refined import Refined

SpringAt = Literal["tip", "middle", "base"]
STATION: dict[SpringAt, float] = {"base": 0.0, "middle": 0.5, "tip": 1.0}

# Segments that stand for a bowed bar: the compliance of its half sine is then good to 1e-4 of the bow's part.
_BOWED = 24


@dataclass(frozen=True)
class Lumped:
    """All six springs at one place of an otherwise rigid bar (Eq. 1: at the tip).

    A bow enters as the compliance that a bowed bar has at its tip, and in no other way. A bar that yields has
    no such model: it is refined instead. With the springs at the tip a point between the ends moves as the axis of a
    uniform bar that is loaded at its tip only, a cubic; with the springs elsewhere the parts beside them are rigid.
    """

    spring_at: SpringAt = "tip"
    polar_radius: float = 0.0
    """mm, as of `vjm.refined.Refined`, which takes its place where the bar yields."""

    def limb(self, link: Link) -> Limb:
        if link.fibres is not None:
            return Refined(polar_radius=self.polar_radius).limb(link)
        before = STATION[self.spring_at] * link.length
        elements: tuple[Element, ...] = (_ahead(before), *_SPRINGS, _ahead(link.length - before))
        stretch = np.eye(6)[0]
        # A uniform load is half at either end with w L²/12 each: half at a sixth of the length from the end.
        sixth = np.array([link.length / 6, 0.0, 0.0])
        stations = ((Mark(0, sixth), 0.5), (Mark(len(elements), -sixth), 0.5))
        stiffness = move_stiffness(self._at_tip(link), [before - link.length, 0.0, 0.0])
        return Limb(elements, stiffness, np.zeros(6), stretch, stations=stations)

    def reach(self, link: Link, station: float) -> tuple[Element, ...]:
        if link.fibres is not None:
            return Refined(polar_radius=self.polar_radius).reach(link, station)
        check_station(station)
        place = STATION[self.spring_at]
        if place == 1.0 > station:
            return _shape(link.length, station)
        if station < place:
            return (_ahead(station * link.length),)
        *front, _ = self.limb(link).elements
        return (*front, _ahead((station - place) * link.length))

    @staticmethod
    def _at_tip(link: Link) -> Array:
        """(6, 6) of bar, bow and ends together; that of the bar untouched where there is nothing else."""
        if not (np.any(link.bow) or np.any(link.base_give) or np.any(link.tip_give)):
            return link.stiffness
        compliance = _bowed(link.by_value) if np.any(link.bow) else np.linalg.inv(link.stiffness) + link.give
        return np.asarray(np.linalg.inv(0.5 * (compliance + compliance.T)), dtype=np.float64)


@lru_cache(maxsize=1024)
def _bowed(key: ByValue) -> Array:
    """(6, 6) compliance at the tip of a bowed bar and its ends."""
    return compliance_at_tip(Refined(_BOWED).limb(key.link))


# Named, so that a point between the ends may follow them by its share.
_SPRINGS = tuple(replace(joint, tie=f"spring{k}") for k, joint in enumerate(spring_joints()))


def _shape(length: float, station: float) -> tuple[Element, ...]:
    """To the axis at a station: y = y_tip (3 s² - 2 s³) + L rz_tip (s³ - s²), z alike with -ry, x in proportion.

    These are the shapes of a uniform beam by its tip's displacement and slope, Hermite's cubics.
    """
    shift, slope = station**2 * (3.0 - 2.0 * station), length * station**2 * (station - 1.0)
    followed = ((X, 0, station), (Y, 1, shift), (Y, 5, slope), (Z, 2, shift), (Z, 4, -slope))
    joints = (
        Joint("translation", axis, Role.VIRTUAL, f"spring{spring}", share) for axis, spring, share in followed
    )
    return (_ahead(station * length), *joints)


def _ahead(distance: float) -> Fixed:
    return Fixed(np.array([distance, 0.0, 0.0]))
