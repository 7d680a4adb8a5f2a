"""Plain bar P, the yardstick of the finite elements: made once for all tests that want it.

I-section, flanges 12 x 2.2 mm, height 15.5 mm, web 4 mm, no lugs, 310 mm long, E = 70 GPa, nu = 0.33. Its reference
values come from two independent solid programs (scikit-fem and CalculiX, which agree to 4e-7 on one mesh) and two
beam programs (OpenSees and exudyn); they were computed for this project on uniform meshes of 20-node hexahedra.
"""

from __future__ import annotations

from functools import cache

import numpy as np

from fem.buckling import Mode, buckling
from fem.linear import LinearModel
from fem.linkage import parallelogram, single_bar
from fem.material import Isotropic
from fem.section_constants import SectionConstants, section_constants
from fem.space import Space
from meshes.bar import Bar
from meshes.resolution import Resolution
from meshes.section import ISection
from meshes.solid import Floats, SolidMesh
from meshes.store import mesh_bar

SECTION = ISection(12.0, 2.2, 15.5, 4.0)
LENGTH = 310.0
WIDTH = 80.0
MATERIAL = Isotropic(70e3, 0.33, "yardstick bar P")
BAR = Bar(SECTION, LENGTH)
SIZE = 6.0

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
ALL_BUT_X = ("y", "z", "rx", "ry", "rz")
GUIDED = ("z", "rx", "ry", "rz")


@cache
def mesh(level: int, tetrahedra: bool = False) -> SolidMesh:
    """3 057 unknowns at level 1, 18 063 at level 2, 54 237 at level 3."""
    return mesh_bar(BAR, Resolution(SIZE, level), tetrahedra)


@cache
def space(level: int) -> Space:
    return Space.of(mesh(level))


@cache
def model(level: int, pinned: bool = False) -> LinearModel:
    """The bar alone; its factorisations and matrices are kept."""
    return LinearModel(single_bar(space(level), LENGTH, pinned), MATERIAL)


@cache
def linkage_model(level: int, degrees: float) -> LinearModel:
    """The parallelogram of two bars P."""
    return LinearModel(parallelogram(space(level), LENGTH, WIDTH, np.radians(degrees)), MATERIAL)


@cache
def modes(supports: str) -> tuple[Mode, ...]:
    """The lowest modes at level 2: tip "free", "guided" (x, y, z free), "clamped", or both faces "pinned" about y."""
    held = {"free": (), "guided": ("rx", "ry", "rz")}.get(supports, ALL_BUT_X)
    return buckling(model(2, supports == "pinned"), held, 5)


@cache
def constants() -> SectionConstants:
    return section_constants(SECTION, MATERIAL.nu)


def entries(k: Floats) -> Floats:
    """The eight entries of a bar's 6x6 in the order of `ENTRIES`."""
    return np.array([k[place] for place in ENTRIES.values()])


def scaled(k: Floats) -> Floats:
    """A 6x6 with its rows and columns divided by the square roots of its diagonal."""
    root = np.sqrt(np.diag(k))
    return np.asarray(k / np.outer(root, root))
