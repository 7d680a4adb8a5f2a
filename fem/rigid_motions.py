"""The motions of a rigid body at its nodes."""

import numpy as np

from meshes.solid import Floats


def rigid_motions(arms: Floats) -> Floats:
    """Node displacements (3 n, 6) of the six unit motions of a body, for `arms` (n, 3) from its point, mm."""
    translations = np.broadcast_to(np.eye(3), (len(arms), 3, 3))
    rotations = np.stack([np.cross(e, arms) for e in np.eye(3)], axis=-1)
    return np.concatenate((translations, rotations), axis=2).reshape(-1, 6)
