"""Why the curves of solid, frame, refined springs and LIN differ: a sentence for each, its numbers from the curves."""

from collections.abc import Sequence
from math import cos, radians

import numpy as np

from fem.beam import Segment
from meshes.solid import Floats
from pipeline.validation.result import Curve, Refinement
from pipeline.validation.stages.linkage import BOW, SolidBuckling, SolidPath

# Around the critical travel the bow rounds the corner; before and after the models can be told apart.
CORNER = (0.9, 1.2)


def force_at(curves: Sequence[Curve], x: Floats) -> Floats:
    """Fx (n,) at displacements x (n,) mm of one model's branches joined, N; NaN outside them."""
    joined = [c for c in curves if c.x_mm[-1] < 0.0]
    at = np.concatenate([c.x_mm for c in joined])
    force = np.concatenate([c.fx_N for c in joined])
    order = np.argsort(at, kind="stable")
    return np.interp(x, at[order], force[order], left=np.nan, right=np.nan)


def agreement_sentences(
    curves: Sequence[Curve],
    paths: Sequence[SolidPath],
    loads: Sequence[SolidBuckling],
    studies: Sequence[Refinement],
    bar: Segment,
    length: float,
) -> list[str]:
    """The models at the first angle, one way of holding the platform after the other; `bar` between its lugs."""
    sentences = []
    for path in (p for p in paths if p.q_deg == paths[0].q_deg):
        here = [c for c in curves if (c.q_deg, c.held) == (path.q_deg, path.held)]
        (solid,) = [b for b in loads if (b.q_deg, b.held) == (path.q_deg, path.held)]
        named = f"{', '.join(path.held)} held"
        sentences += [f"{named}: {text}" for text in compared(path, here, solid, studies, bar, length)]
    return sentences


def compared(
    path: SolidPath,
    curves: Sequence[Curve],
    solid: SolidBuckling,
    studies: Sequence[Refinement],
    bar: Segment,
    length: float,
) -> list[str]:
    """LIN, frame and refined springs beside the solid in one way of holding the platform."""
    x, reference = np.array(path.x[1:]), np.array(path.fx[1:])
    share = x * path.tangent / -path.critical

    def off(model: str, spring: str | None = None) -> Floats:
        same = [c for c in curves if c.model == model and spring in (None, c.spring_at)]
        return 100.0 * (force_at(same, x) / reference - 1.0)

    lin, frame, vjm = off("lin"), off("frame"), off("vjm", "distributed")
    before, after = share < CORNER[0], share > CORNER[1]
    corner = ~before & ~after
    law = 150.0 * float(np.abs(x[before]).max(initial=0.0)) * cos(radians(path.q_deg)) / length
    one_bar = solid.loads[0] / (2.0 * cos(radians(path.q_deg)))
    shear = 100.0 * one_bar / (bar.GAy if solid.planes[0] == "xy" else bar.GAz)
    sheared = f"and shear takes P/GA = {shear:.2f} % off the frame's load"
    if not shear:
        sheared = "and both take all of it for soft or stiff ends"
    mesh = 100.0 * (solid.loads[0] / path.critical - 1.0)
    return [
        f"LIN leaves the solid at the critical load, having no geometric stiffness: {largest(lin[before])} % off up "
        f"to {CORNER[0]:g} of the critical travel, {1 + lin[-1] / 100:.2f} times its load at {share[-1]:.2f} of it.",
        f"The frame stays within {largest(frame[before])} % of the solid before the corner, where the solid's Saint "
        f"Venant-Kirchhoff law softens by 3/2 of the strain, {law:.2f} %; it ends {frame[-1]:+.2f} % from it: it has "
        f"the K_b of the working mesh, on which the solid's critical load lies {mesh:+.2f} % from that of the path's "
        f"mesh, and {frame[-1] - mesh:+.2f} % is left to that law, beam theory and the shape of the bow.",
        f"The refined springs end {vjm[-1] - frame[-1]:+.2f} % from the frame of the same K_b"
        f"{segments(path, studies)}: K_b alone cannot tell shear from stiff ends, {sheared}; at the corner they are up "
        f"to {largest(vjm[corner])} % off the solid, for they are "
        f"perfect and turn sharply where {BOW} rounds its path.",
    ]


def segments(path: SolidPath, studies: Sequence[Refinement]) -> str:
    """What the number of segments makes up."""
    for study in studies:
        if study.refined == "segments a bar" and (study.q_deg, study.held) == (path.q_deg, path.held):
            value = study.values[study.sizes.index(study.used)]
            return f" ({study.used} segments make up {100 * (value / study.limit - 1.0):+.2f} %)"
    return ""


def largest(values: Floats) -> str:
    """The largest size of per cents (...)."""
    return f"{float(np.nanmax(np.abs(values), initial=0.0)):.2f}"
