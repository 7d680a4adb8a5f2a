"""The base body on six springs at the base origin."""

import numpy as np

from fem.frame.so3 import IDENTITY, apply, dot, hat, log, log_rate, outer, transpose
from meshes.solid import Floats


def base_spring(X: Floats, R: Floats, stiffness: Floats) -> tuple[Floats, Floats]:
    """Force (B, 6) and tangent (B, 6, 6) of the springs on a body at X (B, 3), R (B, 3, 3), at rest at zero.

    stiffness (B, 6): N/mm and N mm/rad along and about the axes of the base frame. The energy is half the sum of
    k X² and k θ² with θ the rotation vector; the tangent is its Hessian along exp(w) R, exact to θ³.
    """
    theta = log(R)
    moment = stiffness[:, 3:] * theta
    rate = log_rate(theta)
    force = np.concatenate((stiffness[:, :3] * X, apply(transpose(rate), moment)), axis=-1)
    tangent = np.zeros((len(X), 6, 6))
    tangent[:, :3, :3] = stiffness[:, :3, None] * IDENTITY
    second = (
        -0.5 * hat(moment) @ rate
        + (dot(theta, moment)[:, None, None] * IDENTITY + outer(theta, moment) - 2.0 * outer(moment, theta))
        / 12.0
    )
    turn = transpose(rate) @ (stiffness[:, 3:, None] * rate) + second
    tangent[:, 3:, 3:] = 0.5 * (turn + transpose(turn))
    return force, tangent
