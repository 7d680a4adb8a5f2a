"""Table 1 of the paper, computed again by virtual springs and by finite elements.

Three numbers are not in the paper: the stiffness of a drive, that of a foot in bending, and the radial give of a
hinge axis. Each is fixed by one VJM cell; all other cells are predicted, those of the finite elements included.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq

from pipeline.manipulator.description import read
from pipeline.manipulator.frame import frame_stiffness
from pipeline.manipulator.linkages import (
    READINGS,
    Relink,
    parallelogram,
    relinked,
    two_fold_bar,
    with_unknowns,
)
from pipeline.manipulator.table_findings import findings
from pipeline.manipulator.table_record import Agreement, Cell, Quantity, ReadingRow, Table1, Unknown
from vjm import paper
from vjm.frames import Array
from vjm.manipulator.measures import principal, rotational, translational
from vjm.manipulator.parts import Manipulator
from vjm.manipulator.posture import postures
from vjm.manipulator.rest import stiffness_at_rest

ISOTROPIC = (0.0, 0.0, 0.0)
POSTURES = (ISOTROPIC, (50.0, -40.0, 60.0), (-60.0, 30.0, 80.0), (90.0, 90.0, -90.0), (-80.0, -80.0, -80.0))
"""Platform points, mm, at which the two models are compared."""

PLAUSIBLE = {"actuator": (1e3, 1e5), "foot": (1e7, 1e11), "axis": (1e-7, 1e-4)}
"""Bounds: a ball screw with its bearings and guide, N/mm; a foot with its guide on 100 mm as flexible as a steel rod
of 6 mm or as stiff as one of 55 mm, N·mm²; a pin in its bearings, mm/N."""

SOURCE = (
    "A. Pashkevich, A. Klimchik, S. Caro, D. Chablat, EUCOMES 2010, Table 1; magnitudes in N/mm and N·mm/rad"
)

Measured = tuple[float, float]
"""K_tran and K_rot, means over the principal directions."""


@dataclass(frozen=True)
class _Fit:
    actuator: float
    foot: float
    axis: float


def table_1(
    manipulator: Manipulator | None = None, points: Sequence[tuple[float, float, float]] = POSTURES
) -> Table1:
    """The record; manipulator: an Orthoglide (default the shipped one). points: where the models are compared."""
    drawn = read("orthoglide").manipulator if manipulator is None else manipulator
    fit = _fitted(drawn)
    own = with_unknowns(drawn, fit.actuator, fit.foot)
    rows: dict[str, Relink] = {
        "2x-bar": two_fold_bar(),
        "solid axis": parallelogram(),
        "flexible axis": parallelogram(fit.axis),
    }
    linkages = {name: relinked(own, relink) for name, relink in rows.items()}
    cells = [
        cell for name, whole in linkages.items() for model in MODELS for cell in _cells(name, model, whole)
    ]
    readings = _readings(own)
    return Table1(
        unknowns=_unknowns(fit),
        cells=cells,
        readings=readings,
        agreement=[_agreement(name, whole, points) for name, whole in linkages.items()],
        findings=findings(cells, readings),
        source=SOURCE,
    )


def vjm_stiffness(manipulator: Manipulator, point: Sequence[float]) -> Array:
    """(6, 6) by virtual springs. ValueError where there is none."""
    found = stiffness_at_rest(manipulator, postures(manipulator, np.asarray(point, dtype=float)))
    if not found.found:
        raise ValueError(str(found.reason))
    return found.total


def fea_stiffness(manipulator: Manipulator, point: Sequence[float]) -> Array:
    """(6, 6) by finite elements. ValueError where there is none."""
    at = postures(manipulator, np.asarray(point, dtype=float))
    if not at.reached:
        raise ValueError(str(at.reason))
    return frame_stiffness(manipulator, at.pose, at.coordinates)


MODELS: dict[str, Callable[[Manipulator, Sequence[float]], Array]] = {
    "vjm": vjm_stiffness,
    "fea": fea_stiffness,
}


def measured(stiffness: Array) -> Measured:
    """K_tran, K_rot of a 6x6."""
    return float(principal(translational(stiffness)).mean()), float(principal(rotational(stiffness)).mean())


def _fitted(drawn: Manipulator) -> _Fit:
    """Drive and foot by the parallelogram with solid axes, which they decide one each; then the axis."""
    tran, rot = paper.TABLE_1["solid axis", "vjm"]
    rigid = PLAUSIBLE["actuator"][1]

    def solid(actuator: float, foot: float, axis: float = 0.0) -> Measured:
        whole = relinked(with_unknowns(drawn, actuator, foot), parallelogram(axis))
        return measured(vjm_stiffness(whole, ISOTROPIC))

    foot = _root(lambda x: solid(rigid, x)[1] - rot, *PLAUSIBLE["foot"])
    actuator = _root(lambda x: solid(x, foot)[0] - tran, *PLAUSIBLE["actuator"])
    soft = paper.TABLE_1["flexible axis", "vjm"][0]
    axis = _root(lambda x: solid(actuator, foot, x)[0] - soft, *PLAUSIBLE["axis"])
    return _Fit(actuator, foot, axis)


def _root(missed: Callable[[float], float], low: float, high: float) -> float:
    """Where the cell is met within the bounds, on a logarithmic scale; else the bound that comes nearer."""
    ends = (missed(low), missed(high))
    if ends[0] * ends[1] > 0.0:
        return low if abs(ends[0]) < abs(ends[1]) else high
    return float(np.exp(brentq(lambda x: missed(float(np.exp(x))), np.log(low), np.log(high), xtol=1e-12)))


def _unknowns(fit: _Fit) -> list[Unknown]:
    rows = [
        ("drive along its axis", "actuator", fit.actuator, "N/mm", "solid axis, VJM, K_tran"),
        ("foot in bending, 100 mm long", "foot", fit.foot, "N·mm²", "solid axis, VJM, K_rot"),
        ("radial give of a hinge axis", "axis", fit.axis, "mm/N", "flexible axis, VJM, K_tran"),
    ]
    out = []
    for name, key, value, unit, cell in rows:
        low, high = PLAUSIBLE[key]
        out.append(
            Unknown(
                name=name,
                value=value,
                unit=unit,
                low=low,
                high=high,
                at_bound=value in (low, high),
                cell=cell,
            )
        )
    return out


_USED = {("solid axis", "K_tran"), ("solid axis", "K_rot"), ("flexible axis", "K_tran")}


def _cells(linkage: str, model: str, whole: Manipulator) -> list[Cell]:
    printed = paper.TABLE_1.get((linkage, model))
    quantities: tuple[Quantity, Quantity] = ("K_tran", "K_rot")
    out = []
    for k, (quantity, value) in enumerate(
        zip(quantities, measured(MODELS[model](whole, ISOTROPIC)), strict=True)
    ):
        theirs = None if printed is None else printed[k]
        out.append(
            Cell(
                linkage=linkage,
                model="vjm" if model == "vjm" else "fea",
                quantity=quantity,
                ours=value,
                paper=theirs,
                deviation=None if theirs is None else value / theirs - 1.0,
                fitted=model == "vjm" and (linkage, quantity) in _USED,
            )
        )
    return out


def _readings(own: Manipulator) -> list[ReadingRow]:
    solid = vjm_stiffness(relinked(own, parallelogram()), ISOTROPIC)
    tran, rot = measured(solid)
    held = float(np.trace(solid[:3, :3])) / 3.0
    rows = []
    for reading in READINGS:
        k = vjm_stiffness(relinked(own, reading.relink), ISOTROPIC)
        own_tran, own_rot = measured(k)
        own_held = float(np.trace(k[:3, :3])) / 3.0
        rows.append(
            ReadingRow(
                reading=reading.name,
                moves=reading.moves,
                K_tran=own_tran,
                K_tran_held=own_held,
                K_rot=own_rot,
                K_tran_over_parallelogram=own_tran / tran,
                K_tran_held_over_parallelogram=own_held / held,
                parallelogram_over_K_rot=rot / own_rot,
            )
        )
    return rows


def _agreement(name: str, whole: Manipulator, points: Sequence[tuple[float, float, float]]) -> Agreement:
    worst = np.zeros(2)
    for point in points:
        ours, theirs = vjm_stiffness(whole, point), fea_stiffness(whole, point)
        for k, block in enumerate((translational, rotational)):
            gap = np.abs(principal(block(ours)) / principal(block(theirs)) - 1.0)
            worst[k] = max(worst[k], float(gap.max()))
    return Agreement(linkage=name, postures=len(points), K_tran=worst[0], K_rot=worst[1])
