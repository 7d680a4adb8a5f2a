"""A displacement gauge of a campaign."""

from dataclasses import dataclass

Vector = tuple[float, float, float]


@dataclass(frozen=True)
class Gauge:
    """A displacement gauge on bar 1 or 2 at `station` (0 base, 1 tip), along a base-frame axis such as "y" or "-y".

    offset: of a gauge on the platform, its point from that of the platform in the nominal pose, mm, base frame; bar and
    station then mean nothing.
    """

    name: str
    station: float
    direction: str
    bar: int = 1
    offset: Vector | None = None

    @property
    def vector(self) -> Vector:
        """Unit vector of the direction, base frame."""
        sign, axis = (-1.0 if self.direction.startswith("-") else 1.0), self.direction[-1]
        return (sign * (axis == "x"), sign * (axis == "y"), sign * (axis == "z"))
