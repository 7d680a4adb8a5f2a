"""How the two ends of a beam move relative to each other, with first and second derivatives.

With end triads R1, R2 and Δ = x2 - x1: φ = log(R1ᵀ R2), the mean frame Λ = R1 exp(φ/2), d = Λᵀ Δ. Both d and φ are
unchanged by any rigid motion, and swapping the ends only changes their sign. Rates are written in the mean frame
with s the mean and r the difference of the two spins:
    spin of Λ: ω = s - ½ τ φ x r,  δd = δΔ - ω x d,  δφ = (1 + γ φ̂²) r,
    τ = tan(|φ|/4) / |φ|,  γ = -(|φ|/2 / sin(|φ|/2) - 1) / |φ|².
Second derivatives are those of d and φ along exp(w) R, so the Hessian of an energy is symmetric.
"""

from dataclasses import dataclass

import numpy as np

from fem.frame.so3 import IDENTITY, apply, cross, dot, exp, hat, log, outer, transpose
from meshes.solid import Floats

# Δ, s, r of (x1, w1, x2, w2).
_SPLIT = np.zeros((9, 12))
for _i in range(3):
    _SPLIT[_i, _i], _SPLIT[_i, 6 + _i] = -1.0, 1.0
    _SPLIT[3 + _i, 3 + _i] = _SPLIT[3 + _i, 9 + _i] = 0.5
    _SPLIT[6 + _i, 3 + _i], _SPLIT[6 + _i, 9 + _i] = -1.0, 1.0


@dataclass(frozen=True, eq=False)
class Motion:
    """Relative motion of element ends: mean frame (..., 3, 3), d (..., 3) mm, φ (..., 3) rad."""

    frame: Floats
    d: Floats
    phi: Floats


def relative(x1: Floats, R1: Floats, x2: Floats, R2: Floats) -> Motion:
    """Relative motion of ends at x (..., 3) with triads R (..., 3, 3)."""
    phi = log(transpose(R1) @ R2)
    frame = R1 @ exp(0.5 * phi)
    return Motion(frame, apply(transpose(frame), x2 - x1), phi)


def coefficients(phi: Floats) -> tuple[Floats, Floats, Floats, Floats]:
    """τ, τ'/|φ|, γ, γ'/|φ|, each (..., 1, 1): power series, to 1e-12 of unity for |φ| below 0.5 rad."""
    square = dot(phi, phi)[..., None, None]
    u, v = square / 16.0, square / 4.0
    tau = 0.25 * (1 + u * (1 / 3 + u * (2 / 15 + u * (17 / 315 + u * 62 / 2835))))
    tau2 = (1 / 3 + u * (4 / 15 + u * (51 / 315 + u * 248 / 2835))) / 32.0
    g = (1 / 6, 7 / 360, 31 / 15120, 127 / 604800, 73 / 3421440, 1414477 / 653837184000)
    gamma = -0.25 * (g[0] + v * (g[1] + v * (g[2] + v * (g[3] + v * (g[4] + v * g[5])))))
    gamma2 = -0.125 * (g[1] + v * (2 * g[2] + v * (3 * g[3] + v * (4 * g[4] + v * 5 * g[5]))))
    return tau, tau2, gamma, gamma2


def rates(motion: Motion) -> tuple[Floats, Floats, Floats]:
    """(..., 6, 9) rates of (d, φ) for (Δ, s, r) in the mean frame, and the blocks ½ τ φ̂ and ∂φ/∂r."""
    tau, _, gamma, _ = coefficients(motion.phi)
    w = hat(motion.phi)
    spin, turn = 0.5 * tau * w, IDENTITY + gamma * (w @ w)
    arm = hat(motion.d)
    b = np.zeros((*motion.d.shape[:-1], 6, 9))
    b[..., :3, :3] = IDENTITY
    b[..., :3, 3:6] = arm
    b[..., :3, 6:] = -arm @ spin
    b[..., 3:, 6:] = turn
    return b, spin, turn


def geometric(motion: Motion, force: Floats, moment: Floats, spin: Floats, turn: Floats) -> Floats:
    """(..., 9, 9) symmetric second derivative of force·d + moment·φ for (Δ, s, r), both in the mean frame.

    `force` (..., 3) N and `moment` (..., 3) N mm are held while d and φ move; `spin`, `turn` come from `rates`.
    """
    d, phi = motion.d, motion.phi
    tau, tau2, gamma, gamma2 = coefficients(phi)
    n, nd = hat(force), hat(force) @ hat(d)
    lever = cross(d, force)
    m = hat(lever)
    twist = 0.5 * tau * hat(cross(lever, phi))
    bend = tau * IDENTITY + tau2 * outer(phi, phi)
    mp = dot(moment, phi)[..., None, None]
    pp = dot(phi, phi)[..., None, None]
    second = gamma * (outer(phi, moment) + mp * IDENTITY - 2 * outer(moment, phi))
    second = second + gamma2 * (mp * outer(phi, phi) - pp * outer(moment, phi))
    a = hat(moment + gamma[..., 0] * apply(hat(phi) @ hat(phi), moment))
    g = np.zeros((*d.shape[:-1], 9, 9))
    g[..., :3, 3:6] = -n
    g[..., :3, 6:] = n @ spin
    g[..., 3:6, :3] = n
    g[..., 3:6, 3:6] = nd
    g[..., 3:6, 6:] = -(m + nd) @ spin
    g[..., 6:, :3] = spin @ n
    g[..., 6:, 3:6] = spin @ nd - twist - a
    g[..., 6:, 6:] = (0.5 * m @ bend + second) @ turn + (twist + a - spin @ nd) @ spin
    return 0.5 * (g + transpose(g))


def to_ends(motion: Motion, gradient: Floats, hessian: Floats) -> tuple[Floats, Floats]:
    """Forces (..., 12) and stiffness (..., 12, 12) at (x1, w1, x2, w2) in the base frame, from those of (Δ, s, r)."""
    turned = np.zeros((*gradient.shape[:-1], 9, 12))
    back = transpose(motion.frame)
    for block in range(3):
        rows = slice(3 * block, 3 * block + 3)
        for column in (0, 3, 6, 9):
            weight = _SPLIT[3 * block, column]
            if weight:
                turned[..., rows, column : column + 3] = weight * back
    return (gradient[..., None, :] @ turned)[..., 0, :], transpose(turned) @ hessian @ turned
