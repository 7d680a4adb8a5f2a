"""The bar as all its springs at one place (Eq. 1)."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import Literal

import numpy as np

from vjm.bars import Limb, check_station, compliance_at_tip, spring_joints
from vjm.chain import Element, Fixed, Mark
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
    no such model: it is refined instead.
    """

    spring_at: SpringAt = "tip"

    def limb(self, link: Link) -> Limb:
        if link.fibres is not None:
            return Refined().limb(link)
        before = STATION[self.spring_at] * link.length
        elements: tuple[Element, ...] = (_ahead(before), *spring_joints(), _ahead(link.length - before))
        stretch = np.eye(6)[0]
        # A uniform load is half at either end with w L²/12 each: half at a sixth of the length from the end.
        sixth = np.array([link.length / 6, 0.0, 0.0])
        stations = ((Mark(0, sixth), 0.5), (Mark(len(elements), -sixth), 0.5))
        stiffness = move_stiffness(self._at_tip(link), [before - link.length, 0.0, 0.0])
        return Limb(elements, stiffness, np.zeros(6), stretch, stations=stations)

    def reach(self, link: Link, station: float) -> tuple[Element, ...]:
        if link.fibres is not None:
            return Refined().reach(link, station)
        check_station(station)
        place = STATION[self.spring_at]
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


def _ahead(distance: float) -> Fixed:
    return Fixed(np.array([distance, 0.0, 0.0]))
