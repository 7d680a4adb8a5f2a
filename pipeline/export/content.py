"""What is exported: springs of six directions, the linkage that they are part of, and where all of it is from.

Units N, mm, rad inside; a format that writes others says so.
"""

from __future__ import annotations

import textwrap
from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import numpy as np

from vjm.frames import Array, adjoint

WIDTH = 78
"""Columns of a comment."""
NOT_GEOMETRIC = (
    "Not in the file: geometric stiffness. The numbers hold at no load; what an axial force adds or takes, and "
    "buckling, they do not know."
)


@dataclass(frozen=True, eq=False)
class Spring:
    """A linear spring of six directions between the ground at `base` and a body at `point`.

    name: short, of letters and digits. what, frame: in words. matrix: (6, 6), from x y z rx ry rz of the point to the
    wrench on it there, in the frame. base, point: (3,) mm, in the frame. length: mm, between the two or of the bar, by
    which rotations are made comparable with displacements. rank: of the matrix. q_deg: of a linkage.
    """

    name: str
    what: str
    frame: str
    matrix: Array
    base: Array
    point: Array
    length: float
    rank: int
    q_deg: float | None = None

    @property
    def relative(self) -> Array:
        """(6, 12) from the motions of two bodies, at the base and at the point, to the deformation at the point."""
        return np.hstack([-adjoint(self.base - self.point), np.eye(6)])

    @property
    def between(self) -> Array:
        """(12, 12) of the same spring between two bodies that both move: base first, then point."""
        found = self.relative.T @ self.matrix @ self.relative
        return np.asarray(0.5 * (found + found.T))

    @property
    def terms(self) -> tuple[tuple[float, Array], ...]:
        """Springs of one direction that add up to the matrix: stiffness s, N/mm, and (6,) v, so that K = sum s v vᵀ.

        v gives an elongation in mm from mm and rad. They are the eigenvectors of the matrix with rotations counted as
        arcs on the radius `length`; a direction that costs no energy has none.
        """
        arc = np.repeat([1.0, self.length], 3)
        values, vectors = np.linalg.eigh(self.matrix / np.outer(arc, arc))
        vectors[np.abs(vectors) < np.finfo(float).eps] = 0.0
        found = [(float(s), arc * v) for s, v in zip(values, vectors.T, strict=True)]
        return tuple(found[::-1][: self.rank])


@dataclass(frozen=True, eq=False)
class Linkage:
    """The parallelogram at one angle: bars of these 6x6 (bar frame, at the tip) between four hinges about y.

    q_deg: as it is named. width: mm, between the base hinges, which stand at z = -width/2 and +width/2. tips: (2, 3)
    mm, tip hinges of bar 1 and bar 2 in the unloaded linkage, base frame. whole: its 6x6, base frame.
    """

    q_deg: float
    width: float
    tips: Array
    bars: tuple[Spring, Spring]
    whole: Spring

    @property
    def bases(self) -> Array:
        """(2, 3) mm, base hinges, base frame."""
        return np.array([[0.0, 0.0, -0.5 * self.width], [0.0, 0.0, 0.5 * self.width]])

    @property
    def point(self) -> Array:
        """(3,) mm, the platform point, midway between the tip hinges."""
        return np.asarray(0.5 * (self.tips[0] + self.tips[1]))

    @property
    def angles(self) -> tuple[float, float]:
        """rad, of both bars about y in the unloaded linkage; equal where the bars are."""
        ahead = self.tips - self.bases
        first, second = np.arctan2(-ahead[:, 2], ahead[:, 0])
        return float(first), float(second)


@dataclass(frozen=True, eq=False)
class Export:
    """What a format writes.

    source: path as it was given. digests: SHA-256 of its files by name. bars: K_b, one spring where both bars are
    equal, else two. linkages: K_p at every angle. chosen: whether one angle was asked for. effects: of the model, with
    the values of their parameters. in_bars, in_whole: names of effects that change the bars' 6x6, and the linkage's.
    """

    source: str
    digests: Mapping[str, str]
    bars: tuple[Spring, ...]
    linkages: tuple[Linkage, ...]
    chosen: bool
    effects: Mapping[str, Mapping[str, float]]
    in_bars: frozenset[str]
    in_whole: frozenset[str]
    versions: Mapping[str, str]
    commit: str

    @property
    def linkage(self) -> Linkage | None:
        """The one that was asked for by its angle."""
        return self.linkages[0] if self.chosen else None

    @property
    def springs(self) -> tuple[Spring, ...]:
        """What a format of single springs holds: the linkage that was asked for, else the bars."""
        return self.bars if self.linkage is None else (self.linkage.whole,)

    def unheld(self, names: frozenset[str]) -> tuple[str, ...]:
        """Sentences on effects of the model: those that are in numbers at no load, `names`, and those that are not."""
        inside = [name for name in self.effects if name in names]
        outside = [name for name in self.effects if name not in names]
        said = []
        if inside:
            said.append(
                f"Effects of the model that are in the numbers, as they act at no load: {', '.join(inside)}."
            )
        if outside:
            said.append(f"Effects of the model that are not in the file: {', '.join(outside)}.")
        return tuple(said)


def lost_by_all(it: Export, springs: Iterable[Spring], names: frozenset[str]) -> tuple[str, ...]:
    """What no file of stiffness holds: sentences on no load, on free directions, on effects other than `names`."""
    said = [NOT_GEOMETRIC]
    free = {spring.name: spring.rank for spring in springs if spring.rank < 6}
    for name, rank in free.items():
        said.append(
            f"{name} has rank {rank}: the linkage swings on its hinges without energy; hold that direction, or a "
            "static solver finds a mechanism."
        )
    return (*said, *it.unheld(names))


def lost_by_springs(it: Export) -> tuple[str, ...]:
    """The same of a file that holds the springs alone."""
    return lost_by_all(it, it.springs, it.in_bars if it.linkage is None else it.in_whole)


def lost_by_mechanism(it: Export) -> tuple[str, ...]:
    """The same of a file in which the linkage is made of its bars and of ideal hinges."""
    return lost_by_all(it, it.springs, it.in_bars)


def head(it: Export, units: str, lost: tuple[str, ...]) -> tuple[str, ...]:
    """Lines at the head of a text file: where it is from, its units, what it cannot hold."""
    files = [f"  {name} sha256 {digest}" for name, digest in it.digests.items()]
    return (
        f"parastiff export of {' '.join(it.source.split())}",
        *files,
        f"parastiff {it.versions['parastiff']}, commit {it.commit}",
        units,
        *lost,
    )


def commented(mark: str, lines: Iterable[str]) -> list[str]:
    """Lines behind the mark of a comment, none longer than a terminal is wide unless one word is."""
    out = []
    for line in lines:
        out += textwrap.wrap(
            line, WIDTH, initial_indent=mark, subsequent_indent=f"{mark}  ", break_long_words=False
        )
    return out


UNITS = "Units: N, mm, rad; 6x6 from x y z rx ry rz to Fx Fy Fz Mx My Mz on the body at the point."
