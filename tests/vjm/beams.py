"""Uniform bars in closed form, and an independent rod: the references of the refined bar."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.integrate import solve_bvp
from scipy.spatial.transform import Rotation

from vjm import paper


@dataclass(frozen=True)
class Section:
    """Section stiffnesses of a uniform bar: EA, GA_y, GA_z in N; GJ, EI_y, EI_z in N·mm²."""

    ea: float
    gj: float
    ei_y: float
    ei_z: float
    ga_y: float = 1e15
    ga_z: float = 1e15

    def stiffness(self, length: float) -> np.ndarray:
        """K_b (6, 6) at the tip from the compliance of a Timoshenko cantilever."""
        bend = {5: (1, 1.0, self.ei_z, self.ga_y), 4: (2, -1.0, self.ei_y, self.ga_z)}
        c = np.diag([length / self.ea, 0, 0, length / self.gj, 0, 0])
        for turn, (shift, sign, ei, ga) in bend.items():
            c[turn, turn] = length / ei
            c[shift, turn] = c[turn, shift] = sign * length**2 / (2 * ei)
            c[shift, shift] = length**3 / (3 * ei) + length / ga
        return np.linalg.inv(c)


YOUNG, SHEAR = 70e3, 70e3 / 2 / 1.33
BAR_P = Section(YOUNG * 97.2, SHEAR * 357.4, YOUNG * 2812.1, YOUNG * 692.8, SHEAR * 59.7, SHEAR * 51.8)
"""I-section with flanges 12 x 2.2, height 15.5, web 4 mm, aluminium."""

_K = paper.BAR_STIFFNESS
_LENGTH = paper.LENGTH
SLENDER = Section(
    _K[0, 0] * _LENGTH, _K[3, 3] * _LENGTH, _K[2, 2] * _LENGTH**3 / 12, _K[1, 1] * _LENGTH**3 / 12
)
"""The uniform bar without shear that has K11, K22, K33 and K44 of Eq. 12."""


def rod_load(section: Section, length: float, motion: np.ndarray) -> np.ndarray:
    """Force and moment (6,) on the tip of a clamped rod moved by (shift, rotation vector).

    Geometrically exact rod (E. Reissner 1981, J. C. Simo 1985) as a boundary value problem in arc length:
    r' = R (e_x + C_f R^T n), R' = R skew(C_m R^T m), n' = 0, m' = n x r'; the orientation is a quaternion.
    """
    flex_n = np.array([1 / section.ea, 1 / section.ga_y, 1 / section.ga_z])
    flex_m = np.array([1 / section.gj, 1 / section.ei_y, 1 / section.ei_z])
    size = np.repeat([section.ei_z / length**2, section.ei_z / length], 3)

    def turned(q: np.ndarray, v: np.ndarray, back: bool) -> np.ndarray:
        """Rotation of v (3, B) by the quaternion q (4, B), scalar last, or back."""
        vector = -q[:3] if back else q[:3]
        cross = np.cross(vector, v, axis=0)
        return v + 2 * q[3] * cross + 2 * np.cross(vector, cross, axis=0)

    def slope(_: np.ndarray, y: np.ndarray) -> np.ndarray:
        q = y[3:7] / np.linalg.norm(y[3:7], axis=0)
        n, m = size[:3, None] * y[7:10], size[3:, None] * y[10:]
        strain = flex_n[:, None] * turned(q, n, True)
        strain[0] += 1.0
        tangent = turned(q, strain, False)
        w = 0.5 * flex_m[:, None] * turned(q, m, True)
        dq = np.vstack([q[3] * w + np.cross(q[:3], w, axis=0), -np.sum(q[:3] * w, axis=0)])
        dm = np.cross(n, tangent, axis=0) / size[3:, None]
        return length * np.vstack([tangent, dq, 0 * n, dm])

    target = Rotation.from_rotvec(motion[3:]).as_quat()

    def ends(a: np.ndarray, b: np.ndarray) -> np.ndarray:
        place = b[:3] - motion[:3] - [length, 0, 0]
        turn = (Rotation.from_quat(target).inv() * Rotation.from_quat(b[3:7])).as_quat()[:3]
        return np.concatenate([a[:3], a[3:7] - [0, 0, 0, 1], place, turn])

    s = np.linspace(0, 1, 41)
    guess = np.zeros((13, s.size))
    guess[0], guess[6] = s * length, 1.0
    solution = solve_bvp(slope, ends, s, guess, tol=1e-10, max_nodes=20000)
    assert solution.success, solution.message
    return np.asarray(size * solution.y[7:, -1])
