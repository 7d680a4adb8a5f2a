"""Kinematics of a chain at one state, written with matrices: what compiled functions are tested against."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from vjm.chain import Chain, Fixed
from vjm.frames import Array, exp, inverse_rotation_jacobian, log, moment_gradient, skew


@dataclass(frozen=True, eq=False)
class Reference:
    """pose: (6,). linear, angular: (3, J) velocities of the end by the joints. shares: (J, n) joint values by the
    coordinates."""

    pose: Array
    linear: Array
    angular: Array
    shares: Array

    @property
    def rate(self) -> Array:
        """(3, 3) of the rotation vector by the angular velocity."""
        return inverse_rotation_jacobian(self.pose[3:])

    @property
    def jacobian(self) -> Array:
        """(6, n) of the pose by the coordinates."""
        return np.vstack([self.linear, self.rate @ self.angular]) @ self.shares

    def hessian(self, multiplier: Array) -> Array:
        """Second derivative (n, n) of pose^T lambda at fixed lambda (6,); see `vjm.kernels`."""
        moment = self.rate.T @ multiplier[3:]
        slope = moment_gradient(self.pose[3:], multiplier[3:]) @ self.rate
        z = (slope.T - skew(moment)) @ self.angular - skew(multiplier[:3]) @ self.linear
        upper = np.triu(self.angular.T @ z)
        return np.asarray(self.shares.T @ (upper + np.triu(upper, 1).T) @ self.shares)


def reference(chain: Chain, coordinates: Array) -> Reference:
    """At coordinates (n,)."""
    shares = chain.tie.share[:, None] * (chain.tie.coordinate[:, None] == np.arange(chain.size))
    values = iter(shares @ coordinates)
    frame, place = np.eye(3), np.zeros(3)
    axes, origins = [], []
    for element in chain.elements:
        if isinstance(element, Fixed):
            place, frame = place + frame @ element.translation, frame @ element.rotation
            continue
        # An axis that is one of the frame's to rounding is that one.
        axis = frame[:, element.along] if element.along >= 0 else frame @ np.array(element.axis)
        value = next(values)
        axes.append((axis, element.kind == "rotation"))
        origins.append(place)
        if element.kind == "rotation":
            frame = exp(value * axis) @ frame
        else:
            place = place + value * axis
    velocities = [
        np.append(np.cross(axis, place - origin), axis) if turns else np.append(axis, np.zeros(3))
        for (axis, turns), origin in zip(axes, origins, strict=True)
    ]
    whole = np.array(velocities).reshape(-1, 6).T
    return Reference(np.append(place, log(frame @ chain.reference.T)), whole[:3], whole[3:], shares)
