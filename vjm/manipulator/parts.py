"""A manipulator as drawn: legs of parts, among them parallelograms with what effects have made of them.

Frames, units and orders are those of `vjm.frames`.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import partial
from typing import Literal

import numpy as np

from vjm import checks
from vjm.bars import BarModel
from vjm.frames import Array, move_stiffness, rotation_y
from vjm.laws import Law
from vjm.link import Link
from vjm.lumped import Lumped
from vjm.parts import Coordinate, Elastic, Leg, Part, Swinging, parallelogram
from vjm.refined import Refined
from vjm.sensors import Sensor

Bars = Literal["pair", "equivalent"]
_FREE = 2
_KEPT = [0, 1, 3, 4, 5]


@dataclass(frozen=True, eq=False)
class AsBuilt:
    """Two bars between four hinges as they are, whatever was drawn; see `vjm.mechanisms.parallelogram`.

    links: bar 1 and 2. model: of both. hinges: laws of the turn of each hinge, at base and tip of bar 1, then of bar 2.
    wider: mm added to both widths. line_load: (3,) N/mm along the bars, base frame.
    """

    links: tuple[Link, ...]
    model: BarModel
    hinges: tuple[tuple[Law, ...], ...] = ((), (), (), ())
    wider: float = 0.0
    line_load: Array = field(default_factory=lambda: np.zeros(3))


@dataclass(frozen=True, eq=False)
class Parallelogram:
    """Two bars of one length between four parallel hinges about y, `width` apart along z (Eq. 1).

    It starts and ends midway between the hinges; its end keeps its orientation. length, width: mm. bar_stiffness:
    (6, 6) of one bar at its tip, base clamped, bar frame. radial mm/N, tilt rad/(N·mm): give of each hinge axis
    across itself. home: bar angle q from which inverse kinematics starts, rad.
    bars: "pair", two bars with pins, or "equivalent", one pseudo-rigid bar with the same stiffness at rest.
    segments: as in `ElasticLink`, of a pair. fibre_y, fibre_z: outermost fibres of the bars, mm, where known.
    built: what effects have made of it (`vjm.manipulator.effects`); None: as drawn.
    ValueError for sizes that are not positive, a negative give or a K_b that is no stiffness.
    """

    length: float
    width: float
    bar_stiffness: Array
    radial: float = 0.0
    tilt: float = 0.0
    home: float = 0.0
    bars: Bars = "pair"
    segments: int = 0
    fibre_y: float | None = None
    fibre_z: float | None = None
    built: AsBuilt | None = None

    def __post_init__(self) -> None:
        checks.positive("length", self.length)
        checks.positive("width", self.width)
        for name in ("radial", "tilt"):
            if not 0.0 <= getattr(self, name) < np.inf:
                raise ValueError(f"{name} must be zero or more and finite, got {getattr(self, name)}")
        matrix = checks.stiffness_matrix("bar_stiffness", self.bar_stiffness)
        object.__setattr__(self, "bar_stiffness", matrix)

    @property
    def link(self) -> Link:
        """One bar between its hinge axes."""
        give = np.diag([self.radial, 0.0, self.radial, self.tilt, 0.0, self.tilt])
        return Link(self.length, self.bar_stiffness, base_give=give, tip_give=give)

    @property
    def as_built(self) -> AsBuilt:
        """Its bars and hinges, with what effects have made of them."""
        if self.built is not None:
            return self.built
        model: BarModel = Refined(self.segments) if self.segments else Lumped("tip")
        return AsBuilt((self.link, self.link), model)

    @property
    def posture(self) -> tuple[Coordinate, ...]:
        """The angle of the bars."""
        return (Coordinate("rotation", self.home),)

    @property
    def parts(self) -> tuple[Part, ...]:
        """Its bars between four hinges, or the one that stands for them."""
        if self.bars == "equivalent":
            return (Swinging(self.length, partial(pseudo_rigid_springs, self.link, self.width), self.home),)
        built = self.as_built
        first, second = (Elastic(link, built.model, built.line_load, self.length) for link in built.links)
        return (parallelogram((first, second), self.width + built.wider, built.hinges, self.home),)


def pseudo_rigid_springs(link: Link, width: float, q: Array) -> Array:
    """(..., 5, 5) stiffness of (x, y, rx, ry, rz) at the end of two such bars in the bar frame, at angles q (...), rad.

    At rest it is exact: between its two pins a bar keeps the same 6x6 in its own frame at any angle; only the levers
    to the middle of the linkage follow q.
    """
    arm = np.einsum("...ji,j->...i", rotation_y(q), [0.0, 0.0, 0.5 * width])
    pinned = pinned_bar(link)
    whole = move_stiffness(pinned, arm) + move_stiffness(pinned, -arm)
    return np.asarray(whole[..., _KEPT, :][..., _KEPT])


def pinned_bar(link: Link) -> Array:
    """(6, 6) of one bar between its two pins, at the tip pin, bar frame; z and ry are free."""
    at_tip = np.linalg.inv(np.linalg.inv(link.stiffness) + link.give)
    at_tip = 0.5 * (at_tip + at_tip.T)
    # Turning the base pin carries the tip along z; turning the tip pin turns it.
    free = np.array([[0.0, 0.0, -link.length, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 0.0, 1.0, 0.0]]).T
    spent = at_tip @ free
    left = at_tip - spent @ np.linalg.solve(free.T @ spent, spent.T)
    left[_FREE] = left[:, _FREE] = left[4] = left[:, 4] = 0.0
    return left


@dataclass(frozen=True, eq=False)
class Manipulator:
    """Legs in parallel between the base and one platform; length: a characteristic length, mm.

    sensors: from true pose and load of the platform to what is read (`vjm.sensors`). gravity: (3,) unit vector of
    weights given without a direction. mount: (3,) rotation vector, rad, by which all legs are turned already.
    ValueError without a leg.
    """

    name: str
    legs: tuple[Leg, ...]
    length: float
    sensors: tuple[Sensor, ...] = ()
    gravity: Array = field(default_factory=lambda: np.array([0.0, 0.0, -1.0]))
    mount: Array = field(default_factory=lambda: np.zeros(3))

    def __post_init__(self) -> None:
        checks.positive("length", self.length)
        if not self.legs:
            raise ValueError("a manipulator has one leg or more")
