"""The base body on springs or laws at the base origin."""

import numpy as np

from fem.frame.so3 import IDENTITY, apply, dot, hat, log, log_rate, outer, transpose
from meshes.solid import Floats


def base_coordinates(X: Floats, R: Floats) -> Floats:
    """(B, 6) place X (B, 3), mm, and rotation vector, rad, of a body that is at rest at zero; R (B, 3, 3)."""
    return np.concatenate((X, log(R)), axis=-1)


def base_forces(coordinates: Floats, own: Floats, stiffness: Floats) -> tuple[Floats, Floats]:
    """Force (B, 6) and tangent (B, 6, 6) on the base body, along and about the axes of the base frame.

    coordinates (B, 6) as of `base_coordinates`; own (B, 6): force that belongs to each, N, N mm; stiffness (B, 6) its
    derivative. The tangent is taken along exp(w) R, exact to θ³.
    """
    theta, moment = coordinates[:, 3:], own[:, 3:]
    rate = log_rate(theta)
    force = np.concatenate((own[:, :3], apply(transpose(rate), moment)), axis=-1)
    tangent = np.zeros((len(theta), 6, 6))
    tangent[:, :3, :3] = stiffness[:, :3, None] * IDENTITY
    second = (
        -0.5 * hat(moment) @ rate
        + (dot(theta, moment)[:, None, None] * IDENTITY + outer(theta, moment) - 2.0 * outer(moment, theta))
        / 12.0
    )
    turn = transpose(rate) @ (stiffness[:, 3:, None] * rate) + second
    tangent[:, 3:, 3:] = 0.5 * (turn + transpose(turn))
    return force, tangent
