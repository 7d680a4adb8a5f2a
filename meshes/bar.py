"""A bar as geometry: a section swept along x from the face "base" (x = 0) to the face "tip" (x = length)."""

from dataclasses import dataclass
from itertools import pairwise
from math import hypot, isfinite

from meshes.section import Patch, Point, Rectangle, Section, Tube, rectangle, require_positive


@dataclass(frozen=True)
class Lug:
    """Hinge lug: a block `length` (x) by `width` (y) by `height` (z), mm, in place of the section at each end."""

    length: float
    width: float
    height: float

    def __post_init__(self) -> None:
        require_positive(self)


@dataclass(frozen=True)
class Zone:
    """A stretch of the bar with one cross-section; `graded_to` names the end with the smaller elements."""

    start: float
    end: float
    patches: tuple[Patch, ...]
    graded_to: str | None = None


@dataclass(frozen=True)
class Bar:
    """A straight bar between two end faces `length` mm apart; `lug` None means the section runs to both faces."""

    section: Section
    length: float
    lug: Lug | None = None

    def __post_init__(self) -> None:
        if not (isfinite(self.length) and self.length > 0.0):
            raise ValueError(f"length is {self.length:g}, allowed is a length above 0 mm")
        if self.lug is not None and 2 * self.lug.length >= self.length:
            raise ValueError(
                f"lug length is {self.lug.length:g} mm, allowed is less than half of length = {self.length:g} mm"
            )

        if self.lug is not None and isinstance(self.section, Tube):
            reach = hypot(self.lug.width, self.lug.height)
            if reach <= self.section.bore:
                raise ValueError(
                    f"lug of {self.lug.width:g} by {self.lug.height:g} mm fits into the bore, allowed is a diagonal "
                    f"above {self.section.bore:g} mm"
                )

    @property
    def sweepable(self) -> bool:
        """Whether hexahedra can be swept: always without lugs; with lugs when the section is made of rectangles."""
        return self.lug is None or all(not any(p.arcs) and is_rectangle(p) for p in self.section.patches())

    def zones(self) -> tuple[Zone, ...]:
        """Stretches along x, with the body cut at mid-length; ValueError if the bar is not sweepable."""
        middle = self.length / 2
        if self.lug is None:
            body = self.section.patches()
            return (Zone(0.0, middle, body, "start"), Zone(middle, self.length, body, "end"))
        if not self.sweepable:
            raise ValueError(
                "a block lug on a curved section cannot be swept, allowed is a section of rectangles"
            )
        body, ends = split_on_common_grid(self.section.patches(), self.lug)
        a = self.lug.length
        return (
            Zone(0.0, a, ends),
            Zone(a, middle, body, "start"),
            Zone(middle, self.length - a, body, "end"),
            Zone(self.length - a, self.length, ends),
        )

    def exact_moments(self) -> tuple[float, float, float]:
        """Volume in mm³, ∫z² dV and ∫y² dV in mm⁵ of the body with its lugs."""
        outer = 0.0 if self.lug is None else 2 * self.lug.length
        block = self.section if self.lug is None else Rectangle(self.lug.width, self.lug.height)
        body = (self.section.area, *self.section.second_moments)
        ends = (block.area, *block.second_moments)
        volume, iy, iz = (b * (self.length - outer) + e * outer for b, e in zip(body, ends, strict=True))
        return volume, iy, iz


def is_rectangle(patch: Patch) -> bool:
    """Whether the patch is an axis-parallel rectangle."""
    return len({y for y, _ in patch.corners}) == 2 and len({z for _, z in patch.corners}) == 2


def extent(patch: Patch) -> tuple[Point, Point]:
    """Smallest and largest (y, z) of a patch of straight edges."""
    ys, zs = zip(*patch.corners, strict=True)
    return (min(ys), min(zs)), (max(ys), max(zs))


def contains(patch: Patch, y: float, z: float) -> bool:
    """Whether a point lies inside a rectangular patch."""
    (y0, z0), (y1, z1) = extent(patch)
    return y0 < y < y1 and z0 < z < z1


def split_on_common_grid(section: tuple[Patch, ...], lug: Lug) -> tuple[tuple[Patch, ...], tuple[Patch, ...]]:
    """Body patches and end patches cut along one grid, so that swept elements of both meet face to face."""
    block = rectangle(-lug.width / 2, lug.width / 2, -lug.height / 2, lug.height / 2)
    everything = (*section, block)
    ys = grid_lines([y for p in everything for y, _ in p.corners])
    zs = grid_lines([z for p in everything for _, z in p.corners])
    body, ends = [], []
    for z0, z1 in pairwise(zs):
        for y0, y1 in pairwise(ys):
            y, z = (y0 + y1) / 2, (z0 + z1) / 2
            if any(contains(p, y, z) for p in section):
                body.append(rectangle(y0, y1, z0, z1))
            if contains(block, y, z):
                ends.append(rectangle(y0, y1, z0, z1))
    return tuple(body), tuple(ends)


def grid_lines(values: list[float]) -> list[float]:
    """Sorted values, those closer than a nanometre taken as one."""
    lines: list[float] = []
    for value in sorted(values):
        if not lines or value - lines[-1] > 1e-6:
            lines.append(value)
    return lines
