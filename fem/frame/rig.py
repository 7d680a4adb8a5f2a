"""What a bench was drawn to be: linkage, bars, known weights."""

from dataclasses import dataclass
from math import cos, pi, sin

import numpy as np

from fem.frame.section import Section, section_of
from meshes.solid import Floats

KINDS, BASES, TIPS = ("parallelogram", "bar"), ("clamped", "pinned"), ("free", "pinned", "guided")
HELD = {"free": (), "guided": (3, 4, 5), "pinned": (1, 2, 3, 4, 5)}
"""Platform coordinates, from 0, that each kind of tip of a single bar holds."""


@dataclass(frozen=True)
class Gauge:
    """Displacement of the point at `station` (0 base, 1 tip) of `bar` (1 or 2) along a base-frame direction.

    offset: of a gauge on the platform instead, its point from that of the platform as drawn, mm, base frame.
    """

    name: str
    bar: int
    station: float
    direction: tuple[float, float, float]
    offset: tuple[float, float, float] | None = None


@dataclass(frozen=True, eq=False)
class Rig:
    """A rig as drawn; N, mm, rad.

    kind: "parallelogram" (two bars `width` apart, four hinges about y, platform point midway between the outer ones)
    or "bar" (base "clamped" or "pinned" about y; tip "free", "guided": shifts but does not turn, or "pinned": a hinge
    about y to a block, the platform, that slides along x only). bar: a Section, or a (6, 6) stiffness at the tip.
    gravity: direction in the base frame of line_weight N/mm and platform_weight N (known weights).
    fibre_y, fibre_z: outermost fibres, mm; material_yield needs them. Raises ValueError for what is not so.
    """

    kind: str
    length: float
    bar: Section | Floats
    width: float = 0.0
    base: str = "clamped"
    tip: str = "free"
    gravity: tuple[float, float, float] = (0.0, 0.0, -1.0)
    line_weight: float = 0.0
    platform_weight: float = 0.0
    reference_temperature: float = 20.0
    fibre_y: float = 0.0
    fibre_z: float = 0.0

    def __post_init__(self) -> None:
        for name, value, allowed in (("kind", self.kind, KINDS), ("base", self.base, BASES)):
            if value not in allowed:
                raise ValueError(f"{name} is {value!r}, allowed are {', '.join(allowed)}")
        if self.tip not in TIPS:
            raise ValueError(f"tip is {self.tip!r}, allowed are {', '.join(TIPS)}")
        if not self.length > 0.0:
            raise ValueError(f"length is {self.length:g} mm, allowed are positive lengths")
        if self.kind == "parallelogram" and not self.width > 0.0:
            raise ValueError(f"width is {self.width:g} mm, allowed are positive widths")
        if not np.linalg.norm(self.gravity) > 0.0:
            raise ValueError("gravity has no direction")

    @property
    def bars(self) -> int:
        """Number of bars."""
        return 2 if self.kind == "parallelogram" else 1

    @property
    def section(self) -> Section:
        """The bars' section."""
        return self.bar if isinstance(self.bar, Section) else section_of(self.bar, self.length)

    @property
    def held(self) -> tuple[int, ...]:
        """Platform coordinates that the supports hold."""
        return HELD[self.tip] if self.kind == "bar" else ()

    @property
    def mechanism(self) -> tuple[int, ...]:
        """Platform coordinates along which the ideal linkage moves without load."""
        loose = self.kind == "parallelogram" or (self.base == "pinned" and self.tip == "free")
        return (2,) if loose else ()

    def hinged(self, end: int) -> bool:
        """Whether the bars have a hinge at base (0) or tip (1)."""
        return self.kind == "parallelogram" or (self.base, self.tip)[end] == "pinned"

    def platform(self, q: float) -> Floats:
        """(3,) nominal unloaded platform point at the bars' angle q, rad."""
        return self.length * np.array([cos(q), 0.0, -sin(q)])


STEEPEST_DEG = 85.0
"""Largest angle of the bars of a parallelogram, degrees, either way: at 90 nothing holds its platform along x."""


def steep(q: float) -> bool:
    """Whether an angle of the bars, rad, is beyond the steepest one; rounding of the conversion does not count."""
    return abs(q) > STEEPEST_DEG / 180.0 * pi * (1.0 + 1e-12)
