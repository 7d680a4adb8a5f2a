"""A linear spring given by its compliance: F = q / c; c = 0 stands for no such coordinate."""

import numpy as np

from meshes.solid import Floats


def spring(q: Floats, compliance: Floats) -> tuple[Floats, Floats]:
    """Force and stiffness at q (mm or rad) for a compliance in mm/N or rad/(N mm); zero where the compliance is."""
    there = compliance > 0.0
    stiffness = np.where(there, 1.0 / np.where(there, compliance, 1.0), 0.0)
    return stiffness * q, stiffness
