"""MATLAB's MAT-file, version 5: matrices under the names of variables, words as cell arrays."""

from __future__ import annotations

import io
from pathlib import Path
from typing import Any

import numpy as np
from scipy.io import savemat

from pipeline.export import arrays
from pipeline.export.content import UNITS as UNITS
from pipeline.export.content import Export

ONE = False
lost = arrays.lost_by_numbers

_TEXT = 116
"""Bytes of free text at the head of such a file, of which MATLAB wants the first words."""


def files(it: Export, out: Path) -> dict[Path, bytes]:
    """One file, the same for the same source; K_p has its angles last, as MATLAB's pages do."""
    values: dict[str, Any] = dict(arrays.as_arrays(it))
    if "K_p" in values:
        values["K_p"] = np.moveaxis(values["K_p"], 0, -1)
    for name, value in values.items():
        if value.dtype.kind == "U":
            values[name] = value.astype(object)
    content = io.BytesIO()
    savemat(content, values)
    # In the place of the time of writing, which would make every file another one.
    text = b"MATLAB 5.0 MAT-file, written by parastiff export".ljust(_TEXT)
    return {out: text + content.getvalue()[_TEXT:]}
