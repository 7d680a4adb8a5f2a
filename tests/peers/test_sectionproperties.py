"""Section constants against sectionproperties (R. van Leeuwen, J. Open Source Softw. 9 (2024) 6105).

An independent program with six-node triangles, and W. D. Pilkey's definition of the shear areas as here.
"""

from __future__ import annotations

import numba
import numpy as np
import pytest

# Where no compiler is, one of its libraries is installed without its compiled part. On these small meshes its compiled
# functions take longer to compile (forty seconds, once an environment) than to run.
with pytest.MonkeyPatch.context() as patched:
    patched.setattr(numba.config, "DISABLE_JIT", True)
    Analysis = pytest.importorskip(
        "sectionproperties.analysis", reason="sectionproperties cannot be imported", exc_type=ImportError
    ).Section

from sectionproperties.pre import Geometry, Material
from shapely import Point, Polygon, box

from fem.section_constants import section_constants
from meshes.section import ISection, Rectangle, Section, Tube

SECTIONS: list[tuple[Section, Polygon]] = [
    (Rectangle(6.0, 10.0), box(-3.0, -5.0, 3.0, 5.0)),
    (
        ISection(12.0, 2.2, 15.5, 4.0),
        box(-6.0, -7.75, 6.0, 7.75) - box(2.0, -5.55, 6.0, 5.55) - box(-6.0, -5.55, -2.0, 5.55),
    ),
    (Tube(12.0, 2.0), Point(0, 0).buffer(6.0, quad_segs=96) - Point(0, 0).buffer(4.0, quad_segs=96)),
]


@pytest.mark.parametrize("nu", [pytest.param(0.0, marks=pytest.mark.long), 0.33])
@pytest.mark.parametrize(("section", "outline"), SECTIONS, ids=["rectangle", "I", "tube"])
def test_constants(section: Section, outline: Polygon, nu: float) -> None:
    material = Material("m", 70e3, nu, 100.0, 1e-6, "grey")
    geometry = Geometry(outline, material=material).create_mesh(
        mesh_sizes=[0.25 if isinstance(section, Tube) else 0.1]
    )
    theirs = Analysis(geometry)
    theirs.calculate_geometric_properties()
    theirs.calculate_warping_properties()
    e = 70e3
    ours = section_constants(section, nu)
    ixx, iyy, _ = theirs.get_eic(e_ref=e)
    np.testing.assert_allclose((ours.area, ours.Iy, ours.Iz), (theirs.get_area(), ixx, iyy), rtol=2e-4)
    # get_ej is G J: their modulus-weighted J of a composite section.
    assert pytest.approx(theirs.get_ej(e_ref=e), rel=2e-3) == ours.J
    if not isinstance(section, Tube):
        assert pytest.approx(theirs.get_egamma(e_ref=e), rel=2e-3) == ours.Iw
    along_y, along_z = theirs.get_eas(e_ref=e)
    np.testing.assert_allclose((ours.shear_area_y, ours.shear_area_z), (along_y, along_z), rtol=3e-3)
