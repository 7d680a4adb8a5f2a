"""The laws of all joint coordinates of a frame together: which coordinate obeys which law, with what memory."""

from dataclasses import dataclass

import numpy as np

from fem.frame.batch import Bools
from fem.frame.placed import Anchored
from meshes.solid import Floats

CENTRING = 20.0
"""Centring spring inside a play, N/mm."""
STOP = 1e8
"""Stop at the end of a play, N/mm: some thousand times a bar's axial stiffness. It gives 0.04 µm at 4 kN, far below any
gauge, and its contact force still keeps 1e-7 N at the rounding of a 0.1 mm play."""
LINEAR_BELOW = 1.0
"""Force below which a contact is linear, N."""


@dataclass(frozen=True, eq=False)
class Joints:
    """Joints of tests, bars and ends: arrays (B, K, 2, ...).

    place (..., 3) mm and frame (..., 3, 3): where the chain starts in its body. bodies: for each bar, the body at its
    base and tip. slots: the coordinates kept (`chain.motion_of`); active (..., S): those that a joint has.
    compliance (..., S): mm/N or rad/(N mm), of radial and tilt. return_spring N mm/rad, torque N mm and presliding
    rad of the hinges; relaxed rad: turn from as drawn at which a return spring carries nothing (the sliders of friction
    begin there too, and laws placed at hinges); play mm and contact mm/N^(2/3) along the bar. placed: laws at sites.
    """

    place: Floats
    frame: Floats
    active: Bools
    compliance: Floats
    return_spring: Floats
    torque: Floats
    presliding: Floats
    relaxed: Floats
    play: Floats
    contact: Floats
    bodies: tuple[tuple[int, int], ...]
    slots: tuple[str, ...]
    placed: tuple[Anchored, ...] = ()


def spring(q: Floats, compliance: Floats) -> tuple[Floats, Floats]:
    """A linear spring: force and stiffness at q (mm or rad), arrays (...) of one shape, for a compliance in mm/N or
    rad/(N mm); zero where the compliance is, which stands for no such coordinate."""
    there = compliance > 0.0
    stiffness = np.where(there, 1.0 / np.where(there, compliance, 1.0), 0.0)
    return stiffness * q, stiffness


def play(q: Floats, half: Floats) -> tuple[Floats, Floats]:
    """Play between two stops, with a soft centring spring inside: force N and stiffness N/mm at q mm for a play of
    ±half mm, all (...).

    F = `CENTRING` q within ±half; beyond, the stop adds `STOP` (|q| - half) sign(q).
    """
    over = np.maximum(np.abs(q) - half, 0.0)
    return CENTRING * q + STOP * over * np.sign(q), CENTRING + np.where(over > 0.0, STOP, 0.0)


def contact(q: Floats, c: Floats) -> tuple[Floats, Floats]:
    """Hertz-like contact of both signs, δ = c sign(F) |F|^(2/3): force N and stiffness N/mm at an approach q mm for c
    in mm/N^(2/3), all (...); zero where c is.

    Below `LINEAR_BELOW` the law is the chord of that force: Hertz's law starts without stiffness, which no equilibrium
    without load could stand on. At half that force it is 0.13 c mm short, c of the order 1e-5: a nanometre.
    Source: K. L. Johnson, Contact Mechanics, Cambridge 1985, section 4.2 (exponent 2/3 of point contact).
    """
    there = c > 0.0
    ratio = np.abs(q) / np.where(there, c, 1.0)
    start = LINEAR_BELOW ** (2.0 / 3.0)
    chord = LINEAR_BELOW / start
    root = np.sqrt(np.maximum(ratio, start))
    linear = ratio < start
    force = np.where(linear, chord * ratio, ratio * root) * np.sign(q)
    stiffness = np.where(linear, chord, 1.5 * root) / np.where(there, c, 1.0)
    return np.where(there, force, 0.0), np.where(there, stiffness, 0.0)


def friction(q: Floats, slider: Floats, torque: Floats, presliding: Floats) -> tuple[Floats, Floats, Floats]:
    """Coulomb friction with an elastic start, a spring in series with a slider (Jenkins element): torque N mm,
    stiffness N mm/rad and new slider at the angle q rad, from the slider's place before, rad, all (...).

    Below the torque T the spring of stiffness T / presliding turns; at T the slider follows. torque N mm, zero: no
    friction. presliding rad, positive.
    Source: G. M. Jenkins, "Analysis of the stress-strain relationships in reactor grade graphite", Brit. J. Appl. Phys.
    13 (1962) 30-32; W. D. Iwan, J. Appl. Mech. 33 (1966) 893-900.
    """
    stiffness = torque / presliding
    trial = stiffness * (q - slider)
    sliding = np.abs(trial) > torque
    force = np.clip(trial, -torque, torque)
    moved = q - np.sign(trial) * presliding
    return force, np.where(sliding, 0.0, stiffness), np.where(sliding, moved, slider)


def joint_forces(joints: Joints, q: Floats, slider: Floats) -> tuple[Floats, Floats, Floats]:
    """Forces and stiffnesses (B, K, 2, S) at the coordinates q, and the new sliders (B, K, 2) of hinge friction."""
    force, stiffness = np.zeros_like(q), np.zeros_like(q)
    for j, slot in enumerate(joints.slots):
        here = q[..., j]
        if slot == "play":
            force[..., j], stiffness[..., j] = play(here, joints.play)
        elif slot == "contact":
            force[..., j], stiffness[..., j] = contact(here, joints.contact)
        elif slot == "hinge":
            torque, tangent, slider = friction(here, slider, joints.torque, joints.presliding)
            force[..., j] = joints.return_spring * (here - joints.relaxed) + torque
            stiffness[..., j] = joints.return_spring + tangent
        else:
            force[..., j], stiffness[..., j] = spring(here, joints.compliance[..., j])
    return np.where(joints.active, force, 0.0), np.where(joints.active, stiffness, 0.0), slider
