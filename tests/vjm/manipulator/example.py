"""An Orthoglide whose linkage, drive and foot the tests choose."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import ArrayLike

from vjm import paper
from vjm.bars import X, Y, Z
from vjm.equilibrium import Equilibrium, equilibrium, unloaded
from vjm.frames import Array
from vjm.manipulator.assembled import settled
from vjm.manipulator.machine import machine, posture_inputs
from vjm.manipulator.parts import Manipulator, Parallelogram
from vjm.manipulator.posture import Postures
from vjm.parts import Actuator, Frame, Leg, Part, elastic, hinge
from vjm.problem import Held

LENGTH, WIDTH, FOOT = paper.LENGTH, paper.WIDTH, 100.0
DRIVE, AXIAL, BENDING = 3500.0, 4.2e7, 4.5e8
ABOUT_Y, ABOUT_Z = hinge(Y), hinge(Z)
POINTS = np.array([[0, 0, 0], [50, -40, 60], [-60, 30, 80], [90, 90, -90], [-80, -80, -80]], dtype=float)


def beam(axial: float, about_y: float, about_z: float, torsion: float, length: float) -> Array:
    """(6, 6) of a slender uniform bar at its tip: EA, EI_y, EI_z, GJ."""
    k = np.diag(
        [axial, 12 * about_z / length**2, 12 * about_y / length**2, torsion, 4 * about_y, 4 * about_z]
    )
    k[1, 5] = k[5, 1] = -6 * about_z / length
    k[2, 4] = k[4, 2] = 6 * about_y / length
    return k / length


def orthoglide(linkage: tuple[Part, ...], drive: float = DRIVE, bending: float = BENDING) -> Manipulator:
    """Three legs along x, y and z, the isotropic posture at zero."""
    foot = elastic(FOOT, beam(AXIAL, bending, bending, bending / 1.3, FOOT))
    legs = []
    for k in range(3):
        frame = np.roll(np.eye(3), k, axis=0)
        start = Frame(-(FOOT + LENGTH) * frame[:, 0], frame)
        parts = (start, Actuator("translation", X, drive), foot, *linkage, Frame(rotation=frame.T))
        legs.append(Leg("xyz"[k], parts))
    return Manipulator("orthoglide", tuple(legs), LENGTH)


def pair(bar: Array = paper.BAR_STIFFNESS, **change: object) -> tuple[Part, ...]:
    """Hinge, parallelogram, hinge."""
    return ABOUT_Z, Parallelogram(LENGTH, WIDTH, bar, **change), ABOUT_Z  # type: ignore[arg-type]


def universal(bar: Array) -> tuple[Part, ...]:
    """One bar between universal joints."""
    return ABOUT_Z, ABOUT_Y, elastic(LENGTH, bar), ABOUT_Y, ABOUT_Z


def without_load(whole: Manipulator, at: Postures) -> Equilibrium:
    """The states of rest at postures."""
    return unloaded(machine(whole), posture_inputs(at))


def under(
    whole: Manipulator,
    at: Postures,
    targets: ArrayLike,
    held: Held = (),
    heat: Mapping[str, float] | None = None,
    **more: object,
) -> Equilibrium:
    """Equilibria at postures under targets, see `vjm.equilibrium`; where hinges are relaxed follows from the rest."""
    of = machine(whole)
    inputs = {**posture_inputs(at), **settled(of, at), **(heat or {})}
    targets = np.broadcast_to(np.asarray(targets, dtype=float), (*at.reached.shape, np.shape(targets)[-1]))
    return equilibrium(of, targets, held, drives=inputs, **more)  # type: ignore[arg-type]


def relative(k: Array, reference: Array) -> float:
    """Largest difference of two 6x6 in units of the reference's diagonal."""
    root = np.sqrt(np.abs(np.diagonal(reference, axis1=-2, axis2=-1)))
    return float(np.max(np.abs(k - reference) / (root[..., :, None] * root[..., None, :])))
