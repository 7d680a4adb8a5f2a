"""Places of a rig of bars where a law may sit, beyond what is drawn: at hinges, at the ends of bars, under the base.

In parallel with a joint that moves a law is a force or a moment over the joint's own coordinate, from where it stands
without load. In series, where something is drawn rigid, it is a shift or a turn over the force or moment through it.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Literal


@dataclass(frozen=True)
class SiteKind:
    """A kind of place. axis: 0 to 2 along, 3 to 5 about x, y, z of the frame of the bar, or of the base.

    parts: whether each hinge or end of a bar has one, or the base body as a whole.
    series: whether the law gives a displacement over the load through it.
    """

    name: str
    title: str
    parts: Literal["hinges", "base"]
    axis: int
    series: bool

    @property
    def turns(self) -> bool:
        """Whether its displacement is a turn, rad, and its load a moment, N·mm; else mm and N."""
        return self.axis >= 3

    @property
    def units(self) -> tuple[str, str]:
        """Of its displacement and of its load."""
        return ("rad", "N·mm") if self.turns else ("mm", "N")

    @property
    def over(self) -> str:
        """Unit of what its law is a function of."""
        return self.units[1 if self.series else 0]

    @property
    def gives(self) -> str:
        """Unit of what its law says."""
        return self.units[0 if self.series else 1]


def _kinds() -> Mapping[str, SiteKind]:
    ends = (
        ("along", "give along the bars, at their ends or in them", 0),
        ("across", "give across the bars, in the plane of the linkage, at their ends", 2),
        ("out_of_plane", "give along the hinge axes, at the ends of the bars", 1),
        ("tilt_x", "turn about the bars' own axes, at their ends", 3),
        ("tilt_z", "tilt of the hinge axes about z of the bars, at their ends", 5),
    )
    axes = enumerate(("x", "y", "z", "rx", "ry", "rz"))
    every = [SiteKind("hinge_torque", "torque about the hinge axes", "hinges", 4, series=False)]
    every += [SiteKind(name, title, "hinges", axis, series=True) for name, title, axis in ends]
    every += [
        SiteKind(
            f"base_{a}",
            f"give of the base {'along' if k < 3 else 'about'} {a[-1]}",
            "base",
            k,
            series=True,
        )
        for k, a in axes
    ]
    return MappingProxyType({each.name: each for each in every})


SITE_KINDS = _kinds()
"""By name."""
