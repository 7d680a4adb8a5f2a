"""A bar refined into segments, each with frames of its own: geometric stiffness, shortening, large deflection.

A segment turns half of its rotation phi at its base and half at its tip; between them, in the half-turned
frame, it extends and shifts by s. That frame is objective and symmetric. Axially a segment is a beam column
under the tension P,
    s_x + theta^T G theta / 2 = P (c + theta^T G' theta / 2),   theta = (s, phi), c its axial compliance:
G the length of a bent axis over its chord, G' what a bent bar gives by changing its shape. Both come from the
exact stability functions of Euler's column in powers of x² = P l² / (4 EI):
    moment of phi:  x coth x = 1 + x²/3 - x⁴/45 + ...,   so G = l/12,    G' = l³ / (360 EI),
    force of s:     x³ / (3 (x - tanh x)) = 1 + 2 x²/5 - x⁴/525 + ...,   so G = 6/(5 l), G' = l / (350 EI).
A shear angle leans on the section, as in Reissner's rod: with the shear number Phi (shear over bending
compliance of the shift) G of s is (6/5 + 2 Phi) / (1 + Phi)² / l. Bending follows the
angle s / (l + s_x) of the chord, which takes 2 c / (l c_s) from G of s, c_s being the bending compliance of s.
Twist turns the principal axes along the segment. Kirchhoff's rod, its curvatures expanded to second order in
rotations that are linear (phi) and parabolic (s) in arc length, adds the cubic energy
    phi_x ((GJ - EI_y - EI_z/2) phi_y s_y + (GJ - EI_z - EI_y/2) phi_z s_z) / l²;
half turns made axis by axis move the half-turned frame by l phi_x phi_y / 8 in y and l phi_x phi_z / 8 in z
against that of the rotation vector, which adds 3/2 EI_z and 3/2 EI_y to the two brackets.

The identified 6x6 is shared out as compliance. In each plane of bending it fixes three numbers of the
flexibility along the bar: its amount, its centre and its spread. They are those of a uniform flexible length
between rigid ends: as long as the bar if the spread is that of a uniform bar or more, the rest being shear;
shorter by the factor a if it is less. Each segment takes one n-th of it. Its shift s is counted at the centre
of its part, which lies `offset` before the middle of the segment, and its rigid ends add (1 - a) l / 4 to G of
phi. The segments in series are the bar, to rounding.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from vjm.bars import Limb, X, Y, Z, check_station
from vjm.chain import Element, Fixed, Joint, Mark, Role
from vjm.fibres import Fibres
from vjm.frames import Array, exp
from vjm.laws import BeamColumn, Law, Spring
from vjm.link import ByValue, Link
from vjm.section import Section
from vjm.yielding import Yielding, strain_rates

SEGMENTS = 6
"""Default refinement; see `Refined` for what it is good for."""

SAME = 1e-12
"""Of its numbers, by which the series of the segments of a bar without other couplings is off by rounding."""
_PLANES = ((1, 5, 1.0), (2, 4, -1.0))
# Within a chain a segment's coordinates are numbered as its joints come: rotations first.
_ORDER = np.array([3, 4, 5, 0, 1, 2])
_PLAIN: NDArray[np.int64] = np.arange(6)


@dataclass(frozen=True)
class Refined:
    """Bar of n segments.

    segments: n. polar_radius: radius of gyration of the section about the bar's axis, mm; a twist phi_x of
    a segment lengthens its fibres by polar_radius² phi_x² / (2 l) (Wagner), 0 leaves that out.
    A deep strip under a load across its free end buckles sideways 2.1 % late with six segments, an error that falls
    with the square of their number: twist is uniform in a segment, that of a strip under a moment is not.
    ValueError for fewer than one segment.
    """

    segments: int = SEGMENTS
    polar_radius: float = 0.0

    def __post_init__(self) -> None:
        if self.segments < 1:
            raise ValueError(f"a bar has one segment or more, got {self.segments}")

    def limb(self, link: Link) -> Limb:
        return _limb(self, link.by_value)

    def reach(self, link: Link, station: float) -> tuple[Element, ...]:
        check_station(station)
        parts = self.shares(link)
        last = min(int(station * self.segments), self.segments - 1)
        before = [e for k in range(last) for e in _segment(k, parts)]
        bent = _bent(last, parts, station * self.segments - last)
        return (*_bowed_ends(link)[0], *before, *bent)

    def shares(self, link: Link) -> Shares:
        """What each segment gets, with the ends of the bar as they give."""
        parts = share_out(link.length, link.stiffness, self.segments, link.like)
        parts.curvature[:, 3] = self.polar_radius**2 * self.segments / link.length
        _give_way(parts, link)
        return parts


@lru_cache(maxsize=128)
def _limb(model: Refined, key: ByValue) -> Limb:
    link = key.link
    n, parts = model.segments, model.shares(link)
    start, end = _bowed_ends(link)
    pieces = [_segment(k, parts) for k in range(n)]
    elements = [*start, *(e for piece in pieces for e in piece), *end]
    full = np.zeros((6 * n, 6 * n))
    for k, matrix in enumerate(parts.stiffness):
        full[6 * k : 6 * k + 6, 6 * k : 6 * k + 6] = matrix[_ORDER[:, None], _ORDER]
    numbers = (6 * np.arange(n)[:, None] + _ORDER).ravel()
    shape = bowed_shape(link, parts)
    law = BeamColumn(parts.stiffness, parts.curvature, parts.softening, parts.coupling, shape)
    laws: tuple[Law, ...] = (law,)
    if link.fibres is not None:
        laws = (law, yielding(link.length, link.stiffness, link.fibres, parts, shape))
    stretch = np.zeros((n, 6))
    stretch[:, 0] = 1.0 / n
    return Limb(
        tuple(elements),
        full,
        shape[:, _ORDER].ravel(),
        stretch[:, _ORDER].ravel(),
        tuple(Spring(tuple(numbers.tolist()), each) for each in laws),
        _stations(start, pieces, parts.size),
    )


@dataclass(frozen=True, eq=False)
class Shares:
    """What each segment gets.

    size: its length, mm. stiffness: (n, 6, 6) by its shift s, at the centre of its flexible part, and its
    rotation phi, in its half-turned frame. offset: (n, 2) of that centre before its middle, mm, for bending
    in y and in z. curvature, softening: (n, 6) diagonals of G and G', coupling: (n, 2) (`BeamColumn`). shear:
    (2,) number Phi.
    """

    size: float
    stiffness: Array
    offset: Array
    curvature: Array
    softening: Array
    coupling: Array
    shear: Array
    flexible: Array


def share_out(length: float, stiffness: Array, segments: int, like: Array | None = None) -> Shares:
    """Segments whose series is the bar: stiffness (6, 6) at the tip, symmetric positive definite, to rounding. like:
    that of a bar from whose segments they differ by as much as the bars do."""
    whole = _inverse(stiffness if like is None else like)
    size = length / segments
    lever = length - (np.arange(segments) + 0.5) * size
    parts, curvature, softening = np.zeros((segments, 6, 6)), np.zeros((segments, 6)), np.zeros((segments, 6))
    offset, shear, flexible = np.zeros((segments, 2)), np.zeros(2), np.zeros(2)
    parts[:, 0, 0], parts[:, 3, 3] = whole[0, 0] / segments, whole[3, 3] / segments
    for plane, (shift, turn, sign) in enumerate(_PLANES):
        centre = sign * whole[shift, turn] / whole[turn, turn]
        spread = whole[shift, shift] - whole[shift, turn] ** 2 / whole[turn, turn]
        uniform = whole[turn, turn] * length**2 / 12
        a = np.sqrt(min(1.0, spread / uniform))
        amount, flexible[plane] = whole[turn, turn] / segments, a * size
        bending, slip = amount * (a * size) ** 2 / 12, (spread - a**2 * uniform) / segments
        number = shear[plane] = slip / bending
        offset[:, plane] = centre + a * (lever - 0.5 * length) - lever
        parts[:, turn, turn], parts[:, shift, shift] = amount, bending + slip
        curvature[:, turn] = size * (a / 12 + (1 - a) / 4)
        curvature[:, shift] = (1.2 + 2 * number) / ((1 + number) ** 2 * a * size)
        curvature[:, shift] -= 2 * whole[0, 0] / (segments * bending * (1 + number) ** 2 * size)
        softening[:, turn] = amount * (a * size) ** 2 / 360
        softening[:, shift] = amount / (350 * (1 + number) ** 2)
    gj, ei_y, ei_z = (length / whole[i, i] for i in (3, 4, 5))
    coupling = np.array([gj - ei_y + ei_z, gj - ei_z + ei_y]) / ((1 + shear) * size**2)
    parts = _summing_to(parts, whole, lever[:, None] + offset)
    if like is not None:
        # Rotations first: turns stay where they are, and shifts are scaled about the centres of flexibility.
        parts = _summing_to(parts, _inverse(stiffness), lever[:, None] + offset, _ORDER)
    return Shares(
        size,
        np.stack([_inverse(part) for part in parts]),
        offset,
        curvature,
        softening,
        np.tile(coupling, (segments, 1)),
        shear,
        flexible,
    )


def radii_of_gyration(length: float, stiffness: Array) -> tuple[float, float]:
    """sqrt(EI_z / EA) and sqrt(EI_y / EA), mm, of a straight uniform bar with this 6x6: along y and along z."""
    amount = np.diag(_inverse(stiffness))
    return float(np.sqrt(amount[0] / amount[5])), float(np.sqrt(amount[0] / amount[4]))


def yielding(length: float, stiffness: Array, fibres: Fibres, parts: Shares, shape: Array) -> Yielding:
    """The law of yielding of the segments of a bar with this 6x6."""
    amount = np.diag(_inverse(stiffness))
    bending = len(shape) * parts.flexible / amount[[5, 4]]
    rigidity = np.array([length / amount[0], bending[1], bending[0]])
    section = Section(fibres, *fibres.grid(*np.sqrt(bending / rigidity[0])), rigidity)
    # No strain yields over more than it has elastically, or the tangent would not stay positive.
    shortest = float(min(parts.size, parts.flexible.min()))
    rates = strain_rates(parts.stiffness, rigidity, parts.flexible)
    return Yielding(section, shortest, parts.stiffness, parts.curvature, shape, rates)


def _give_way(parts: Shares, link: Link) -> None:
    """Adds what stands between bar and hinges to the compliance of the first and the last segment."""
    for number, give, side in ((0, link.base_give, 1.0), (-1, link.tip_give, -1.0)):
        if not np.any(give):
            continue
        whole = _inverse(parts.stiffness[number])
        first, second = 0.5 * parts.size - side * parts.offset[number]
        # Shifts along y and along z are counted at different centres.
        lever = np.eye(6)
        lever[1, 5], lever[2, 4] = side * first, -side * second
        parts.stiffness[number] = _inverse(whole + lever @ give @ lever.T)


def bowed_shape(link: Link, parts: Shares) -> Array:
    """(n, 6) of each segment in the unloaded bar, zero in a straight one.

    Its ends lie on the two half sines with frames along their tangents, so it is an arc of its own turn.
    """
    n = len(parts.stiffness)
    shape = np.zeros((n, 6))
    station = np.arange(n + 1) / n
    for amplitude, (shift, turn, sign), offset in zip(link.bow, _PLANES, parts.offset.T, strict=True):
        if amplitude == 0.0:
            continue
        height = amplitude * np.sin(np.pi * station)
        angle = np.arctan(amplitude * np.pi / link.length * np.cos(np.pi * station))
        middle = 0.5 * (angle[1:] + angle[:-1])
        along, up = np.full(n, parts.size), np.diff(height)
        shape[:, turn] = sign * np.diff(angle)
        shape[:, 0] += np.cos(middle) * along + np.sin(middle) * up - parts.size
        shape[:, shift] = np.cos(middle) * up - np.sin(middle) * along - offset * np.diff(angle)
    return shape


def _bowed_ends(link: Link) -> tuple[tuple[Element, ...], tuple[Element, ...]]:
    """From the frame of the base hinge to the bowed bar's tangent there, and back at the tip."""
    if not np.any(link.bow):
        return (), ()
    y, z = np.arctan(np.pi / link.length * np.array(link.bow))
    base, tip = exp(np.array([0.0, -z, y])), exp(np.array([0.0, -z, y]))
    return (Fixed(rotation=base),), (Fixed(rotation=tip),)


def _stations(
    start: tuple[Element, ...], pieces: list[tuple[Element, ...]], size: float
) -> tuple[tuple[Mark, float], ...]:
    """Nodes with the consistent share of a uniform load; its end moments by a shift of a sixth of a segment."""
    share, sixth = 1.0 / len(pieces), np.array([size / 6, 0.0, 0.0])
    nodes = np.cumsum([len(start), *(len(piece) for piece in pieces)])
    inner = [(Mark(int(node), np.zeros(3)), share) for node in nodes[1:-1]]
    return (Mark(int(nodes[0]), sixth), 0.5 * share), *inner, (Mark(int(nodes[-1]), -sixth), 0.5 * share)


def _summing_to(parts: Array, whole: Array, lever: Array, order: NDArray[np.int64] = _PLAIN) -> Array:
    """The compliances (n, 6, 6) changed by a congruence at the tip, so that their sum there is `whole`.

    lever: (n, 2) distance of the centres from the tip. The sum has the couplings of two planes only, of a bar that is
    perhaps another one; whole = S sum S^T with S from the Cholesky factors of the coordinates in this order.
    """
    move = np.broadcast_to(np.eye(6), parts.shape).copy()
    for plane, (shift, turn, sign) in enumerate(_PLANES):
        move[:, shift, turn] = sign * lever[:, plane]
    total = np.sum(move @ parts @ np.swapaxes(move, -1, -2), axis=0)
    if np.allclose(whole, total, rtol=SAME, atol=0.0):
        return parts
    scale = 1.0 / np.sqrt(np.diag(whole))
    some = np.ix_(order, order)
    factors = []
    for matrix in (whole, total):
        factor = np.zeros((6, 6))
        factor[order] = np.linalg.cholesky((scale[:, None] * matrix * scale)[some])
        factors.append(factor / scale[:, None])
    local = np.linalg.inv(move) @ factors[0] @ np.linalg.inv(factors[1]) @ move
    return local @ parts @ np.swapaxes(local, -1, -2)


def _inverse(symmetric: Array) -> Array:
    """Inverse with rows and columns of different units scaled alike."""
    scale = 1.0 / np.sqrt(np.diag(symmetric))
    inverse = scale[:, None] * np.linalg.inv(scale[:, None] * symmetric * scale) * scale
    return 0.5 * (inverse + inverse.T)


def _segment(number: int, parts: Shares) -> tuple[Element, ...]:
    ahead = Fixed(parts.size * np.eye(3)[0])
    first, second = parts.offset[number]
    moves = ((X, "s0", 1.0), (Y, "s1", 1.0), (Z, "s2", 1.0), (Y, "r2", first), (Z, "r1", -second))
    return (*_turn(number, (X, Y, Z)), ahead, *_moved(number, moves), *_turn(number, (Z, Y, X)))


@lru_cache(maxsize=1024)
def _turn(number: int, axes: tuple[tuple[float, float, float], ...]) -> tuple[Joint, ...]:
    """Half of the segment's rotation; in the reverse order the other half, which makes the whole symmetric."""
    return tuple(Joint("rotation", axis, Role.VIRTUAL, f"r{axis.index(1.0)}.{number}", 0.5) for axis in axes)


def _moved(
    number: int, moves: tuple[tuple[tuple[float, float, float], str, float], ...]
) -> tuple[Joint, ...]:
    """Translations along an axis by a share of a coordinate; shares of nothing are left out."""
    return tuple(
        Joint("translation", axis, Role.VIRTUAL, f"{tie}.{number}", share)
        for axis, tie, share in moves
        if share != 0.0
    )


def _bent(number: int, parts: Shares, share: float) -> tuple[Element, ...]:
    """From the segment's base to a point inside: the cubic of its bending and the straight line of its shear."""
    cubic = 3 * share**2 - 2 * share**3
    first, second = ((cubic + phi * share) / (1 + phi) for phi in parts.shear)
    sag = 0.5 * parts.size * share * (1 - share)
    offset = parts.offset[number]
    moves = (
        (X, "s0", share),
        (Y, "s1", first),
        (Z, "s2", second),
        (Y, "r2", first * offset[0] - sag),
        (Z, "r1", sag - second * offset[1]),
    )
    ahead = Fixed(share * parts.size * np.eye(3)[0])
    return (*_turn(number, (X, Y, Z)), ahead, *_moved(number, moves))
