"""A linkage by its drawing, before anything is measured: stiffness at rest, critical load."""

from __future__ import annotations

import json
from collections.abc import Collection
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.linalg import LinAlgError
from numpy.typing import NDArray
from rich.console import RenderableType

from pipeline.campaign import Rig
from pipeline.campaign.names import COORDINATES
from pipeline.campaign.rig import Solvable
from pipeline.errors import InputError
from pipeline.face.bars import DISPLACEMENTS, LOADS, clean, matrix_frame, matrix_table
from pipeline.face.shown import Drawn
from pipeline.inference.model import Model
from pipeline.terminal import one_line
from reports.quantities import short
from vjm.critical import critical_load
from vjm.effects.bar_geometric_nonlinearity import BarGeometricNonlinearity
from vjm.mechanisms.parallelogram import Parallelogram
from vjm.stiffness import rank, unloaded_stiffness

if TYPE_CHECKING:
    from pandas import DataFrame

    from reports.first_screen.drawn import Picture

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False, repr=False)
class Linkage(Drawn):
    """A rig at rest. rig: by its drawing. q_deg: angle of the bars. stiffness: (6, 6) at the platform point, base
    frame; x y z rx ry rz to Fx Fy Fz Mx My Mz, N, mm, rad."""

    rig: Rig
    q_deg: float
    stiffness: Array

    @property
    def headline(self) -> str:
        free = 6 - int(rank(self.stiffness, self.rig.length))
        size = f"{self.rig.kind} of {short(self.rig.length)} mm at q = {self.q_deg:g}°"
        moves = f"{free} free motion{'' if free == 1 else 's'}"
        along = short(float(self.stiffness[0, 0]), 4)
        return one_line(f"{size}: {along} N/mm along x, {moves}", f"{size}: {moves}")

    def tables(self) -> tuple[RenderableType, ...]:
        return (matrix_table(self.stiffness, self.rig.length),)

    def critical_load(self, held: Collection[str] = ("z", "rx", "ry", "rz"), tension: bool = False) -> float:
        """N along x, negative in compression, at which the linkage turns unstable; NaN where none is met.

        held: coordinates that are held beside x, which is driven: y, z, rx, ry, rz. tension: driven the other way.
        Bars are in segments, which knows the axial force in them (`bar_geometric_nonlinearity`). InputError for another
        coordinate; RuntimeError where no path is found.
        """
        unknown = sorted(set(held) - set(COORDINATES[1:]))
        if unknown:
            raise InputError(f"held has {', '.join(unknown)}, allowed are {', '.join(COORDINATES[1:])}")
        model = Model().with_effects([BarGeometricNonlinearity()])
        found = critical_load(_turned(self.rig, model, self.q_deg), tuple(held), 1 if tension else -1)
        return float(found.load) if found.found else float("nan")

    def plot(self) -> Picture:
        """Size of the entries; rows are loads, columns displacements."""
        from reports.first_screen.figures import matrix

        return matrix(clean(self.stiffness, self.rig.length).tolist(), LOADS, DISPLACEMENTS, self.headline)

    def to_frame(self) -> DataFrame:
        """6 x 6: rows the loads on the platform, columns its displacements; N, mm, rad."""
        return matrix_frame(self.stiffness)

    def json(self) -> str:
        record = {
            "kind": self.rig.kind,
            "q_deg": self.q_deg,
            "units": "N, mm, rad",
            "K": self.stiffness.tolist(),
        }
        return json.dumps(record, indent=1, ensure_ascii=False) + "\n"


def linkage(rig: Rig, q_deg: float = 0.0) -> Linkage:
    """The stiffness at rest of a rig by its drawing: plain virtual springs (Eqs. 1 to 10), nothing measured.

    rig: of `rigs`. q_deg: angle of the bars of a parallelogram, between -90 and 90; other rigs have none. InputError
    for an angle that the rig cannot have; RuntimeError where it has no stiffness.
    """
    if not isinstance(rig, Rig):
        raise InputError(
            f"rig is {rig!r}, allowed is one of parastiff.rigs, as parastiff.rigs.bar(length_mm=...)"
        )
    if q_deg and not isinstance(rig.mechanism(()), Parallelogram):
        raise InputError(f"q_deg is {q_deg:g}, allowed is 0: a {rig.kind} has no angle of bars")
    if not abs(q_deg) < 90.0:
        raise InputError(f"q_deg is {q_deg:g}, allowed are degrees between -90 and 90")
    try:
        found = unloaded_stiffness(_turned(rig, Model(), q_deg))
    except LinAlgError as error:
        raise RuntimeError(f"the {rig.kind} has no stiffness at rest: it is a mechanism there") from error
    return Linkage(rig, q_deg, np.asarray(0.5 * (found + found.T)))


def _turned(rig: Rig, model: Model, q_deg: float) -> Solvable:
    it = model.mechanism(rig, ())
    return replace(it, q=float(np.radians(q_deg))) if isinstance(it, Parallelogram) else it
