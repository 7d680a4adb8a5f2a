"""What may stand between foot and platform of an Orthoglide: the linkages of Table 1 and readings of its first row."""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from vjm.bars import Y, Z
from vjm.frames import Array
from vjm.link import Link
from vjm.manipulator.parts import Manipulator, Parallelogram
from vjm.parts import Actuator, Elastic, Leg, Part, elastic, hinge

_ABOUT_Y, _ABOUT_Z = hinge(Y), hinge(Z)

Relink = Callable[[Parallelogram], tuple[Part, ...]]
"""What takes the place of hinge about z, parallelogram, hinge about z."""


def relinked(manipulator: Manipulator, relink: Relink) -> Manipulator:
    """The manipulator with the linkage of every leg replaced.

    ValueError for a leg without a parallelogram between two passive joints about z.
    """
    legs = []
    for leg in manipulator.legs:
        at = [k for k, part in enumerate(leg.parts) if isinstance(part, Parallelogram)]
        around = [leg.parts[k + side] for k in at for side in (-1, 1)]
        if len(at) != 1 or not all(p == _ABOUT_Z for p in around):
            raise ValueError(f"leg {leg.name} has no parallelogram between two passive joints about z")
        part = leg.parts[at[0]]
        assert isinstance(part, Parallelogram)
        before, after = leg.parts[: at[0] - 1], leg.parts[at[0] + 2 :]
        legs.append(Leg(leg.name, (*before, *relink(part), *after)))
    return replace(manipulator, legs=tuple(legs))


def parallelogram(radial: float = 0.0, segments: int = 0) -> Relink:
    """The parallelogram itself; radial: give of each hinge axis, mm/N, zero for solid axes."""
    return lambda p: (_ABOUT_Z, replace(p, radial=radial, tilt=0.0, segments=segments), _ABOUT_Z)


@dataclass(frozen=True)
class Reading:
    """One way to read "2x-bar linkage": its name and what it puts between foot and platform.

    moves: whether the manipulator still moves with it; without the pins in the plane of the linkage it is a frame.
    """

    name: str
    relink: Relink
    moves: bool = True


def doubled(bar: Array) -> Array:
    """2 K_b (6, 6)."""
    return 2.0 * bar


def grown(bar: Array) -> Array:
    """K_b (6, 6) of a section of twice the area and the same shape: axially twice, in bending and torsion four
    times."""
    scale = np.full((6, 6), 4.0)
    scale[0, 0] = 2.0
    return scale * bar


def _bar(
    of: Callable[[Array], Array], before: tuple[Part, ...], after: tuple[Part, ...], segments: int = 0
) -> Relink:
    return lambda p: (*before, elastic(p.length, of(p.bar_stiffness), segments), *after)


def two_fold_bar(segments: int = 0) -> Relink:
    """One bar of 2 K_b between universal joints, the paper's own reference for the parallelogram."""
    return _bar(doubled, (_ABOUT_Z, _ABOUT_Y), (_ABOUT_Y, _ABOUT_Z), segments)


READINGS = (
    Reading("2 K_b between universal joints", two_fold_bar()),
    Reading(
        "section of twice the area between universal joints",
        _bar(grown, (_ABOUT_Z, _ABOUT_Y), (_ABOUT_Y, _ABOUT_Z)),
    ),
    Reading("2 K_b, in-plane pin at the tip only", _bar(doubled, (_ABOUT_Z,), (_ABOUT_Y, _ABOUT_Z)), False),
    Reading(
        "section of twice the area, in-plane pin at the tip only",
        _bar(grown, (_ABOUT_Z,), (_ABOUT_Y, _ABOUT_Z)),
        False,
    ),
    Reading("2 K_b, no in-plane pins", _bar(doubled, (_ABOUT_Z,), (_ABOUT_Z,)), False),
    Reading("section of twice the area, no in-plane pins", _bar(grown, (_ABOUT_Z,), (_ABOUT_Z,)), False),
    Reading("2 K_b, no passive joint at all", _bar(doubled, (), ()), False),
)
"""Readings of the first row of Table 1."""


def with_unknowns(manipulator: Manipulator, actuator: float, foot: float) -> Manipulator:
    """Every drive with the stiffness `actuator`, N/mm, every foot with the bending stiffness `foot`, N·mm².

    The foot is the elastic link of the leg; its torsion follows that of a round section with Poisson's ratio 0.3, its
    length and axial stiffness stay.
    """
    legs = []
    for leg in manipulator.legs:
        parts: list[Part] = []
        for part in leg.parts:
            if isinstance(part, Actuator):
                part = replace(part, stiffness=actuator)
            elif isinstance(part, Elastic):
                part = replace(part, link=replace(part.link, stiffness=foot_stiffness(part.link, foot)))
            parts.append(part)
        legs.append(replace(leg, parts=tuple(parts)))
    return replace(manipulator, legs=tuple(legs))


def foot_stiffness(foot: Link, bending: float) -> Array:
    """(6, 6) of the foot at its tip, a slender beam of EI = `bending`, GJ = EI / 1.3."""
    length = foot.length
    k = np.diag([0.0, 12 / length**2, 12 / length**2, 1 / 1.3, 4.0, 4.0])
    k[1, 5] = k[5, 1] = -6 / length
    k[2, 4] = k[4, 2] = 6 / length
    k *= bending / length
    k[0, 0] = foot.stiffness[0, 0]
    return k
