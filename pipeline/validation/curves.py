"""Force-deflection curves of every model over the travel of each solid path, and how far LIN is good."""

from collections.abc import Sequence

import numpy as np

from fem.convergence import SAFETY
from meshes.solid import Floats
from pipeline.validation.critical import bar_mode
from pipeline.validation.result import Buckling, Curve, Validity
from pipeline.validation.stages.frame import FrameLinkage, section_of_bar
from pipeline.validation.stages.linkage import BOW, SolidBuckling, SolidPath
from pipeline.validation.stages.springs import PLACES, SpringLinkage, SpringSet, linear_slope
from pipeline.validation.stages.subject import Sized, SolidBar

DEVIATIONS = (0.01, 0.05)
NAME_OF = {
    "tip": "spring at tip",
    "middle": "spring at middle",
    "base": "spring at base",
    "distributed": "distributed",
}
FRAME = "Frame: two-node beams with the solid's K_b and its section's shear, swayed as the solid's bow does"


def curve_records(
    case: Sized,
    s: SolidBar,
    stiffness: Floats,
    every: SpringSet,
    paths: Sequence[SolidPath],
    loads: Sequence[SolidBuckling],
    bars: Sequence[Buckling],
) -> list[Curve]:
    """LIN, solid, frame and springs under the conditions of each solid path, compression and tension; stiffness: K_b
    (6, 6)."""
    records = []
    section = section_of_bar(s, stiffness)
    for path in paths:
        frame = FrameLinkage(case, section, stiffness, path.q_deg, path.held, path.plane)
        springs = {place: every[path.q_deg, place] for place in PLACES}
        slope = linear_slope(springs["tip"].closed_form, path.q_deg, path.held)
        ends = np.array([path.tension_x[-1], 0.0, path.x[-1]])
        records.append(curve(path, "lin", "tip", ends, slope * ends, "LIN: the straight line of Eq. 11"))
        records.extend(solid_curves(path, path_error(path, loads, bars)))
        records.extend(frame_curves(frame, path))
        for place in PLACES:
            records.extend(spring_curves(springs[place], path))
    return records


def curve(
    path: SolidPath,
    model: str,
    spring_at: str,
    x: Sequence[float] | Floats,
    fx: Sequence[float] | Floats,
    note: str,
    critical: Sequence[float] = (),
    buckled: bool = False,
    band: float | None = None,
) -> Curve:
    """A curve of a model under the conditions of a solid path: x mm and fx N, (n,) each."""
    return Curve(
        model=model,
        q_deg=path.q_deg,
        held=path.held,
        spring_at=spring_at,
        branch="buckled" if buckled else "straight",
        x_mm=[float(v) for v in x],
        fx_N=[float(v) for v in fx],
        critical_N=[float(v) for v in critical],
        note=note,
        band=band,
    )


def path_error(path: SolidPath, loads: Sequence[SolidBuckling], bars: Sequence[Buckling]) -> float | None:
    """Signed share by which the critical load of the path's mesh lies above that without mesh error."""
    for solid in loads:
        if (solid.q_deg, solid.held) == (path.q_deg, path.held):
            bar = bar_mode(bars, path.held, solid.planes[0])
            if bar is not None and bar.limit_N is not None:
                return path.critical / (solid.loads[0] * bar.limit_N / bar.load_N) - 1.0
    return None


def solid_curves(path: SolidPath, error: float | None) -> list[Curve]:
    """Compression and tension of the solid."""
    note = f"Solid FE: bars with {BOW} in the shape of the lowest mode"
    if path.failure:
        note = f"Solid FE at q = {path.q_deg:g}°, {' '.join(path.held)} held: {path.failure}"
    band = None if error is None else SAFETY * abs(error)
    pushed = curve(path, "fea", "distributed", path.x, path.fx, note, [-path.critical], True, band)
    return [pushed, curve(path, "fea", "distributed", path.tension_x, path.tension_fx, note)]


def frame_curves(frame: FrameLinkage, path: SolidPath) -> list[Curve]:
    """Compression and tension of the frame at the solid's displacements."""
    records = []
    for x, buckled in ((path.x[1:], True), (path.tension_x[1:], False)):
        reached, force, failure = frame.path(x)
        note = f"Frame at q = {path.q_deg:g}°, {' '.join(path.held)} held: {failure}" if failure else FRAME
        points = ([0.0, *reached], [0.0, *force])
        records.append(curve(path, "frame", "distributed", *points, note, buckled=buckled))
    return records


def spring_curves(springs: SpringLinkage, path: SolidPath) -> list[Curve]:
    """The straight path of springs to both sides, each up to a critical load, and the branch past it in compression."""
    records = []
    for sign, x in ((-1, np.array(path.x)), (1, np.array(path.tension_x))):
        found = springs.critical(path.held, sign) if sign < 0 or springs.place == "tip" else None
        within = found is not None and found.found and sign * found.displacement < sign * x[-1]
        straight = x
        if found is not None and within:
            straight = np.append(x[sign * x <= sign * found.displacement], found.displacement)
        critical = [found.load] if found is not None and found.found and (within or sign < 0) else []
        loads = springs.curve(path.held, straight)
        good = np.isfinite(loads)
        note = "VJM: springs on the straight path; a lumped one at the tip ends where tension upsets it"
        if not good.all():
            note = "VJM: springs; the line ends where no equilibrium was found"
        records.append(curve(path, "vjm", springs.place, straight[good], loads[good], note, critical))
        if found is not None and within and sign < 0:
            past = x[x < found.displacement]
            reached, force = springs.buckled(found, past)
            note = "VJM: the branch past the critical load"
            bent = ([found.displacement, *reached], [found.load, *force])
            records.append(curve(path, "vjm", springs.place, *bent, note, critical, buckled=True))
    return records


def validity_records(curves: Sequence[Curve], paths: Sequence[SolidPath]) -> list[Validity]:
    """Compression at which each model has left its own initial tangent by 1 % and 5 %."""
    records = []
    for path in paths:
        records.extend(departures("solid FE", path, np.array(path.x), np.array(path.fx), path.tangent))
        for place in PLACES:
            parts = [
                c
                for c in curves
                if (c.model, c.spring_at, c.q_deg, c.held) == ("vjm", place, path.q_deg, path.held)
                and c.x_mm[-1] < 0.0
            ]
            x = np.concatenate([c.x_mm for c in parts])
            fx = np.concatenate([c.fx_N for c in parts])
            records.extend(departures(f"VJM, {NAME_OF[place]}", path, x, fx, fx[1] / x[1]))
    return records


def departures(model: str, path: SolidPath, x: Floats, fx: Floats, tangent: float) -> list[Validity]:
    """The load at each deviation from the tangent, N/mm, by interpolation between the points of the path, x mm and
    fx N, (n,) each."""
    gone = np.abs(fx[1:] / (tangent * x[1:]) - 1.0)
    records = []
    for deviation in DEVIATIONS:
        past = np.flatnonzero(gone >= deviation)
        load = None
        if len(past):
            i = int(past[0])
            before = gone[i - 1] if i else 0.0
            share = (deviation - before) / (gone[i] - before)
            load = float(-(fx[i] + share * (fx[i + 1] - fx[i])))
        records.append(
            Validity(model=model, q_deg=path.q_deg, held=path.held, deviation=deviation, load_N=load)
        )
    return records
