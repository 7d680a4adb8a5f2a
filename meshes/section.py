"""Parametric cross-sections of a bar: their outline as four-sided patches and their exact moments.

Conventions: section coordinates (y, z) in mm, origin at the centroid, every section symmetric about both
axes. A patch is a four-sided region with counter-clockwise corners; an edge may be an arc about the origin.
"""

from dataclasses import dataclass, fields
from math import cos, isfinite, pi, sin
from typing import Protocol, runtime_checkable

Point = tuple[float, float]


@dataclass(frozen=True)
class Patch:
    """Four corners (y, z), counter-clockwise; `arcs[i]` says that edge i -> i + 1 is an arc about the origin."""

    corners: tuple[Point, Point, Point, Point]
    arcs: tuple[bool, bool, bool, bool] = (False, False, False, False)


@runtime_checkable
class Section(Protocol):
    """What a bar needs to know of its cross-section."""

    @property
    def size(self) -> Point:
        """Extent along y and along z, mm."""
        ...

    @property
    def area(self) -> float:
        """Area, mm²."""
        ...

    @property
    def second_moments(self) -> Point:
        """Iy = ∫z² dA and Iz = ∫y² dA, mm⁴."""
        ...

    def patches(self) -> tuple[Patch, ...]:
        """The section cut into four-sided patches."""
        ...


def require_positive(owner: object) -> None:
    """Raise ValueError unless every float field of the dataclass `owner` is finite and above zero."""
    for field in fields(owner):  # type: ignore[arg-type]
        value = getattr(owner, field.name)
        if isinstance(value, int | float) and not (isfinite(value) and value > 0.0):
            raise ValueError(f"{field.name} is {value:g}, allowed is a length above 0 mm")


def rectangle(y0: float, y1: float, z0: float, z1: float) -> Patch:
    """The patch y0..y1 by z0..z1."""
    return Patch(((y0, z0), (y1, z0), (y1, z1), (y0, z1)))


@dataclass(frozen=True)
class Rectangle:
    """Solid rectangle: `width` along y, `height` along z, mm."""

    width: float
    height: float

    def __post_init__(self) -> None:
        require_positive(self)

    @property
    def size(self) -> Point:
        return self.width, self.height

    @property
    def area(self) -> float:
        return self.width * self.height

    @property
    def second_moments(self) -> Point:
        return self.width * self.height**3 / 12, self.height * self.width**3 / 12

    def patches(self) -> tuple[Patch, ...]:
        y, z = self.width / 2, self.height / 2
        return (rectangle(-y, y, -z, z),)


@dataclass(frozen=True)
class ISection:
    """I-section: flanges `flange_width` (y) by `flange_thickness` (z), `height` over all, `web` thick (y), mm."""

    flange_width: float
    flange_thickness: float
    height: float
    web: float

    def __post_init__(self) -> None:
        require_positive(self)
        if self.web >= self.flange_width:
            raise ValueError(
                f"web is {self.web:g} mm, allowed is less than flange_width = {self.flange_width:g} mm"
            )
        if 2 * self.flange_thickness >= self.height:
            raise ValueError(
                f"flange_thickness is {self.flange_thickness:g} mm, allowed is less than half of "
                f"height = {self.height:g} mm"
            )

    @property
    def size(self) -> Point:
        return self.flange_width, self.height

    @property
    def web_height(self) -> float:
        """Clear height between the flanges, mm."""
        return self.height - 2 * self.flange_thickness

    @property
    def area(self) -> float:
        return 2 * self.flange_width * self.flange_thickness + self.web * self.web_height

    @property
    def second_moments(self) -> Point:
        b, t, w, inner = self.flange_width, self.flange_thickness, self.web, self.web_height
        iy = (b * self.height**3 - (b - w) * inner**3) / 12
        iz = (2 * t * b**3 + inner * w**3) / 12
        return iy, iz

    def patches(self) -> tuple[Patch, ...]:
        y, w = self.flange_width / 2, self.web / 2
        z, i = self.height / 2, self.web_height / 2
        flanges = [
            rectangle(a, b, s, e) for s, e in ((-z, -i), (i, z)) for a, b in ((-y, -w), (-w, w), (w, y))
        ]
        return (*flanges, rectangle(-w, w, -i, i))


def ring_point(radius: float, quarter: int) -> Point:
    """Point at 45 degrees plus `quarter` right angles on the circle."""
    angle = pi / 4 + quarter * pi / 2
    return radius * cos(angle), radius * sin(angle)


def ring_patches(inner: float, outer: float, inner_is_arc: bool) -> tuple[Patch, ...]:
    """Four patches between two circles, or between a square with that circumscribed circle and a circle."""
    arcs = (False, True, False, inner_is_arc)
    return tuple(
        Patch(
            (ring_point(inner, k), ring_point(outer, k), ring_point(outer, k + 1), ring_point(inner, k + 1)),
            arcs,
        )
        for k in range(4)
    )


@dataclass(frozen=True)
class Round:
    """Solid round of `diameter`, mm."""

    diameter: float

    def __post_init__(self) -> None:
        require_positive(self)

    @property
    def size(self) -> Point:
        return self.diameter, self.diameter

    @property
    def area(self) -> float:
        return pi * self.diameter**2 / 4

    @property
    def second_moments(self) -> Point:
        moment = pi * self.diameter**4 / 64
        return moment, moment

    def patches(self) -> tuple[Patch, ...]:
        core = 0.55 * self.diameter / 2
        ((c0, c1, c2, c3)) = tuple(ring_point(core, k) for k in range(4))
        return (Patch((c0, c1, c2, c3)), *ring_patches(core, self.diameter / 2, inner_is_arc=False))


@dataclass(frozen=True)
class Tube:
    """Round tube of `outer_diameter` and `wall` thickness, mm."""

    outer_diameter: float
    wall: float

    def __post_init__(self) -> None:
        require_positive(self)
        if 2 * self.wall >= self.outer_diameter:
            raise ValueError(
                f"wall is {self.wall:g} mm, allowed is less than half of outer_diameter = {self.outer_diameter:g} mm"
            )

    @property
    def bore(self) -> float:
        """Inner diameter, mm."""
        return self.outer_diameter - 2 * self.wall

    @property
    def size(self) -> Point:
        return self.outer_diameter, self.outer_diameter

    @property
    def area(self) -> float:
        return pi * (self.outer_diameter**2 - self.bore**2) / 4

    @property
    def second_moments(self) -> Point:
        moment = pi * (self.outer_diameter**4 - self.bore**4) / 64
        return moment, moment

    def patches(self) -> tuple[Patch, ...]:
        return ring_patches(self.bore / 2, self.outer_diameter / 2, inner_is_arc=True)
