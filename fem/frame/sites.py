"""Names of the sites where a law may be placed: a kind of coordinate, and which of those alike.

    hinge_torque            about the hinge axis, from where the hinge stands in the unloaded linkage, all hinges
    along@base.1            along the x axis of bar 1 at its base end
    tilt_z@tip              about the z axis of each bar at its tip end
    base_rx                 the base body about x of the base frame, at the base origin

A coordinate between two parts is the motion of the one further from the base, seen from the nearer one: `along` is
positive where it makes the linkage longer, at either end.
"""

from dataclasses import dataclass

from fem.frame.chain import SERIES

HINGE = "hinge_torque"
BASE = ("base_x", "base_y", "base_z", "base_rx", "base_ry", "base_rz")
"""The base body, along and about the axes of the base frame."""
ENDS, BARS = ("base", "tip"), ("1", "2")
KINDS = (HINGE, *SERIES, *BASE)


@dataclass(frozen=True)
class Site:
    """kind: one of `KINDS`. end: 0 base, 1 tip; bar from 0; None: all alike."""

    kind: str
    end: int | None = None
    bar: int | None = None

    def here(self, bar: int, end: int) -> bool:
        """Whether that end of that bar belongs to it."""
        return self.bar in (None, bar) and self.end in (None, end)


def site_of(name: str) -> Site:
    """The site of a name: a kind, then after an @ `base` or `tip`, `1` or `2`, joined by dots. ValueError else."""
    kind, at, rest = name.partition("@")
    if kind not in KINDS:
        raise ValueError(f"there is no site {kind!r}, allowed are {', '.join(KINDS)}")
    if kind in BASE and at:
        raise ValueError(f"{name}: there is one base body, allowed is {kind}")
    end = bar = None
    for tag in rest.split(".") if at else ():
        if tag in ENDS and end is None:
            end = ENDS.index(tag)
        elif tag in BARS and bar is None:
            bar = BARS.index(tag)
        else:
            raise ValueError(
                f"{name}: {tag!r} is no part of a site, allowed are one of base, tip and one of 1, 2"
            )
    return Site(kind, end, bar)
