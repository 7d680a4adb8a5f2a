"""The laws of all joint coordinates of a frame together: which coordinate obeys which law, with what memory."""

from dataclasses import dataclass

import numpy as np

from fem.frame.batch import Bools
from fem.frame.laws.contact import contact
from fem.frame.laws.friction import friction
from fem.frame.laws.play import play
from fem.frame.laws.spring import spring
from fem.frame.placed import Anchored
from meshes.solid import Floats


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
