"""Everything that is exported as plain values and as arrays: what json, npz and mat hold."""

from __future__ import annotations

from typing import Any

import numpy as np

from pipeline.export.content import UNITS, Export, Spring, lost_by_all
from vjm.frames import POSE_NAMES, WRENCH_NAMES


def every_spring(it: Export) -> tuple[Spring, ...]:
    """The bars, then the linkage at every angle."""
    return (*it.bars, *(linkage.whole for linkage in it.linkages))


def lost_by_numbers(it: Export) -> tuple[str, ...]:
    """What a file of numbers cannot hold."""
    return lost_by_all(it, every_spring(it), it.in_whole)


def as_values(it: Export) -> dict[str, Any]:
    """Numbers, strings, lists and tables of them."""
    return {
        "written_by": "parastiff export",
        "source": it.source,
        "sha256": dict(it.digests),
        "units": {"force": "N", "length": "mm", "angle": "rad", "said": UNITS},
        "displacement": list(POSE_NAMES),
        "wrench": list(WRENCH_NAMES),
        "stiffness": [_spring(spring) for spring in every_spring(it)],
        "linkage": [
            {"q_deg": each.q_deg, "width_mm": each.width, "tips_mm": each.tips.tolist()}
            for each in it.linkages
        ],
        "effects": {name: dict(values) for name, values in it.effects.items()},
        "remarks": list(lost_by_numbers(it)),
        "versions": dict(it.versions),
        "commit": it.commit,
    }


def as_arrays(it: Export) -> dict[str, np.ndarray]:
    """Arrays by names that are variables: K_b (6, 6), K_p (angles, 6, 6), q_deg (angles,), points and words.

    Words are arrays of strings: `about` has a line for each thing that is known.
    """
    values, out = as_values(it), {bar.name: bar.matrix for bar in it.bars}
    for bar in it.bars:
        out[f"{bar.name}_point_mm"], out[f"{bar.name}_length_mm"] = bar.point, np.array(bar.length)
    if it.linkages:
        wholes = [linkage.whole for linkage in it.linkages]
        out["K_p"] = np.stack([whole.matrix for whole in wholes])
        out["K_p_point_mm"] = np.stack([whole.point for whole in wholes])
        out["K_p_rank"] = np.array([whole.rank for whole in wholes])
        out["q_deg"] = np.array([linkage.q_deg for linkage in it.linkages])
        out["width_mm"] = np.array([linkage.width for linkage in it.linkages])
        out["tips_mm"] = np.stack([linkage.tips for linkage in it.linkages])
    about = [
        f"source: {it.source}",
        *(f"sha256 of {name}: {digest}" for name, digest in it.digests.items()),
        *(f"{spring.name}: {spring.what}; {spring.frame}" for spring in every_spring(it)),
        *(f"effect {name}: {dict(own)}" for name, own in it.effects.items()),
        *(f"version of {name}: {version}" for name, version in it.versions.items()),
        f"commit: {it.commit}",
    ]
    words = {"units": [UNITS], "remarks": values["remarks"], "about": about}
    words |= {name: values[name] for name in ("displacement", "wrench")}
    return out | {name: np.array(lines) for name, lines in words.items()}


def _spring(it: Spring) -> dict[str, Any]:
    return {
        "name": it.name,
        "what": it.what,
        "matrix": it.matrix.tolist(),
        "frame": it.frame,
        "base_mm": it.base.tolist(),
        "point_mm": it.point.tolist(),
        "length_mm": it.length,
        "rank": it.rank,
        "q_deg": it.q_deg,
    }
