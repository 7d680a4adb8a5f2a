"""The stress that colours the bent linkage, against P/A and a beam's bending stress."""

from __future__ import annotations

from functools import cache
from pathlib import Path

import meshio
import numpy as np
import pytest

from fem.buckling import buckling
from meshes.solid import Floats
from pipeline.validation.stages.linkage_shapes import bent, nodal_stress, shape_name, von_mises, write_shape
from tests.fem.bar_p import BAR, GUIDED, LENGTH, MATERIAL, WIDTH, constants, linkage_model

BEND = 3.1
HALF_WIDTH = 6.0


@cache
def load() -> float:
    return buckling(linkage_model(1, 0.0), GUIDED, 1)[0].load


@cache
def axial(bend: float) -> tuple[Floats, Floats]:
    """Points (n, 3) of bar 1 away from its ends, and its stress along x, MPa."""
    model = linkage_model(1, 0.0)
    field = bent(model, list(GUIDED), load(), bend)[0].reshape(-1, 3)
    mesh = model.linkage.members[0].space.mesh
    inside = np.abs(mesh.points[:, 0] - LENGTH / 2) < 0.35 * LENGTH
    return mesh.points[inside], nodal_stress(mesh, MATERIAL, field)[inside, 0, 0]


def test_the_unbent_linkage_at_its_load_has_its_share_of_p_over_a() -> None:
    """Half the load each, uniform away from the ends by Saint-Venant; the section of the mesh is exact."""
    _, stress = axial(0.0)
    np.testing.assert_allclose(stress, -load() / 2.0 / constants().area, rtol=2e-3)


def test_bending_adds_the_stress_of_a_guided_beam() -> None:
    """y = a/2 (1 - cos πx/L), so E a π²/(2 L²) cos(πx/L) times the distance from the middle; the coarse mesh's
    mode is good to a per cent."""
    points, stress = axial(BEND)
    added = stress - axial(0.0)[1]
    largest = MATERIAL.E * BEND * np.pi**2 / (2.0 * LENGTH**2)
    beam = -largest * np.cos(np.pi * points[:, 0] / LENGTH) * points[:, 1]
    sign = np.sign(added @ beam)
    np.testing.assert_allclose(sign * added, beam, atol=0.02 * largest * HALF_WIDTH)
    assert np.abs(added).max() > 0.5 * largest * HALF_WIDTH


def test_von_mises_of_known_states() -> None:
    """A bar in tension has its stress, pure shear sqrt(3) times it, pressure nothing; any turn changes nothing."""
    pulled, sheared = np.zeros((3, 3)), np.zeros((3, 3))
    pulled[0, 0], sheared[0, 1], sheared[1, 0] = 100.0, 10.0, 10.0
    turn, _ = np.linalg.qr(np.random.default_rng(3).standard_normal((3, 3)))
    found = von_mises(np.stack([pulled, sheared, 50.0 * np.eye(3), turn @ pulled @ turn.T]))
    np.testing.assert_allclose(found, [100.0, 10.0 * np.sqrt(3.0), 0.0, 100.0], atol=1e-9)


def test_the_file_holds_both_bars_in_the_base_frame(tmp_path: Path) -> None:
    model = linkage_model(1, 30.0)
    path = tmp_path / shape_name(30.0, list(GUIDED))
    assert path.name == "linkage_q30_z-rx-ry-rz.vtu"
    write_shape(model, bent(model, list(GUIDED), load(), BEND), path)
    found = meshio.read(path)
    mesh = model.linkage.members[0].space.mesh
    assert len(found.points) == 2 * len(mesh.points) and len(found.cells[0].data) == 2 * len(mesh.cells)
    assert found.points[:, 2].max() == pytest.approx(
        WIDTH / 2 + BAR.section.size[1] / 2 * np.cos(np.pi / 6), rel=1e-3
    )
    assert found.points[:, 0].max() == pytest.approx(
        LENGTH * np.cos(np.pi / 6) + BAR.section.size[1] / 2 * 0.5, rel=1e-3
    )
    size = np.linalg.norm(found.point_data["displacement"], axis=1).max()
    assert BEND < size < BEND + 1.0 and found.point_data["stress"].min() > 0.0
