"""The eight entries of a 6x6 that a bar with two planes of symmetry has."""

import numpy as np

from meshes.solid import Floats
from pipeline.validation.result import Entry, Matrix

ENTRIES = {
    "K11": (0, 0),
    "K22": (1, 1),
    "K26": (1, 5),
    "K33": (2, 2),
    "K35": (2, 4),
    "K44": (3, 3),
    "K55": (4, 4),
    "K66": (5, 5),
}


def eight_entries(stiffness: Floats) -> Floats:
    """(8,) of a (6, 6), in the order of `ENTRIES`."""
    return np.array([stiffness[ij] for ij in ENTRIES.values()])


def compared(value: Floats, reference: Floats) -> list[Entry]:
    """The eight entries of a 6x6 beside those of its reference."""
    return [
        Entry(entry=name, value=float(v), reference=float(r), deviation=float(v / r - 1.0))
        for name, v, r in zip(ENTRIES, eight_entries(value), eight_entries(reference), strict=True)
    ]


def rows(matrix: Floats) -> Matrix:
    """A matrix (m, n) as lists of floats."""
    return [[float(x) for x in row] for row in np.asarray(matrix)]
