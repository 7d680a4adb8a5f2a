"""The ends of the bars give a little more, or less, than their 6x6 says: what lugs, welds and a mesh's ends do."""

from __future__ import annotations

from typing import ClassVar

import numpy as np

from vjm.effects.base import Parameter, Rig, Values, for_bars
from vjm.link import Link
from vjm.tolerances.base import Tolerance

_DIRECTIONS = ("x", "y", "z", "rx", "ry", "rz")


class EndSoftness(Tolerance):
    """Both ends of all bars have a compliance more, of either sign: it is part of K_b, no spring of its own."""

    name = "end_softness"
    title = "ends of all bars softer or stiffer than their 6x6"
    equation = "K_b⁻¹ -> K_b⁻¹ + c + T c Tᵀ, c = diag(share_k (K_b⁻¹)_kk), T from the base end to the tip"
    signature = "slopes change by a share of their own in each direction, alike at every angle; no curvature"
    limits = "both ends of all bars alike; diagonal; small against the compliance of the bar"
    source = "compliances of members in series add"
    parameters = tuple(
        Parameter(
            name, "1", 0.0, 0.005, -0.2, 0.2, f"compliance of each end along {name}, of that of the bar"
        )
        for name in _DIRECTIONS
    )
    keys: ClassVar = dict.fromkeys(_DIRECTIONS, "ends")
    deviations: ClassVar = {"ends": 0.005}

    def change(self, rig: Rig, values: Values) -> Rig:
        shares = np.array([values[name] for name in _DIRECTIONS])
        return for_bars(rig, lambda link: _softened(link, shares))


def _softened(link: Link, shares: np.ndarray) -> Link:
    compliance = np.linalg.inv(link.stiffness)
    ends = np.diag(shares * np.diag(compliance))
    lever = np.eye(6)
    lever[1, 5], lever[2, 4] = link.length, -link.length
    return link.with_little_more(ends + lever @ ends @ lever.T)
