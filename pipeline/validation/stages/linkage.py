"""The parallelogram as finite elements: stiffness, linear buckling and load paths for each way of holding it."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import radians

import numpy as np
from pydantic import BaseModel

from fem.buckling import Mode, buckling
from fem.end_states import EndStates
from fem.factor import Factor
from fem.linear import LinearModel
from fem.linkage import parallelogram
from fem.path import follow, with_imperfection
from fem.solvers import automatic
from fem.space import Space
from pipeline.progress import Stage
from pipeline.validation.entries import rows
from pipeline.validation.result import Matrix
from pipeline.validation.stages.subject import Sized, SolidBar

HELD_SETS: tuple[tuple[str, ...], ...] = (
    ("y", "z", "rx", "ry", "rz"),
    ("z", "rx", "ry", "rz"),
    ("z",),
)
# Enough for both planes: two equal bars give every mode of a bar twice, sideways modes come first.
LOWEST = 5
# Bow of both bars in the shape of the lowest mode: their length over this.
LENGTH_TO_BOW = 30_000
BOW = f"a bow of L/{LENGTH_TO_BOW}"
# Travel to the tension side in units of that at the critical load in compression: past where springs at the bars' tips
# turn unstable, fully held.
TENSION = (0.2, 0.4)


class SolidBuckling(BaseModel):
    """Linear buckling of the linkage at one angle and one way of holding it."""

    q_deg: float
    held: list[str]
    loads: list[float]
    planes: list[str]
    travel: float


class SolidPath(BaseModel):
    """A load path of the linkage, compression from no load on, and the tension side from no load on.

    `tangent` is the slope of the same mesh at no load, N/mm; `critical` the linear critical load of that mesh, N, and
    `plane` that of its mode.
    """

    q_deg: float
    held: list[str]
    x: list[float]
    fx: list[float]
    tangent: float
    critical: float
    plane: str
    failure: str
    tension_x: list[float]
    tension_fx: list[float]


class SolidStiffness(BaseModel):
    """Cartesian stiffness at one angle, base frame."""

    q_deg: float
    matrix: Matrix


def solid_linkage(case: Sized, s: SolidBar, space: Space, q_deg: float) -> LinearModel:
    """The parallelogram of two solid bars at an angle."""
    size = case.linkage
    linkage = parallelogram(space, size.length_mm, size.width_mm, radians(q_deg))
    return LinearModel(linkage, s.material, s.solver_of(linkage) if space is s.space else automatic)


def solid_stiffness(case: Sized, s: SolidBar) -> list[SolidStiffness]:
    """K_p of the solid linkage at every angle, base frame."""
    found = []
    for q in case.linkage.angles_deg:
        model = solid_linkage(case, s, s.space, q)
        found.append(SolidStiffness(q_deg=q, matrix=rows(model.stiffness)))
    return found


def solid_buckling(case: Sized, s: SolidBar, stage: Stage) -> list[SolidBuckling]:
    """Lowest critical loads of the solid linkage, pushed along -x, for every angle and way of holding it."""
    found = []
    # At every angle the same bars.
    states = EndStates()
    for q in case.linkage.angles_deg:
        model = replace(solid_linkage(case, s, s.space, q), states=states)
        for held in HELD_SETS:
            stage.say(f"q = {q:g}°, {' '.join(held)} held")
            found.append(buckled(model, q, held))
    return found


def buckled(model: LinearModel, q_deg: float, held: Sequence[str]) -> SolidBuckling:
    """Lowest critical loads of one linkage, and the travel at the first, from one factorisation."""
    factor = model.factor(model.reduction.others(["x", *held]))
    modes = buckling(model, held, LOWEST, factor=factor)
    return SolidBuckling(
        q_deg=q_deg,
        held=list(held),
        loads=[m.load for m in modes],
        planes=[m.plane for m in modes],
        travel=modes[0].load / slope(model, held, factor),
    )


def slope(model: LinearModel, held: Sequence[str], factor: Factor | None = None) -> float:
    """dFx/dx at no load with `held` held and the rest free, N/mm; `factor` as in `LinearModel.motions`."""
    motion = model.motions(["x"], held, factor)[:, 0]
    row = int(model.reduction.platform(["x"])[0])
    return float((model.reduced[[row]] @ motion)[0])


@dataclass(frozen=True)
class Bowed:
    """The linkage of slightly bowed bars on the mesh of load paths: critical load N, slope N/mm without load, and the
    plane of the bow."""

    model: LinearModel
    held: tuple[str, ...]
    critical: float
    tangent: float
    plane: str

    @property
    def travel(self) -> float:
        """Travel of the platform at the linear critical load, mm."""
        return self.critical / self.tangent


def bowed_linkage(case: Sized, s: SolidBar, q: float, held: tuple[str, ...]) -> Bowed:
    """Both bars with the bow, in the shape of the lowest mode."""
    straight = solid_linkage(case, s, s.path_space, q)
    first: Mode = buckling(straight, held, 1)[0]
    bent = with_imperfection(straight.linkage, first.displacements, s.bar.length / LENGTH_TO_BOW)
    model = LinearModel(bent, s.material)
    return Bowed(model, held, first.load, slope(model, held), first.plane)


def solid_path(case: Sized, s: SolidBar, q: float, held: tuple[str, ...]) -> SolidPath:
    """Compression, through the first critical load, and tension."""
    bowed = bowed_linkage(case, s, q, held)
    path = follow(bowed.model, held, list(-bowed.travel * np.array(s.detail.travel)))
    pulled = follow(bowed.model, held, list(bowed.travel * np.array(TENSION)))
    return SolidPath(
        q_deg=q,
        held=list(held),
        x=[0.0, *path.column("displacement", "x")],
        fx=[0.0, *path.column("wrench", "x")],
        tangent=bowed.tangent,
        critical=bowed.critical,
        plane=bowed.plane,
        failure=path.failure or pulled.failure,
        tension_x=[0.0, *pulled.column("displacement", "x")],
        tension_fx=[0.0, *pulled.column("wrench", "x")],
    )
