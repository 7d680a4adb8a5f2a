"""The parallelogram as virtual springs: stiffness, critical loads for each place of the spring, and curves."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from math import radians
from typing import Literal

import numpy as np

from meshes.solid import Floats
from pipeline.validation.stages.subject import Sized
from vjm.branch import buckled_path
from vjm.closed_forms import in_plane_critical, out_of_plane_cantilever
from vjm.critical import CriticalLoad, critical_load, drive
from vjm.mechanisms.parallelogram import Parallelogram
from vjm.stiffness import closed_form, in_bar_frame, rank, unloaded_stiffness

Place = Literal["tip", "middle", "base", "distributed"]
LUMPED: tuple[Literal["tip", "middle", "base"], ...] = ("tip", "middle", "base")
PLACES: tuple[Place, ...] = (*LUMPED, "distributed")


@dataclass(frozen=True, eq=False)
class SpringLinkage:
    """The parallelogram of a case: springs of the bars lumped at one place, or distributed with geometric stiffness."""

    case: Sized
    stiffness: Floats
    q_deg: float
    place: Place = "tip"

    @cached_property
    def mechanism(self) -> Parallelogram:
        size = self.case.linkage
        place = "tip" if self.place == "distributed" else self.place
        lumped = Parallelogram(
            size.length_mm, size.width_mm, self.stiffness, radians(self.q_deg), spring_at=place
        )
        return lumped.refined() if self.place == "distributed" else lumped

    @property
    def closed_form(self) -> Floats:
        """Eq. 11, bar frame."""
        return closed_form(self.stiffness, self.case.linkage.width_mm, radians(self.q_deg))

    @property
    def eliminated(self) -> Floats:
        """Eq. 10 without load, bar frame."""
        return unloaded_stiffness(self.mechanism, radians(self.q_deg))

    @property
    def rank(self) -> int:
        return int(rank(self.eliminated, self.case.linkage.length_mm))

    @cached_property
    def _searched(self) -> dict[tuple[tuple[str, ...], bool], CriticalLoad]:
        return {}

    def critical(self, held: Sequence[str], sign: int) -> CriticalLoad:
        """First loss of stability, driven along x; searched for once."""
        key = (tuple(held), sign < 0)
        if key not in self._searched:
            self._searched[key] = critical_load(self.mechanism, held, -1 if sign < 0 else 1)
        return self._searched[key]

    def formula(self, held: Sequence[str], sign: int) -> float | None:
        """The closed form of that critical load where there is one; compression negative."""
        if self.place == "distributed":
            return None
        if sign < 0 and "y" not in held and "rz" not in held:
            return out_of_plane_cantilever(self.mechanism) if self.q_deg == 0.0 else None
        loads = in_plane_critical(self.mechanism)
        return loads.compression if sign < 0 else loads.tension

    def curve(self, held: Sequence[str], x: Floats) -> Floats:
        """Fx on the straight path at platform displacements `x`, N; NaN where no equilibrium was found."""
        loads, state = [], None
        for value in x:
            following = drive(self.mechanism, float(value), ["x", *held], state)
            state = following if following.converged else state
            loads.append(float(following.load[0]) if following.converged else float("nan"))
        return np.array(loads)

    def buckled(self, critical: CriticalLoad, x: Floats) -> tuple[Floats, Floats]:
        """x and Fx on the branch past a critical load, where it was reached."""
        states = buckled_path(critical, list(x))
        good = np.asarray(states.converged)
        return x[good], np.asarray(states.load)[good, 0]


SpringSet = dict[tuple[float, Place], SpringLinkage]


def spring_set(case: Sized, stiffness: Floats) -> SpringSet:
    """Springs by K_b (6, 6) at every place, for every angle of the case; what they search for they keep."""
    return {
        (q, place): SpringLinkage(case, stiffness, q, place)
        for q in case.linkage.angles_deg
        for place in PLACES
    }


def linear_slope(stiffness: Floats, q_deg: float, held: Sequence[str]) -> float:
    """LIN: dFx/dx from a bar-frame K_p (6, 6) with `held` held and the other coordinates free, N/mm."""
    base = in_bar_frame(stiffness, -radians(q_deg))
    names = ["x", "y", "z", "rx", "ry", "rz"]
    free = [i for i, name in enumerate(names) if name != "x" and name not in held]
    relaxed = base[0, 0]
    if free:
        # The pseudo-inverse leaves out directions that take no force at all.
        relaxed -= base[0, free] @ np.linalg.pinv(base[np.ix_(free, free)], rcond=1e-9) @ base[free, 0]
    return float(relaxed)
