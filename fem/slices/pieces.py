"""Displacements inside a chain of slices in one symmetry class: loads go up the doublings, displacements come down.

A piece is 2^j equal layers, joined to the pieces before it plane by plane. Arrays of loads and displacements are
(k, planes, r): k unknowns of a plane, r right-hand sides.
"""

from dataclasses import dataclass

import numpy as np

from fem.slices.condensed import Factors, Prism, Slice, Stretch, doubled, joined_to_base, solved
from meshes.solid import Floats


@dataclass(frozen=True, eq=False)
class Piece:
    """`count` equal layers from layer number `start` on: their slice, the doublings up to them, and their ends.

    doublings : for j = 0, 1, ..: 2^j layers, and the factors of the plane between two of them
    """

    start: int
    count: int
    slice: Slice
    doublings: tuple[tuple[Prism, Factors], ...]
    ends: Stretch

    def raised(self, loads: Floats) -> Floats:
        """Loads (k, count + 1, r) condensed to the two end planes; between them stands what the way down needs."""
        for level, (half, factors) in enumerate(self.doublings):
            between, before, behind = planes_of(level)
            y = plane_solved(half, factors, loads[:, between])
            loads[:, before] -= half.reversed(times(half.turned, y))
            loads[:, behind] -= times(half.turned, half.reversed(y))
            loads[:, between] = y
        return loads

    def lowered(self, planes: Floats) -> Floats:
        """Displacements (k, count + 1, r) from those of the end planes and what `raised` left between."""
        for level, (half, factors) in reversed(list(enumerate(self.doublings))):
            between, before, behind = planes_of(level)
            pull = times(half.turned, half.reversed(planes[:, before]))
            pull += half.reversed(times(half.turned, planes[:, behind]))
            planes[:, between] -= plane_solved(half, factors, pull)
        return planes


def planes_of(level: int) -> tuple[slice, slice, slice]:
    """Planes in the middle of 2^(level + 1) layers, before and behind them."""
    step = 2**level
    return slice(step, None, 2 * step), slice(0, -1, 2 * step), slice(2 * step, None, 2 * step)


def times(matrix: Floats, columns: Floats) -> Floats:
    """matrix (k, k) times (k, planes, r)."""
    return np.asarray(matrix @ columns.reshape(len(columns), -1)).reshape(-1, *columns.shape[1:])


def plane_solved(half: Prism, factors: Factors, columns: Floats) -> Floats:
    """The plane between two prisms solved for (k, planes, r); along x and across it are apart."""
    flat = columns.reshape(len(columns), -1)
    parts = (solved(factors[0], flat[: half.along]), solved(factors[1], flat[half.along :]))
    return np.concatenate(parts).reshape(columns.shape)


def pieces_of_run(unit: Slice, start: int, count: int, rigid: Floats) -> list[Piece]:
    """Pieces of the binary digits of `count`, shortest first; of slices that are no prism one for each layer.

    rigid: (k, 6) as for `condensed.without_rigid`.
    """
    if not isinstance(unit.ends, Prism):
        return [Piece(start + i, 1, unit, (), unit.ends) for i in range(count)]
    found: list[Piece] = []
    doublings: list[tuple[Prism, Factors]] = []
    prism, size = unit.ends, 1
    while True:
        if count & size:
            found.append(Piece(start, size, unit, tuple(doublings), prism))
            start, count = start + size, count - size
        if not count:
            return found
        twice, factors = doubled(prism, rigid)
        doublings.append((prism, factors))
        prism, size = twice, 2 * size


@dataclass(frozen=True, eq=False)
class CondensedLoads:
    """Loads of a piece condensed to its end planes, `before` (k, r) and `behind`, and what the way down needs.

    inside  : (k, count + 1, r) from `Piece.raised`; empty for a single layer
    middles : (m, count, r) displacements of the middles with the planes at rest
    """

    before: Floats
    behind: Floats
    inside: Floats
    middles: Floats

    @staticmethod
    def of(piece: Piece, planes: list[Floats], middles: list[Floats]) -> "CondensedLoads":
        """For loads (k, r) of all planes and (m, r) of all middles of the sweep."""
        start, end = piece.start, piece.start + piece.count
        own = solved_columns(piece.slice.middle, np.stack(middles[start:end], axis=1))
        before, behind = -times(piece.slice.to_first.T, own), -times(piece.slice.to_last.T, own)
        if piece.count == 1:
            return CondensedLoads(before[:, 0], behind[:, 0], np.zeros((0, 0, 0)), own)
        inside = np.zeros((len(before), piece.count + 1, before.shape[2]))
        inside[:, 1:-1] = np.stack(planes[start + 1 : end], axis=1)
        inside[:, :-1] += before
        inside[:, 1:] += behind
        piece.raised(inside)
        return CondensedLoads(inside[:, 0].copy(), inside[:, -1].copy(), inside, own)

    def displacements(
        self, piece: Piece, before: Floats, behind: Floats
    ) -> tuple[list[Floats], list[Floats]]:
        """Of the piece's planes but the first one, and of its middles, for those of its end planes (k, r)."""
        planes = [before, behind]
        if piece.count > 1:
            self.inside[:, 0], self.inside[:, -1] = before, behind
            planes = list(np.moveaxis(piece.lowered(self.inside), 1, 0))
        pull = times(piece.slice.to_first, np.stack(planes[:-1], axis=1))
        pull += times(piece.slice.to_last, np.stack(planes[1:], axis=1))
        middles = self.middles - solved_columns(piece.slice.middle, pull)
        return planes[1:], list(np.moveaxis(middles, 1, 0))


def solved_columns(lower: Floats, columns: Floats) -> Floats:
    """(L Lᵀ)⁻¹ times (m, planes, r)."""
    return solved(lower, columns.reshape(len(columns), -1)).reshape(columns.shape)


@dataclass(frozen=True, eq=False)
class ClassChain:
    """All pieces of a sweep in one class, base first, and the Cholesky factors of the planes between them."""

    pieces: tuple[Piece, ...]
    joints: tuple[Floats, ...]

    @staticmethod
    def of(pieces: list[Piece]) -> "ClassChain":
        """The pieces joined from the base on; SolveError if one is not held."""
        held: Floats | None = None
        joints = []
        for piece in pieces:
            held, lower = joined_to_base(held, piece.ends)
            if lower is not None:
                joints.append(lower)
        return ClassChain(tuple(pieces), tuple(joints))

    def solve(
        self, planes: list[Floats], middles: list[Floats], tip: Floats
    ) -> tuple[list[Floats], list[Floats]]:
        """Displacements of all planes and middles, the base plane at rest and the last one at `tip` (k, r).

        planes, middles : loads (k, r) of the n + 1 planes, those of the two end planes without effect, and (m, r) of
                          the n middles
        """
        work = [CondensedLoads.of(piece, planes, middles) for piece in self.pieces]
        alone: list[Floats] = []
        for i, lower in enumerate(self.joints):
            load = planes[self.pieces[i + 1].start] + work[i].behind + work[i + 1].before
            if i:
                load -= self.pieces[i].ends.coupling.T @ alone[-1]
            alone.append(solved(lower, load))
        ends = [tip]
        for i in reversed(range(len(self.joints))):
            ends.append(alone[i] - solved(self.joints[i], self.pieces[i + 1].ends.coupling @ ends[-1]))
        ends.append(np.zeros_like(planes[0]))
        ends.reverse()
        moved_planes, moved_middles = [ends[0]], []
        for i, piece in enumerate(self.pieces):
            more_planes, more_middles = work[i].displacements(piece, ends[i], ends[i + 1])
            moved_planes += more_planes
            moved_middles += more_middles
        return moved_planes, moved_middles
