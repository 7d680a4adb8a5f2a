"""K_p of the linkage by every model side by side."""

from collections.abc import Sequence
from math import radians

import numpy as np

from fem.convergence import SAFETY
from meshes.solid import Floats
from pipeline.validation.case import Case
from pipeline.validation.entries import rows
from pipeline.validation.result import Bar, Matrix, Parallelogram
from pipeline.validation.stages.linkage import SolidStiffness
from pipeline.validation.stages.springs import SpringLinkage
from pipeline.validation.stages.subject import Sized
from vjm.stiffness import in_bar_frame, singular_values


def stiffness_records(case: Case, bar: Bar, solids: Sequence[SolidStiffness]) -> list[Parallelogram]:
    """K_p at every angle by closed form, VJM, solid finite elements and the paper, in the bar frame."""
    stiffness, limit = np.array(bar.stiffness), np.array(bar.convergence.extrapolated)
    records = []
    for solid in solids:
        paper = None
        if case.paper and case.paper.half_linkage_stiffness and case.paper.linkage_angle_deg == solid.q_deg:
            paper = rows(2.0 * np.array(case.paper.half_linkage_stiffness))
        records.append(stiffness_record(case, stiffness, limit, solid, paper))
    return records


def stiffness_record(
    case: Sized, stiffness: Floats, limit: Floats, solid: SolidStiffness, paper: Matrix | None = None
) -> Parallelogram:
    """K_p at one angle; `stiffness` (6, 6) is K_b of the solid's mesh, `limit` that without mesh error."""
    springs = SpringLinkage(case, stiffness, solid.q_deg)
    closed = springs.closed_form
    fea = in_bar_frame(np.array(solid.matrix), radians(solid.q_deg))
    filled = np.abs(closed) > 0.0
    return Parallelogram(
        q_deg=solid.q_deg,
        closed_form=rows(closed),
        vjm=rows(springs.eliminated),
        fea=rows(fea),
        paper=paper,
        doubled_bar=rows(2.0 * stiffness),
        rank=int(springs.rank),
        singular_values_fea=[float(v) for v in singular_values(fea, case.linkage.length_mm)],
        frame="bar",
        worst_fea_deviation=float(np.max(np.abs(fea[filled] / closed[filled] - 1.0))),
        band=rows(mesh_error(closed, SpringLinkage(case, limit, solid.q_deg).closed_form)),
    )


def mesh_error(closed: Floats, limit: Floats) -> Floats:
    """Relative band of every entry of K_p (6, 6): Eq. 11 with K_b of the working mesh against that without mesh error.

    The solid linkage meets Eq. 11 with its own K_b to rounding, so its mesh error is that of K_b.
    """
    filled = np.abs(limit) > 0.0
    return np.where(filled, SAFETY * np.abs(closed / np.where(filled, limit, 1.0) - 1.0), 0.0)
