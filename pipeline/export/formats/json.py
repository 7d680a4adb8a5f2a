"""JSON: every matrix with its name, point, frame, units and what it was made of."""

from __future__ import annotations

import json
from pathlib import Path

from pipeline.export import arrays
from pipeline.export.content import UNITS as UNITS
from pipeline.export.content import Export

ONE = False
lost = arrays.lost_by_numbers


def files(it: Export, out: Path) -> dict[Path, bytes]:
    """One file; numbers to the last bit."""
    return {out: (json.dumps(arrays.as_values(it), indent=1, allow_nan=False) + "\n").encode()}
