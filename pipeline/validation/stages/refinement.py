"""Load paths made finer: steps, elements, segments, meshes; one number of each path at every refinement."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from fem.convergence import SAFETY, extrapolate
from fem.frame.linkages import ELEMENTS
from fem.path import follow
from meshes.solid import Floats
from pipeline.validation.result import Buckling, Refinement
from pipeline.validation.stages.frame import FrameLinkage, section_of_bar
from pipeline.validation.stages.linkage import HELD_SETS, SolidBuckling, SolidPath, bowed_linkage
from pipeline.validation.stages.springs import SpringLinkage
from pipeline.validation.stages.subject import Sized, SolidBar
from vjm.critical import critical_load
from vjm.refined import SEGMENTS, Refined

FRAME_STEPS = (10, 20, 40)
ELEMENT_COUNTS = (4, 8, 16, 32)
SEGMENT_COUNTS = (3, 6, 12)
# End of the path whose steps are counted, in units of the travel at the critical load.
STEPPED_TO = 1.4
GUIDED = HELD_SETS[1]


def solid_end(case: Sized, s: SolidBar, steps: int) -> float:
    """The solid's load past the critical one, reached in so many steps, N; RuntimeError if it does not arrive."""
    bowed = bowed_linkage(case, s, case.linkage.angles_deg[0], GUIDED)
    values = bowed.travel * STEPPED_TO * np.arange(1, steps + 1) / steps
    path = follow(bowed.model, GUIDED, list(-values))
    if path.failure:
        raise RuntimeError(f"the solid's path in {steps} steps: {path.failure}")
    return float(path.points[-1].wrench[0])


def solid_steps(case: Sized, steps: Sequence[int], ends: Sequence[float]) -> Refinement:
    """The study of these numbers of steps and the loads that were reached."""
    return stepped("solid FE", case.linkage.angles_deg[0], steps, ends)


def stepped(model: str, q: float, steps: Sequence[int], ends: Sequence[float]) -> Refinement:
    """The record of a study of steps: its limit is the finest, its band what all of them differ by."""
    return Refinement(
        model=model,
        quantity=f"Fx at {STEPPED_TO:g} of the critical travel",
        q_deg=q,
        held=list(GUIDED),
        refined="steps",
        sizes=list(steps),
        values=list(ends),
        limit=ends[-1],
        band=float(np.ptp(ends) / abs(ends[-1])),
        used=steps[0],
    )


def frame_steps(frame: FrameLinkage, loads: Sequence[SolidBuckling]) -> Refinement:
    """The frame's load in more and more steps."""
    (travel,) = [b.travel for b in loads if (b.q_deg, tuple(b.held)) == (frame.q_deg, frame.held)]
    ends = []
    for steps in FRAME_STEPS:
        x = -travel * STEPPED_TO * np.arange(1, steps + 1) / steps
        _, force, failure = frame.path(x)
        if failure:
            raise RuntimeError(f"the frame's path in {steps} steps: {failure}")
        ends.append(float(force[-1]))
    return stepped("frame", frame.q_deg, FRAME_STEPS, ends)


def frame_elements(frame: FrameLinkage, path: SolidPath) -> Refinement | None:
    """The frame's load at the end of a solid path for more and more elements; None where it does not arrive."""
    ends = []
    for count in ELEMENT_COUNTS:
        _, force, failure = frame.path(path.x[1:], count)
        if failure:
            return None
        ends.append(float(force[-1]))
    quantity = "Fx at the end of the path"
    return _extrapolated("frame", quantity, path, "elements a bar", ELEMENT_COUNTS, ends, ELEMENTS)


def spring_segments(case: Sized, stiffness: Floats, solid: SolidBuckling) -> Refinement | None:
    """The refined springs' critical load by K_b (6, 6) for more and more segments; None where some of them have
    none."""
    lumped = SpringLinkage(case, stiffness, solid.q_deg, "tip").mechanism
    loads = [float(-critical_load(replace(lumped, bar=Refined(n)), solid.held).load) for n in SEGMENT_COUNTS]
    if not np.isfinite(loads).all():
        return None
    model, quantity = "VJM, distributed", "critical load"
    return _extrapolated(model, quantity, solid, "segments a bar", SEGMENT_COUNTS, loads, SEGMENTS)


def _extrapolated(
    model: str,
    quantity: str,
    of: SolidPath | SolidBuckling,
    refined: str,
    counts: Sequence[int],
    values: list[float],
    used: int,
) -> Refinement:
    """The record of a study of parts of a bar: its limit is that of ever more of them."""
    found = extrapolate([1 / n for n in counts], values)
    return Refinement(
        model=model,
        quantity=quantity,
        q_deg=of.q_deg,
        held=of.held,
        refined=refined,
        sizes=list(counts),
        values=values,
        limit=found.limit,
        band=found.band(values[counts.index(used)]),
        used=used,
    )


def solid_meshes(
    s: SolidBar, path: SolidPath, solid: SolidBuckling, bar: Buckling | None
) -> Refinement | None:
    """The solid's critical load on the mesh of its path and on the working mesh; None where the two are one."""
    if s.path_space.dofs == s.space.dofs or bar is None or bar.limit_N is None:
        return None
    limit = solid.loads[0] * bar.limit_N / bar.load_N
    return Refinement(
        model="solid FE",
        quantity="critical load",
        q_deg=path.q_deg,
        held=path.held,
        refined="unknowns a bar",
        sizes=[s.path_space.dofs, s.space.dofs],
        values=[path.critical, solid.loads[0]],
        limit=limit,
        band=SAFETY * abs(path.critical / limit - 1.0),
        used=s.path_space.dofs,
    )


def refinements(
    case: Sized,
    s: SolidBar,
    stiffness: Floats,
    loads: Sequence[SolidBuckling],
    paths: Sequence[tuple[SolidPath, Buckling | None]],
    steps: Refinement,
) -> list[Refinement]:
    """Every study at the first angle, the solid's own steps given; stiffness: K_b (6, 6)."""
    first = case.linkage.angles_deg[0]
    solids = {tuple(b.held): b for b in loads if b.q_deg == first}
    here = [(path, bar) for path, bar in paths if path.q_deg == first]
    found: list[Refinement | None] = [
        solid_meshes(s, path, solids[tuple(path.held)], bar) for path, bar in here
    ]
    section = section_of_bar(s, stiffness)
    found += [
        steps,
        frame_steps(FrameLinkage(case, section, stiffness, first, GUIDED, solids[GUIDED].planes[0]), loads),
    ]
    found += [
        frame_elements(FrameLinkage(case, section, stiffness, first, path.held, path.plane), path)
        for path, _ in here
    ]
    found += [spring_segments(case, stiffness, solids[tuple(path.held)]) for path, _ in here]
    return [f for f in found if f is not None]
