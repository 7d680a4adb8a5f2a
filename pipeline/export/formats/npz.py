"""NumPy's archive of arrays: `numpy.load(OUT)["K_b"]`."""

from __future__ import annotations

import io
from pathlib import Path

import numpy as np

from pipeline.export import arrays
from pipeline.export.content import UNITS as UNITS
from pipeline.export.content import Export

ONE = False
lost = arrays.lost_by_numbers


def files(it: Export, out: Path) -> dict[Path, bytes]:
    """One file; no entry is pickled."""
    content = io.BytesIO()
    np.savez(content, allow_pickle=False, **arrays.as_arrays(it))
    return {out: content.getvalue()}
