"""Stress of a bar under unit loads at its tip, and the loads at which it first yields, from its meshes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from fem.linear import LinearModel
from fem.von_mises import near_ends, unit_stress
from pipeline.bar.stress_record import LOADS, Peak, Stresses, UnitLoad
from pipeline.validation.quantities import force
from pipeline.validation.result import Buckling

SHARP = 0.1
"""Change from one mesh to the next beyond which a peak is said to grow with the mesh: a smooth one changes by some per
cent, that at a sharp edge by a constant factor on every mesh."""
REGION = "regions without a yield stress are left out: von Mises' criterion does not hold for them"


def stresses(models: Sequence[LinearModel], limits: Mapping[int, float], left_out: Sequence[int]) -> Stresses:
    """Of single clamped bars, coarse to fine. limits: yield stress MPa by number of the region; left_out: regions that
    von Mises' criterion does not describe.

    SolveError if one cannot be solved, ValueError where every region is left out.
    """
    found = [_peaks(model, limits, left_out) for model in models[-2:]]
    (fine, reach), coarse = found[-1], found[0][0] if len(found) > 1 else None
    loads = []
    for k, name in enumerate(LOADS):
        body, ends = (_changed(fine[k][i], None if coarse is None else coarse[k][i]) for i in (0, 1))
        loads.append(UnitLoad(load=name, body=body, ends=ends))
    return Stresses(loads=loads, ends_reach_mm=reach, yield_MPa=min(limits.values(), default=None))


def _peaks(
    model: LinearModel, limits: Mapping[int, float], left_out: Sequence[int]
) -> tuple[list[tuple[Peak, Peak]], dict[str, float]]:
    """For each load the peak away from the ends and the one near them, and how far the ends reach."""
    it = unit_stress(model)
    kept = ~np.isin(it.region, list(left_out))
    if not kept.any():
        raise ValueError(f"no region is left for a stress; {REGION}")
    near, reach = near_ends(model.linkage.members[0].space.mesh, it.at)
    limit = np.array([limits.get(int(r), np.inf) for r in range(int(it.region.max()) + 1)])[it.region]
    peaks = []
    for values in it.values:
        # Where limits are known the point that yields first, else the most stressed one.
        weight = values / limit if np.isfinite(limit[kept]).any() else values
        pair = []
        for where in (kept & ~near, kept & near):
            places = np.flatnonzero(where)
            if not len(places):
                places = np.flatnonzero(kept)
            worst = places[int(np.argmax(weight[places]))]
            bound = limit[worst]
            pair.append(
                Peak(
                    stress=float(values[worst]),
                    at_mm=[float(x) for x in it.at[worst]],
                    first_yield=float(bound / values[worst]) if np.isfinite(bound) else None,
                )
            )
        peaks.append((pair[0], pair[1]))
    return peaks, reach


def _changed(fine: Peak, coarse: Peak | None) -> Peak:
    return fine if coarse is None else fine.model_copy(update={"change": fine.stress / coarse.stress - 1.0})


def stress_sentences(it: Stresses | None) -> list[str]:
    """The axial load of first yield, away from the ends and at them; nothing where no yield stress is known."""
    axial = None if it is None else it.of("Fx")
    if axial is None or axial.body.first_yield is None:
        return []
    x = axial.body.at_mm[0]
    said = [
        f"An axial force of {force(axial.body.first_yield)} brings the first fibre away from the ends (x = {x:.4g} mm) "
        "to its yield stress (von Mises, linear elastic, the bar straight)."
    ]
    ends = axial.ends
    if ends.first_yield is not None and ends.first_yield < axial.body.first_yield:
        grows = ends.change is not None and abs(ends.change) > SHARP
        said.append(
            f"At its tied ends the bar yields from {force(ends.first_yield)} on"
            + (
                f"; that peak changes by {100 * (ends.change or 0.0):+.0f} % from one mesh to the next, as at a sharp "
                "edge, and says nothing about the real seat."
                if grows
                else "; how load enters there is as the tie has it."
            )
        )
    return said


def marked(records: Sequence[Buckling], it: Stresses | None) -> list[Buckling]:
    """Critical loads of the bar with the stress of the straight bar under them, where there is a yield stress."""
    axial = None if it is None else it.of("Fx").body
    if axial is None or axial.first_yield is None:
        return list(records)
    return [
        r.model_copy(
            update={"stress_MPa": axial.stress * r.load_N, "beyond_yield": r.load_N > axial.first_yield}
        )
        for r in records
    ]
