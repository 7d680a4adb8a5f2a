"""What a leg is made of, from the base to the platform; each part starts in the frame where the one before it ends.

Frames, units and orders are those of `vjm.frames`. A part that has a place in the posture (actuator, passive joint,
parallelogram) has one coordinate there: mm or rad.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Literal

import numpy as np

from vjm import checks
from vjm.bars import BarModel
from vjm.frames import Array
from vjm.laws import Law
from vjm.link import Link
from vjm.lumped import Lumped
from vjm.refined import Refined
from vjm.sensors import Sensor

Kind = Literal["translation", "rotation"]
Bars = Literal["pair", "equivalent"]


@dataclass(frozen=True, eq=False)
class Frame:
    """Rigid link: translate by (3,), mm, then turn by (3, 3)."""

    translation: Array = field(default_factory=lambda: np.zeros(3))
    rotation: Array = field(default_factory=lambda: np.eye(3))


@dataclass(frozen=True)
class Actuator:
    """Actuated joint along or about a unit axis.

    stiffness: of drive and transmission, N/mm or N·mm/rad; None: rigid. home: coordinate from which inverse
    kinematics starts. limits: lowest and highest coordinate.
    """

    kind: Kind
    axis: tuple[float, float, float]
    stiffness: float | None = None
    home: float = 0.0
    limits: tuple[float, float] = (-np.inf, np.inf)


@dataclass(frozen=True)
class Passive:
    """Perfect passive joint along or about a unit axis; home as for `Actuator`."""

    kind: Kind
    axis: tuple[float, float, float]
    home: float = 0.0


@dataclass(frozen=True)
class Virtual:
    """One-coordinate spring along or about a unit axis; stiffness N/mm or N·mm/rad."""

    kind: Kind
    axis: tuple[float, float, float]
    stiffness: float


@dataclass(frozen=True, eq=False)
class ElasticLink:
    """Elastic link along x.

    length: mm. stiffness: (6, 6) at its tip, base clamped, in its own frame. segments: number of beam segments,
    which have geometric stiffness (`vjm.refined`); 0: the 6x6 lumped at the tip.
    ValueError for a length below zero or a stiffness that is not symmetric positive definite.
    """

    length: float
    stiffness: Array
    segments: int = 0

    def __post_init__(self) -> None:
        if not (np.isfinite(self.length) and self.length >= 0.0):
            raise ValueError(f"length must be zero or more and finite, got {self.length}")
        if self.segments and self.length == 0.0:
            raise ValueError("a link of no length has no segments")
        object.__setattr__(self, "stiffness", checks.stiffness_matrix("stiffness", self.stiffness))


@dataclass(frozen=True, eq=False)
class AsBuilt:
    """Two bars between four hinges as they are, whatever was drawn; see `vjm.mechanisms.parallelogram`.

    links: bar 1 and 2. model: of both. hinges: laws of the turn of each hinge. wider: mm added to both widths.
    line_load: (3,) N/mm along the bars, base frame.
    """

    links: tuple[Link, ...]
    model: BarModel
    hinges: tuple[Law, ...] = ()
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


Part = Frame | Actuator | Passive | Virtual | ElasticLink | Parallelogram
MOVING = (Actuator, Passive, Parallelogram)
"""Parts with a coordinate in the posture."""


@dataclass(frozen=True, eq=False)
class Leg:
    """Parts from the base frame to the platform point, and a name for messages."""

    name: str
    parts: tuple[Part, ...]

    @property
    def moving(self) -> tuple[Actuator | Passive | Parallelogram, ...]:
        """The parts that the posture sets, base first."""
        return tuple(part for part in self.parts if isinstance(part, MOVING))

    @property
    def home(self) -> Array:
        """(m,) their coordinates where inverse kinematics starts."""
        return np.array([part.home for part in self.moving], dtype=float)

    @property
    def actuators(self) -> np.ndarray:
        """Numbers of the actuators among the moving parts."""
        return np.array([k for k, part in enumerate(self.moving) if isinstance(part, Actuator)], dtype=int)


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
