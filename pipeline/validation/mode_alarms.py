"""Alarms about buckling modes: without a formula of their shape, without their twin, or far from either."""

from collections.abc import Sequence

import numpy as np

from pipeline.validation import bands
from pipeline.validation.entries import ENTRIES
from pipeline.validation.quantities import force
from pipeline.validation.result import Bar, Buckling

TWO_PLANES = ("free", "guided", "clamped")
"""Supports that hold a bar alike in both planes; pinned about y it is clamped about z."""


def mode_alarms(bar: Bar, records: Sequence[Buckling]) -> list[str]:
    """A sentence for each kind of alarm about the modes of the bar; none if all is as it has to be."""
    solid = [r for r in records if r.model == "solid"]
    found = [*unmatched(solid), *missing(records), *deviating(solid), *mesh_errors(solid)]
    return [*found, *without_twin(solid)] if bends_alike(bar) else found


def called(record: Buckling) -> str:
    """A mode in words."""
    return f"{record.supports}, mode {record.mode} in {record.plane}, {force(record.load_N)}"


def unmatched(solid: Sequence[Buckling]) -> list[str]:
    """Modes whose shape is that of no formula."""
    alone = [r for r in solid if r.mac is not None and r.formula_N is None]
    if not alone:
        return []
    worst = min(alone, key=lambda r: r.mac or 0.0)
    nearest = ""
    if worst.nearest_N is not None:
        nearest = (
            f"; nearest is the formula {worst.nearest}, {force(worst.nearest_N)} "
            f"({100 * (worst.load_N / worst.nearest_N - 1.0):+.0f} %), MAC {worst.mac:.2f}"
        )
    return [
        f"Buckling of the bar: {len(alone)} of {len(solid)} modes of the solid have the shape of no formula (MAC below "
        f"{bands.SHAPE.text}): {called(worst)}{nearest}. Their loads are compared with nothing."
    ]


def missing(records: Sequence[Buckling]) -> list[str]:
    """Formulas below the highest mode of the solid whose shape no mode of the solid has."""
    absent = [r for r in records if r.missing]
    if not absent:
        return []
    first = min(absent, key=lambda r: r.load_N)
    return [
        f"Buckling of the bar: {len(absent)} modes that the formulas have below the highest mode in common were not "
        f"found in the solid; the lowest: {first.supports} tip, formula {first.formula}, {force(first.load_N)}."
    ]


def deviating(solid: Sequence[Buckling]) -> list[str]:
    """Loads of solid and formula of the same shape that are too far apart."""
    compared = [r for r in solid if r.deviation is not None]
    beyond = [r for r in compared if abs(r.deviation or 0.0) > bands.MODE.value]
    if not beyond:
        return []
    worst = max(beyond, key=lambda r: abs(r.deviation or 0.0))
    error = "not known" if worst.band is None else f"estimated as {100 * worst.band:.2g} %"
    return [
        f"Buckling of the bar, solid against formula: {called(worst)}, {100 * (worst.deviation or 0.0):+.3g} %; the "
        f"stated band is {bands.MODE.text}. {len(beyond)} of {len(compared)} modes are beyond it. The mesh error of "
        f"that mode is {error}."
    ]


def mesh_errors(solid: Sequence[Buckling]) -> list[str]:
    """Modes that the mesh does not resolve."""
    lost = [r for r in solid if r.mesh_mac is not None and r.band is None]
    found = []
    if lost:
        worst = min(lost, key=lambda r: r.mesh_mac or 0.0)
        found.append(
            f"Mesh error of the bar's critical loads: {len(lost)} of {len(solid)} modes have another shape on a second "
            f"mesh (MAC below {bands.SHAPE.text}): {called(worst)}, MAC {worst.mesh_mac:.2f}. Choose a "
            f"smaller mesh.size_mm."
        )
    coarse = [r for r in solid if r.band is not None and r.band > allowed(r)]
    if coarse:
        worst = max(coarse, key=lambda r: r.band or 0.0)
        found.append(
            f"Mesh error of the bar's critical loads: {called(worst)}, ±{100 * (worst.band or 0.0):.2g} %; the stated "
            f"bands are {bands.MESH.text} for first modes and {bands.HIGH_MESH.text} for higher ones. {len(coarse)} of "
            f"{len(solid)} modes are beyond them. Choose a smaller mesh.size_mm, or run without --coarse."
        )
    return found


def allowed(record: Buckling) -> float:
    """The mesh error that a mode may have."""
    return (bands.MESH if record.mode == 1 else bands.HIGH_MESH).value


def bends_alike(bar: Bar) -> bool:
    """Whether a bar bends alike in both planes, by its K_b: then its modes come in pairs."""
    k = np.array(bar.stiffness)
    pairs = (("K22", "K33"), ("K66", "K55"))
    return all(abs(k[ENTRIES[a]] / k[ENTRIES[b]] - 1.0) < bands.ALIKE.value for a, b in pairs)


def without_twin(solid: Sequence[Buckling]) -> list[str]:
    """Bending modes of a bar that bends alike in both planes without their twin in the other plane."""
    alone = [r for supports in TWO_PLANES for r in single(solid, supports)]
    if not alone:
        return []
    return [
        f"Buckling of the bar: its section bends alike in both planes, so that its modes come in pairs; {len(alone)} "
        f"have no twin within {bands.TWIN.text}: {called(alone[0])}."
    ]


def single(solid: Sequence[Buckling], supports: str) -> list[Buckling]:
    """Modes without a twin; that of the highest may be the first one that was not computed."""
    mine = [r for r in solid if r.supports == supports]
    planes = {plane: [r for r in mine if r.plane == plane] for plane in ("xy", "xz")}
    highest = max((r.load_N for r in mine), default=0.0)
    found = []
    for plane, other in (("xy", "xz"), ("xz", "xy")):
        for number, mode in enumerate(planes[plane]):
            twin = planes[other][number] if number < len(planes[other]) else None
            near = twin is not None and abs(twin.load_N / mode.load_N - 1.0) <= bands.TWIN.value
            last = twin is None and mode.load_N >= highest * (1.0 - bands.TWIN.value)
            if not near and not last:
                found.append(mode)
    return found
