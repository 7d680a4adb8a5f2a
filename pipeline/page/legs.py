"""The legs of a manipulator as lines that a view draws, at one posture and as far as they follow the platform."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from pipeline.page.record import Line
from vjm.manipulator.parts import Parallelogram
from vjm.parts import Actuator, Elastic, Frame, Kind, Leg, Part, Passive, Virtual, posture_of

Array = NDArray[np.float64]
Ends = tuple[Array, Array]
Y = (0.0, 1.0, 0.0)


@dataclass(frozen=True, eq=False)
class _Piece:
    """Lines from where a part begins to where it ends, and across it at both places; free: behind a passive joint."""

    along: tuple[Ends, ...]
    across: tuple[Ends, ...]
    free: bool

    @property
    def length(self) -> float:
        return float(np.linalg.norm(np.subtract(*self.along[0]))) if self.free else 0.0


def lines_of(legs: Iterable[tuple[Leg, Array]]) -> tuple[Line, ...]:
    """Lines of legs with their joint coordinates, unloaded, base frame.

    Up to its first passive joint a leg stays; from there on every point follows the platform by its share of the way.
    """
    return tuple(line for leg, x in legs for line in _lines(list(_pieces(leg, x))))


def _lines(pieces: list[_Piece]) -> Iterator[Line]:
    total = sum(piece.length for piece in pieces)
    gone = 0.0
    for piece in pieces:
        begin = gone / total if total else 0.0
        gone += piece.length
        end = gone / total if total else 0.0
        for a, b in piece.along:
            yield _line(a, b, begin, end)
        for (a, b), share in zip(piece.across, (begin, end), strict=False):
            yield _line(a, b, share, share)


def _line(a: Array, b: Array, begin: float, end: float) -> Line:
    points = tuple(tuple(round(float(v), 4) for v in point) for point in (a, b))
    return Line(points=points, share=(round(begin, 6), round(end, 6)))


def _pieces(leg: Leg, coordinates: Array) -> Iterator[_Piece]:
    """What can be seen of a leg; the first frame only says where it stands."""
    place, triad, free = np.zeros(3), np.eye(3), False
    left = iter(float(x) for x in coordinates)
    for number, part in enumerate(leg.parts):
        values = [next(left) for _ in posture_of(part)]
        free = free or isinstance(part, Passive | Parallelogram)
        shift, turn = _motion(part, values)
        end = place + triad @ shift
        if np.any(shift) and not (number == 0 and isinstance(part, Frame)):
            yield _piece(part, place, end, triad, free)
        place, triad = end, triad @ turn


def _piece(part: Part, place: Array, end: Array, triad: Array, free: bool) -> _Piece:
    if not isinstance(part, Parallelogram):
        return _Piece(((place, end),), (), free)
    arm = 0.5 * part.width * triad[:, 2]
    bars = tuple((place + side * arm, end + side * arm) for side in (-1.0, 1.0))
    return _Piece(bars, tuple((at - arm, at + arm) for at in (place, end)), free)


def _motion(part: Part, values: list[float]) -> tuple[Array, Array]:
    """(3,) shift to the end of a part and the (3, 3) turn there, both in the frame where it begins."""
    still, straight = np.zeros(3), np.eye(3)
    match part:
        case Frame():
            return part.translation, part.rotation
        case Actuator():
            return _moved(part.kind, part.axis, values[0])
        case Passive():
            shift, turn = still, straight
            for axis, value in zip(part.axes, values, strict=True):
                ahead, turned = _moved(axis.kind, axis.direction, value)
                shift, turn = shift + turn @ ahead, turn @ turned
            return shift, turn
        case Elastic():
            return np.array([part.link.length, 0.0, 0.0]), straight
        case Parallelogram():
            # Its end keeps its orientation.
            return Rotation.from_rotvec(values[0] * np.array(Y)).apply([part.length, 0.0, 0.0]), straight
        case Virtual():
            return still, straight
    raise ValueError(f"a {type(part).__name__.lower()} has no drawing here")


def _moved(kind: Kind, axis: tuple[float, float, float], value: float) -> tuple[Array, Array]:
    """Shift and turn of a joint by a value, mm or rad."""
    way = value * np.array(axis)
    if kind == "translation":
        return way, np.eye(3)
    return np.zeros(3), Rotation.from_rotvec(way).as_matrix()
