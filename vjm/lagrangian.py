"""The Lagrange function of Eq. 4 with the platform pose among the unknowns: gradient and bordered Hessian.

Unknowns u, in this order: the moving coordinates (theta and q) of each chain, the platform pose t (6), the
multiplier lambda_i (6) of each chain. L = sum of elastic energies + sum lambda_i^T (t - g_i) - F^T t.
The gradient is Eq. 5 together with the platform's balance; its Hessian is symmetric, bordered by the loop
closures t = g_i. All arrays carry leading batch axes.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike

from vjm.frames import Array
from vjm.mechanism import ElasticChain, Mechanism


@dataclass(frozen=True, eq=False)
class Layout:
    """Where each unknown stands in u, and its typical size.

    coordinates, multipliers: one slice per chain; platform: one slice.
    scale: (N,) size of each unknown: length for translations, 1 rad, stiffness x length for forces.
    energy: stiffness x length², N·mm, the size of L. scale_i scale_j H_ij / energy is dimensionless.
    """

    coordinates: tuple[slice, ...]
    platform: slice
    multipliers: tuple[slice, ...]
    scale: Array
    energy: float

    @property
    def size(self) -> int:
        return self.scale.size

    @property
    def closures(self) -> int:
        """Number of scalar loop-closure equations: six per chain."""
        return 6 * len(self.multipliers)


def layout(mechanism: Mechanism) -> Layout:
    """Layout of u for a mechanism; its largest translational spring gives the unit of force."""
    sizes = [chain.moving.size for chain in mechanism.chains]
    edges = np.cumsum([0, *sizes, 6, *[6] * len(sizes)])
    pieces = [slice(int(a), int(b)) for a, b in pairwise(edges)]
    length = mechanism.length
    force = length * max(_translational_stiffness(chain) for chain in mechanism.chains)
    pose_scale = np.repeat([length, 1.0], 3)
    scales = [_coordinate_scale(chain, length) for chain in mechanism.chains]
    wrench_scale = force * np.repeat([1.0, length], 3)
    scale = np.concatenate([*scales, pose_scale, *[wrench_scale] * len(sizes)])
    n = len(sizes)
    return Layout(tuple(pieces[:n]), pieces[n], tuple(pieces[n + 1 :]), scale, force * length)


def at_rest(mechanism: Mechanism) -> Array:
    """Unknowns (N,) of the unloaded mechanism."""
    coordinates = [chain.rest[chain.moving] for chain in mechanism.chains]
    return np.concatenate([*coordinates, mechanism.unloaded_pose, np.zeros(6 * len(coordinates))])


def chain_coordinates(chain: ElasticChain, moving: Array) -> Array:
    """All coordinates (..., n) of a chain from its moving ones (..., m); drives stand at rest."""
    full = np.broadcast_to(chain.rest, (*moving.shape[:-1], chain.chain.size)).copy()
    full[..., chain.moving] = moving
    return full


def gradient_and_hessian(mechanism: Mechanism, unknowns: Array, wrench: ArrayLike) -> tuple[Array, Array]:
    """Gradient (..., N) and Hessian (..., N, N) of L at unknowns (..., N).

    wrench: (..., 6) external load on the platform, conjugate to the pose (p, rotation vector).
    """
    place = layout(mechanism)
    t = unknowns[..., place.platform]
    gradient = np.zeros_like(unknowns)
    hessian = np.zeros((*unknowns.shape, place.size))
    gradient[..., place.platform] = -np.asarray(wrench, dtype=float)
    for chain, x, dual in zip(mechanism.chains, place.coordinates, place.multipliers, strict=True):
        multiplier = unknowns[..., dual]
        full = chain_coordinates(chain, unknowns[..., x])
        kinematics = chain.chain.kinematics(full)
        jacobian = kinematics.jacobian[..., chain.moving]
        curvature = kinematics.hessian(multiplier)[..., chain.moving[:, None], chain.moving]
        stretch = unknowns[..., x] - chain.rest[chain.moving]
        pull = np.einsum("...ji,...j->...i", jacobian, multiplier)
        gradient[..., x] = stretch @ chain.full_stiffness - pull
        gradient[..., place.platform] += multiplier
        gradient[..., dual] = t - kinematics.pose
        hessian[..., x, x] = chain.full_stiffness - curvature
        hessian[..., dual, x] = -jacobian
        hessian[..., x, dual] = -np.swapaxes(jacobian, -1, -2)
        hessian[..., dual, place.platform] = hessian[..., place.platform, dual] = np.eye(6)
    return gradient, hessian


def _coordinate_scale(chain: ElasticChain, length: float) -> Array:
    joints = chain.chain.joints
    return np.array([length if joints[k].kind == "translation" else 1.0 for k in chain.moving])


def _translational_stiffness(chain: ElasticChain) -> float:
    joints = chain.chain.joints
    entries = zip(chain.virtual, np.diag(chain.stiffness), strict=True)
    return max((float(k) for j, k in entries if joints[j].kind == "translation"), default=1.0)
