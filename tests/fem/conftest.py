"""Bar P at two resolutions, and small meshes of every cell kind."""

from __future__ import annotations

import numpy as np
import pytest

from fem.material import Isotropic
from fem.space import Space
from meshes.bar import Bar
from meshes.resolution import Resolution
from meshes.section import Rectangle, Round
from meshes.solid import SolidMesh
from meshes.store import mesh_bar
from tests.fem import bar_p

SMALL = {
    "hexahedron20": (Bar(Rectangle(10.0, 12.0), 40.0), False),
    "hexahedron27": (Bar(Round(12.0), 40.0), False),
    "tetra10": (Bar(Rectangle(10.0, 12.0), 40.0), True),
}


@pytest.fixture(scope="session")
def coarse() -> SolidMesh:
    """Bar P, 3 057 unknowns."""
    return bar_p.mesh(1)


@pytest.fixture(scope="session")
def fine() -> SolidMesh:
    """Bar P, 18 063 unknowns."""
    return bar_p.mesh(2)


@pytest.fixture(scope="session")
def material() -> Isotropic:
    return bar_p.MATERIAL


@pytest.fixture(scope="session", params=list(SMALL))
def small(request: pytest.FixtureRequest) -> SolidMesh:
    """A short bar of each cell kind with its nodes moved at random, so that no cell is a straight block."""
    bar, tetrahedra = SMALL[request.param]
    straight = mesh_bar(bar, Resolution(6.0, 1), tetrahedra)
    assert straight.kind == request.param
    shake = np.random.default_rng(1).uniform(-0.15, 0.15, straight.points.shape)
    return straight.moved(shake)


@pytest.fixture(scope="session")
def small_space(small: SolidMesh) -> Space:
    return Space.of(small)
