"""A Delta of arms and rod pairs, and other mechanisms of three equal legs about z."""

from __future__ import annotations

import numpy as np

from fem.beam import uniform_stiffness
from vjm.bars import Y
from vjm.frames import Array, rotation_y
from vjm.manipulator.parts import Manipulator
from vjm.parts import Actuator, Elastic, Frame, Leg, Part, elastic, rod_pair

RADIUS, ARM, ROD, PLATFORM, APART = 200.0, 200.0, 400.0, 50.0, 60.0
HOME = np.deg2rad(30.0)
POINT = np.array([0.0, 0.0, -ARM * np.sin(HOME)]) - [
    0.0,
    0.0,
    np.sqrt(ROD**2 - (RADIUS + ARM * np.cos(HOME) - PLATFORM) ** 2),
]
MODULUS, SHEAR = 7e4, 2.7e4


def round_bar(length: float, radius: float, segments: int = 0) -> Elastic:
    """A slender round bar of aluminium."""
    area, second = np.pi * radius**2, np.pi * radius**4 / 4
    k = uniform_stiffness(length, MODULUS * area, MODULUS * second, MODULUS * second, 2 * SHEAR * second)
    return elastic(length, k, segments)


def about_z(angle: float) -> Array:
    """(3, 3)."""
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])


def three_legs(
    name: str, parts: tuple[Part, ...], base: float, platform: float, size: float, top: float = 0.0
) -> Manipulator:
    """Legs from the base circle to the platform circle, x outwards; each ends with the axes of its start.

    top: how far above that circle the platform point lies.
    """
    legs = []
    for k, letter in enumerate("abc"):
        turn = about_z(2.0 * np.pi * k / 3.0)
        begin, end = Frame(turn @ [base, 0.0, 0.0], turn), Frame(np.array([-platform, 0.0, top]), turn.T)
        legs.append(Leg(letter, (begin, *parts, end)))
    return Manipulator(name, tuple(legs), size)


def delta(segments: int = 0, drive: float = 5e6) -> Manipulator:
    """Its platform stands at `POINT` with the arms at `HOME`, about which rods and joints stand straight."""
    turned = np.pi - np.arcsin((-ARM * np.sin(HOME) - POINT[2]) / ROD)
    parts = (
        Actuator("rotation", Y, drive, HOME),
        round_bar(ARM, 12.0),
        Frame(rotation=rotation_y(turned - HOME)),
        rod_pair(round_bar(ROD, 5.0, segments), APART),
        Frame(rotation=rotation_y(-turned)),
    )
    return three_legs("delta", parts, RADIUS, PLATFORM, ROD)
