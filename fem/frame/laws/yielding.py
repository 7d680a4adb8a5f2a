"""A fibre that yields: linear elastic up to a strain, then linear kinematic hardening, with memory.

Stress over E: s = ε - ε_p; yielding where |s - H ε_p| exceeds the yield strain, with H = r / (1 - r) and r the
tangent over the elastic modulus. Closed-form return mapping.
Source: J. C. Simo, T. J. R. Hughes, Computational Inelasticity, Springer 1998, section 1.4 (box 1.5).
"""

import numpy as np

from meshes.solid import Floats

HARDENING = 0.01
"""Tangent modulus past yield over the elastic one: of the order of structural aluminium and steel at small strain."""
_H = HARDENING / (1.0 - HARDENING)


def plastic_strain(strain: Floats, before: Floats, limit: Floats) -> tuple[Floats, Floats]:
    """New plastic strain and its derivative for the strain, from the plastic strain before; yield strain `limit`."""
    trial = strain - before * (1.0 + _H)
    over = np.maximum(np.abs(trial) - limit, 0.0)
    new = before + np.sign(trial) * over / (1.0 + _H)
    return new, np.where(over > 0.0, 1.0 / (1.0 + _H), 0.0)
