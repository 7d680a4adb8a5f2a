"""Exported files under six unit loads in another program: sources, and the compliance that is to be met.

The swing of a linkage costs no energy: z is held there, and the other five directions are loaded.
"""

from __future__ import annotations

from functools import partial
from pathlib import Path

import numpy as np

from pipeline.export.content import Export
from tests.pipeline.export.sources import SOFT, UNEQUAL, brought, campaign, written

BROUGHT = "bar from a file"
CASES = {
    "bar": ({}, None),
    "other bar": (UNEQUAL, None),
    "linkage": ({}, 0.0),
    "linkage at 30": ({}, 30.0),
    "unequal linkage": (UNEQUAL, 30.0),
    "soft and bowed linkage": (SOFT, -20.0),
    BROUGHT: ({}, None),
    f"linkage of a {BROUGHT}": ({}, 30.0),
}
"""Effects of the model and the angle, by name; the 6x6 of the bars couples all directions."""
LIMIT = 1e-6


def source(case: str, to: str, folder: Path) -> tuple[Export, Path]:
    """What is exported and the file of a format."""
    effects, q = CASES[case]
    source = brought if BROUGHT in case else partial(campaign, effects=effects)
    it, files = written(source(folder / "bench"), to, folder / "exported", q)
    return it, files[0]


def loaded(it: Export) -> list[int]:
    """Directions that are loaded."""
    return [0, 1, 2, 3, 4, 5] if it.linkage is None else [0, 1, 3, 4, 5]


def wanted(it: Export) -> np.ndarray:
    """(n, n) compliance of the first spring in these directions, N, mm, rad, by inverting its stiffness."""
    free = loaded(it)
    return np.asarray(np.linalg.inv(it.springs[0].matrix[np.ix_(free, free)]))
