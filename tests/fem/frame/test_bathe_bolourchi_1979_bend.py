"""A quarter of a right angle in the plane, bent out of it by a dead force: three-dimensional large rotations.

K.-J. Bathe, S. Bolourchi, "Large displacement analysis of three-dimensional beam structures", International Journal for
Numerical Methods in Engineering 14 (1979) 961-986, section 5.4: radius 100 in, 45 degrees, a square inch, E = 1e7 psi,
ν = 0, force 600 lb at the tip across the plane, eight straight elements. Published tips from (29.3, 70.7, 0.0):
Bathe and Bolourchi (15.9, 47.2, 53.4); J. C. Simo, L. Vu-Quoc, Comput. Methods Appl. Mech. Engrg. 58 (1986) 79-116
(15.79, 47.23, 53.37); M. A. Crisfield, ibid. 81 (1990) 131-150 (15.61, 46.84, 53.71); A. Cardona, M. Geradin, Int. J.
Numer. Methods Engrg. 26 (1988) 2403-2438 (15.55, 47.04, 53.50). They lie within 0.4 of each other; so must this.
"""

from __future__ import annotations

import numpy as np

from fem.frame.condensation import solve
from fem.frame.element import force_and_tangent
from fem.frame.local import Reference, strains
from fem.frame.motion import relative
from fem.frame.so3 import exp
from meshes.solid import Floats

E, ELEMENTS, RADIUS, FORCE = 1e7, 8, 100.0, 600.0
PUBLISHED = np.array(
    [[15.9, 47.2, 53.4], [15.79, 47.23, 53.37], [15.61, 46.84, 53.71], [15.55, 47.04, 53.50]]
)


def bend() -> tuple[Reference, Floats, Floats]:
    """Straight chords of the arc that starts along y and turns towards x; each end triad along its tangent."""
    angle = np.linspace(0.0, np.pi / 4, ELEMENTS + 1)
    x = RADIUS * np.stack((1.0 - np.cos(angle), np.sin(angle), 0.0 * angle), axis=-1)
    R = exp(np.stack((0.0 * angle, 0.0 * angle, np.pi / 2 - angle), axis=-1))
    motion = relative(x[:-1], R[:-1], x[1:], R[1:])
    unloaded, _, length = strains(motion.d, motion.phi)
    h = length[:, 0]
    bend_stiffness = np.zeros((ELEMENTS, 2, 2, 2))
    bend_stiffness[..., 0, 0] = (E / 12 / h)[:, None]
    bend_stiffness[..., 1, 1] = (E / h**3)[:, None]
    string = np.zeros_like(bend_stiffness)
    string[..., 0, 0], string[..., 1, 1] = 1 / 12, (0.2 / h**2)[:, None]
    ones = np.ones(ELEMENTS)
    pairs = np.ones((ELEMENTS, 2))
    ref = Reference(
        h, E * ones, E / 2 / 6 * ones, bend_stiffness, string, unloaded[:, 0], unloaded[:, 1:3],
        unloaded[:, 3:], 0.0 * pairs, h[:, None] * pairs,
    )  # fmt: skip
    return ref, x, R


def test_tip_at_600_pounds() -> None:
    ref, x, R = bend()
    np.testing.assert_allclose(x[-1], [29.29, 70.71, 0.0], atol=0.005)
    size = 6 * (ELEMENTS + 1)
    for load in np.linspace(0.0, FORCE, 7)[1:]:
        for _ in range(12):
            force, tangent = force_and_tangent(x, R, ref)
            K, r = np.zeros((size, size)), np.zeros(size)
            for e in range(ELEMENTS):
                here = slice(6 * e, 6 * e + 12)
                K[here, here] += tangent[e]
                r[here] += force[e]
            r[-4] -= load
            step = np.zeros(size)
            step[6:] = -solve(K[6:, 6:], r[6:, None])[:, 0]
            if np.abs(r[6:]).max() < 1e-6:
                break
            moved = step.reshape(-1, 6)
            x, R = x + moved[:, :3], exp(moved[:, 3:]) @ R
        assert np.abs(r[6:]).max() < 1e-6
    assert (PUBLISHED.min(0) - 0.1 < x[-1]).all() and (x[-1] < PUBLISHED.max(0) + 0.1).all(), x[-1]
