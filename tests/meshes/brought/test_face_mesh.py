"""The section of a prism: its own mirror image where the part is, all of the area, no cell folded over."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import gmsh
import numpy as np
import pytest

from fem.slices.classes import mirrors
from fem.slices.stiffness import chain_stiffness
from meshes.brought.face_mesh import mirrored, worst_corner
from meshes.plane import PlaneMesh
from tests.meshes.brought import made
from tests.meshes.brought.made import brought, cad, difference, plane

ENDS = (plane(0, 0, 0), plane(60, 0, 0))


def angle() -> None:
    """Two legs of 3 mm: no mirror along y or z."""
    gmsh.model.occ.addBox(0, 0, 0, 60, 3, 12)
    gmsh.model.occ.fuse([(3, 1)], [(3, gmsh.model.occ.addBox(0, 0, 0, 60, 10, 3))])


def off_centre() -> None:
    """A bore that stands off the middle of its block: one mirror, at y = 0."""
    gmsh.model.occ.addBox(0, -6, -4, 60, 12, 8)
    gmsh.model.occ.cut([(3, 1)], [(3, gmsh.model.occ.addCylinder(0, 0, 1.0, 60, 0, 0, 2))])


@pytest.mark.parametrize(
    ("make", "axes", "area"),
    [
        (made.box, (1, 2), 60.0),
        (made.hollow, (1, 2), 16 * np.pi),
        (angle, (), 57.0),
        (off_centre, (1,), 96 - 4 * np.pi),
    ],
)
def test_a_section_is_meshed_as_its_own_mirror_image(
    make: Callable[[], None], axes: tuple[int, ...], area: float, tmp_path: Path
) -> None:
    prism = brought(cad(tmp_path / "it.step", make), *ENDS).drawn
    assert prism is not None and len(prism.flats) == 2
    for flat, sweep, mesh in zip(prism.flats, prism.sweeps, prism.meshes, strict=True):
        assert mirrors(sweep) == axes and worst_corner(flat) > 0.05
        assert mesh.dofs == sweep.dofs and set(mesh.facets) == {"base", "tip"}
        # The shoelace formula over each cell's edge nodes: straight between them, which of a bore is near only.
        ring = flat.points[flat.cells[:, [0, 4, 1, 5, 2, 6, 3, 7]]]
        ahead = np.roll(ring, -1, axis=1)
        found = 0.5 * np.abs((ring[..., 0] * ahead[..., 1] - ring[..., 1] * ahead[..., 0]).sum(axis=1)).sum()
        assert found == pytest.approx(area, rel=1e-9 if make in (made.box, angle) else 0.02)
    assert len(prism.flats[1].cells) == 4 * len(prism.flats[0].cells)


def test_the_chain_of_the_section_is_that_of_the_whole_mesh(tmp_path: Path) -> None:
    """K_b of the section handed over, and of the solid mesh made of it, in the bar's frame."""
    it = brought(cad(tmp_path / "box.step", made.box), *ENDS)
    assert it.drawn is not None
    for sweep, bar in zip(it.drawn.sweeps, made.bars(it), strict=True):
        assert bar.model("rigid").solved_by == "slice chain, quarter section"
        assert difference(chain_stiffness(sweep, made.ALUMINIUM), bar.stiffness("rigid")) < 1e-9


def test_nodes_on_a_mirror_are_one() -> None:
    line = np.array([0.0, 0.5, 1.0])
    places = [(0, 0), (2, 0), (2, 2), (0, 2), (1, 0), (2, 1), (1, 2), (0, 1), (1, 1)]
    one = PlaneMesh(np.array([[line[i], line[j]] for i, j in places]), np.arange(9)[None])
    whole = mirrored(one, (1, 2))
    assert len(whole.points) == 25 and len(whole.cells) == 4 and worst_corner(whole) == pytest.approx(1.0)
    assert len(mirrored(one, (1,)).points) == 15
    folded = PlaneMesh(one.points.copy(), one.cells)
    folded.points[2] = (0.2, 0.2)
    assert worst_corner(folded) < 0.0
