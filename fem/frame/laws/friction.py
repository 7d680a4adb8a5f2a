"""Coulomb friction with an elastic start: a spring in series with a slider (Jenkins element).

Below the torque T the spring of stiffness T / presliding turns; at T the slider follows.
Source: G. M. Jenkins, "Analysis of the stress-strain relationships in reactor grade graphite", Brit. J. Appl. Phys.
13 (1962) 30-32; W. D. Iwan, J. Appl. Mech. 33 (1966) 893-900.
"""

import numpy as np

from meshes.solid import Floats


def friction(q: Floats, slider: Floats, torque: Floats, presliding: Floats) -> tuple[Floats, Floats, Floats]:
    """Torque N mm, stiffness N mm/rad and new slider at the angle q rad, from the slider's place before, rad.

    torque N mm, zero: no friction. presliding rad, positive.
    """
    stiffness = torque / presliding
    trial = stiffness * (q - slider)
    sliding = np.abs(trial) > torque
    force = np.clip(trial, -torque, torque)
    moved = q - np.sign(trial) * presliding
    return force, np.where(sliding, 0.0, stiffness), np.where(sliding, moved, slider)
