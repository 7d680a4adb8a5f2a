"""Where the material yields: stresses of straight and of bent bars beside the yield stress of the case.

All models are elastic. A load or travel at which the most stressed fibre of a bar is beyond the yield stress is marked:
the real bar does not carry it. A straight bar has N/A. A bar that buckled, with the slope w' = a sin kx of its lowest
mode, has shortened by its bending by ½∫w'² dx = a² L/4; its largest curvature is a k, whatever holds its ends, and
k² = N/EI.
Source: S. P. Timoshenko, J. M. Gere, Theory of Elastic Stability, 2nd ed., McGraw-Hill 1961, 1.1 (shortening by
bending), 2.1 (shapes), 4.1 (elastic buckling ends at the yield stress).
"""

from collections.abc import Sequence
from dataclasses import dataclass
from math import cos, radians
from typing import TypeVar

import numpy as np

from meshes.solid import Floats
from pipeline.validation.result import Buckling, Critical, Curve, Validity
from pipeline.validation.stages.specimen import Specimen

R = TypeVar("R", Buckling, Critical, Validity)
Planes = dict[tuple[object, ...], str]
"""The plane in which the lowest mode of a linkage bends its bars, by (q_deg, *held)."""
# The solid's Saint Venant-Kirchhoff law softens by 3/2 of the strain: no shortening by bending.
SOFTENING = {"fea": 1.5}


@dataclass(frozen=True)
class Yielding:
    """Of one bar: yield stress `limit` MPa, smallest `area` mm², `length` mm, `modulus` E MPa, and by plane of bending
    the second moment mm⁴ and the distance of the outer fibre mm."""

    limit: float
    area: float
    length: float
    modulus: float
    moment: dict[str, float]
    fibre: dict[str, float]

    def straight(self, load: float, q_deg: float | None = None) -> float:
        """Stress MPa under a load N: of one bar, or of a linkage of two bars turned by `q_deg`."""
        return abs(load) / self.area / (1.0 if q_deg is None else 2.0 * cos(radians(q_deg)))

    def along(self, curve: Curve, plane: str | None) -> Floats:
        """Stress (n,) MPa of the most stressed fibre at the points of a curve; `plane` of its bending, if it bends."""
        x, load = np.abs(np.array(curve.x_mm)), np.abs(np.array(curve.fx_N))
        turn = cos(radians(curve.q_deg))
        stress = load / (2.0 * self.area * turn)
        started = np.flatnonzero((x > 0.0) & (load > 0.0))
        if plane not in self.moment or not len(started):
            return stress
        straight = load * x[started[0]] / load[started[0]]
        straight = straight * (1.0 + SOFTENING.get(curve.model, 0.0) * straight * turn / self.length)
        shortening = np.maximum(x - straight, 0.0) * turn
        return stress + self.bending(shortening, load / (2.0 * turn), plane)

    def bending(self, shortening: Floats, load: Floats, plane: str) -> Floats:
        """Stress (n,) MPa of a bar that bending in a plane shortens by so much, (n,) mm, under its own load (n,) N."""
        slope = 2.0 * np.sqrt(shortening / self.length)
        waves = np.sqrt(load / (self.modulus * self.moment[plane]))
        return np.asarray(self.modulus * self.fibre[plane] * waves * slope)


def yielding_of(s: Specimen, limit: float | None) -> Yielding | None:
    """The bar of a case with this yield stress, MPa; None without one."""
    if limit is None:
        return None
    area = s.constants.area
    if s.bar.lug is not None:
        area = min(area, s.bar.lug.width * s.bar.lug.height)
    width, height = s.bar.section.size
    return Yielding(
        limit,
        area,
        s.bar.length,
        s.material.E,
        {"xy": s.constants.Iz, "xz": s.constants.Iy},
        {"xy": width / 2.0, "xz": height / 2.0},
    )


def marked_buckling(records: Sequence[Buckling], bar: Yielding | None) -> list[Buckling]:
    """The bar's critical loads with their stress."""
    return [r if bar is None else _marked(r, bar.straight(r.load_N), bar) for r in records]


def marked_critical(records: Sequence[Critical], bar: Yielding | None) -> list[Critical]:
    """The linkage's critical loads with their stress."""
    return [
        r if bar is None or r.load_N is None else _marked(r, bar.straight(r.load_N, r.q_deg), bar)
        for r in records
    ]


def marked_curves(curves: Sequence[Curve], planes: Planes, bar: Yielding | None) -> list[Curve]:
    """Curves with the travel and load at which they reach the yield stress."""
    return [c if bar is None else _yielding_curve(c, _plane(c, planes), bar) for c in curves]


def marked_validity(
    records: Sequence[Validity],
    curves: Sequence[Curve],
    planes: Planes,
    bar: Yielding | None,
) -> list[Validity]:
    """Limits of the linear model with their stress: of the solid with its bending, of springs that of straight bars."""
    if bar is None:
        return list(records)
    found = []
    for r in records:
        if r.load_N is None:
            found.append(r)
            continue
        stress = bar.straight(r.load_N, r.q_deg)
        for c in curves:
            solid = (c.model, c.branch) == ("fea", "buckled") and r.model == "solid FE"
            if solid and (c.q_deg, c.held) == (r.q_deg, r.held):
                stress = _at_load(np.abs(np.array(c.fx_N)), bar.along(c, _plane(c, planes)), r.load_N)
        found.append(_marked(r, stress, bar))
    return found


def _marked(record: R, stress: float, bar: Yielding) -> R:
    return record.model_copy(update={"stress_MPa": stress, "beyond_yield": stress > bar.limit})


def _plane(curve: Curve, planes: Planes) -> str | None:
    """The plane in which the bars of a curve bend; None of straight ones, and of springs lumped at one place."""
    bends = curve.branch == "buckled" and curve.spring_at == "distributed"
    return planes.get((curve.q_deg, *curve.held)) if bends else None


def _yielding_curve(curve: Curve, plane: str | None, bar: Yielding) -> Curve:
    stress = bar.along(curve, plane)
    update: dict[str, float] = {"largest_stress_MPa": float(stress.max(initial=0.0))}
    past = np.flatnonzero(stress > bar.limit)
    if len(past):
        last = int(past[0])
        first = max(last - 1, 0)
        rise = stress[last] - stress[first]
        share = (bar.limit - stress[first]) / rise if rise > 0.0 else 0.0
        for name, values in (("yield_x_mm", curve.x_mm), ("yield_fx_N", curve.fx_N)):
            update[name] = float(values[first] + share * (values[last] - values[first]))
    return curve.model_copy(update=update)


def _at_load(load: Floats, stress: Floats, wanted: float) -> float:
    """Stress where a path reaches a load for the first time."""
    past = np.flatnonzero(load >= wanted)
    if not len(past) or past[0] == 0:
        return float(stress[int(np.argmax(load))])
    last = int(past[0])
    return float(np.interp(wanted, load[last - 1 : last + 1], stress[last - 1 : last + 1]))
