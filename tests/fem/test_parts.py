"""Cells of every kind: shape functions, rigid motions, constant strain; materials by region; loads distributed."""

from __future__ import annotations

import numpy as np
import pytest

from fem.anisotropic import Orthotropic, Regional, full_tensor, isotropic_tensor, turned
from fem.cells import _FUNCTIONS, _NODES, reference
from fem.distributed import distributed_stiffness, fit, still
from fem.elasticity import stiffness_matrix, stress
from fem.material import Isotropic
from fem.mesh_limit import limit
from fem.part_bar import PartBar
from fem.part_space import part_space, shape_quality
from fem.rigid_motions import rigid_motions
from fem.rotation import rotation
from fem.solvers import direct, multigrid
from fem.space import Space
from fem.stiffness import bar_stiffness
from meshes.bar import Bar
from meshes.facets import Cylinder, on_surface
from meshes.part import CORNERS, FACETS, PartMesh
from meshes.resolution import Resolution
from meshes.section import Rectangle
from meshes.store import mesh_bar
from tests.meshes.brought import parts
from tests.meshes.brought.made import ALUMINIUM, difference

KINDS = ("hexahedron", "wedge")


@pytest.mark.parametrize("kind", list(_FUNCTIONS))
def test_shape_functions_are_one_at_their_node_and_their_slopes_are_differences(kind: str) -> None:
    functions, rule = _FUNCTIONS[kind]
    nodes = np.asarray(_NODES[kind](), float)
    np.testing.assert_allclose(functions(nodes)[0], np.eye(len(nodes)), atol=1e-14)
    points = rule()[0]
    for a, step in enumerate(1e-6 * np.eye(points.shape[1])):
        difference_quotient = (functions(points + step)[0] - functions(points - step)[0]) / 2e-6
        np.testing.assert_allclose(functions(points)[1][:, :, a], difference_quotient, atol=1e-8)


@pytest.mark.parametrize("kind", list(FACETS))
def test_facets_look_outward_and_have_their_own_middle_nodes(kind: str) -> None:
    nodes = np.asarray(_NODES[kind](), float)
    for facet, own in FACETS[kind].items():
        for local in own:
            p, n = nodes[list(local)], CORNERS[facet]
            outward = np.cross(p[1] - p[0], p[2] - p[0])
            assert outward @ (p.mean(axis=0) - nodes.mean(axis=0)) > 0.0
            for i in range(n):
                np.testing.assert_allclose(p[n + i], 0.5 * (p[i] + p[(i + 1) % n]), atol=1e-14)


def test_one_mesh_in_the_house_s_own_space_and_in_this_one() -> None:
    """Hexahedra of 20 nodes as scikit-fem integrates them and as shape functions here do."""
    mesh = mesh_bar(Bar(Rectangle(6.0, 10.0), 60.0), Resolution(6.0, 1))
    part = PartMesh.of(
        mesh.points,
        ((mesh.kind, mesh.cells),),
        np.zeros(len(mesh.cells), dtype=np.int64),
        ("a",),
        {name: {"quad8": mesh.faces[name]} for name in ("base", "tip")},
    )
    ours, theirs = stiffness_matrix(part_space(part), ALUMINIUM), stiffness_matrix(Space.of(mesh), ALUMINIUM)
    assert abs(ours - theirs).max() < 1e-9 * abs(theirs).max()
    k = PartBar(part, 60.0, ALUMINIUM, (False, False)).stiffness("rigid")
    assert difference(k, bar_stiffness(mesh, 60.0, ALUMINIUM)) < 1e-10


@pytest.mark.parametrize("raw", [parts.block("hexahedron"), parts.block("wedge"), parts.mixed()])
def test_rigid_motions_cost_nothing_and_constant_strain_is_exact(raw: object) -> None:
    mesh = parts.part(raw)  # type: ignore[arg-type]
    space = part_space(mesh)
    law = Regional((Isotropic(210e3, 0.3), ALUMINIUM), mesh.region_of)
    matrix = stiffness_matrix(space, law)
    assert np.abs(matrix @ rigid_motions(mesh.points)).max() < 1e-7 * abs(matrix).max()
    strain = np.array([[1e-3, 2e-4, 0.0], [2e-4, -5e-4, 1e-4], [0.0, 1e-4, 3e-4]])
    u = (mesh.points @ strain).ravel()
    found = stress(space, law, u)
    for region, material in enumerate(law.materials):
        expected = np.einsum("abcd,cd->ab", isotropic_tensor(material), strain)
        inside = space.weights > 0.0
        own = found[(law.of_cell == region)][inside[law.of_cell == region]]
        np.testing.assert_allclose(own, np.broadcast_to(expected, own.shape), atol=1e-9 * 210)
    assert float(space.weights.sum()) == pytest.approx(3600.0)
    assert shape_quality(mesh)["worst_cell"] == pytest.approx(1.0)


def test_orthotropic_constants() -> None:
    """An isotropic material by nine constants is the isotropic one in any axes; a turned law is turned."""
    iso = Isotropic(70e3, 0.33)
    turn = rotation(np.array([0.3, -0.2, 0.5]))
    axes = tuple(map(tuple, turn))
    g = iso.shear_modulus
    nine = Orthotropic(70e3, 70e3, 70e3, 0.33, 0.33, 0.33, g, g, g, axes)
    np.testing.assert_allclose(nine.tensor, isotropic_tensor(iso), atol=1e-7)
    wood = Orthotropic(11e3, 900.0, 600.0, 0.4, 0.4, 0.3, 700.0, 600.0, 60.0)
    pulled = np.linalg.inv(np.linalg.inv(wood.compliance))[:, 0]
    # A pull along 1 contracts 2 by nu12.
    assert pulled[1] / pulled[0] == pytest.approx(-0.4)
    laid = Orthotropic(
        11e3, 900.0, 600.0, 0.4, 0.4, 0.3, 700.0, 600.0, 60.0, ((0, 1, 0), (-1, 0, 0), (0, 0, 1))
    )
    assert laid.tensor[1, 1, 1, 1] == pytest.approx(wood.tensor[0, 0, 0, 0])
    np.testing.assert_allclose(turned(wood.tensor, np.eye(3)), full_tensor(np.linalg.inv(wood.compliance)))
    with pytest.raises(ValueError, match="energy back"):
        Orthotropic(11e3, 900.0, 600.0, 4.0, 0.4, 0.3, 700.0, 600.0, 60.0)
    with pytest.raises(ValueError, match="right angles"):
        Orthotropic(11e3, 900.0, 600.0, 0.4, 0.4, 0.3, 700.0, 600.0, 60.0, ((1, 0, 0), (1, 1, 0), (0, 0, 1)))


def test_distributed_loads_on_a_slender_bar_are_a_beam() -> None:
    """The body free to bulge at both ends: EA / L to the last digit, and softer than between rigid faces."""
    mesh = parts.part(parts.block("hexahedron", (12, 1, 2)))
    bar = PartBar(mesh, 60.0, ALUMINIUM, (False, False))
    free, rigid = bar.stiffness("distributed"), bar.stiffness("rigid")
    assert free[0, 0] == pytest.approx(70e3 * 60.0 / 60.0, rel=1e-9)
    root = np.sqrt(np.diag(rigid))
    assert np.linalg.eigvalsh((rigid - free) / np.outer(root, root))[0] > -1e-9
    assert free[4, 4] == pytest.approx(4 * 70e3 * 6 * 10**3 / 12 / 60, rel=0.06)
    assert bar.ties == ("rigid", "distributed")
    with pytest.raises(ValueError, match="tie is 'glued'"):
        bar.stiffness("glued")


def test_distributed_loads_by_multigrid_are_those_of_a_direct_solver() -> None:
    """As a mesh that is too large for a direct solver has it."""
    mesh = parts.part(parts.block("hexahedron", (12, 1, 2)))
    assert mesh.kind == "hexahedron20"
    stiffness = stiffness_matrix(part_space(mesh), ALUMINIUM)
    ends = (mesh.facets["base"], mesh.facets["tip"])
    points = (np.zeros(3), np.array([60.0, 0.0, 0.0]))
    one, other = (distributed_stiffness(mesh, stiffness, ends, points, how) for how in (direct, multigrid))
    root = np.sqrt(np.diag(one))
    assert np.abs((other - one) / np.outer(root, root)).max() < 1e-6


def test_the_fit_of_a_rigid_motion_is_that_motion_and_six_displacements_hold_a_body() -> None:
    mesh = parts.part(parts.block("wedge"))
    at = np.array([60.0, 0.0, 0.0])
    both = fit(mesh.points, mesh.facets["tip"], at) @ rigid_motions(mesh.points - at)
    np.testing.assert_allclose(both, np.eye(6), atol=1e-9)
    assert np.linalg.matrix_rank(rigid_motions(mesh.points)[still(mesh.points)]) == 6


def test_the_limit_of_two_meshes() -> None:
    """Of values that fall as h² it is exact; of other powers, from slowest to fastest, it is within its error."""
    exact = np.full((6, 6), 10.0)
    for power, error in ((2.0, 1e-12), (1.5, 0.3), (3.5, 0.3)):
        coarse, fine = exact + 1.0, exact + 2.0**-power
        found = limit(coarse, fine)
        assert np.abs(found.value - exact).max() <= max(error, 1e-12) and np.all(found.error > 0.0)
        assert np.all(np.abs(found.value - exact) <= found.error + 1e-12)


def test_a_cell_that_is_inside_out_is_refused() -> None:
    raw = parts.block("hexahedron")
    turned_cells = raw.blocks[0][1][:, [4, 5, 6, 7, 0, 1, 2, 3]]
    from dataclasses import replace

    with pytest.raises(ValueError, match="12 of 12 cells of kind hexahedron20 are inside out"):
        part_space(parts.part(replace(raw, blocks=(("hexahedron", turned_cells),))))
    assert reference("tetra10").weights.sum() == pytest.approx(1 / 6)


def test_a_facet_beside_a_bore_whose_corners_stand_on_its_edge_is_no_part_of_it() -> None:
    points = np.array([[1.0, 0, 0], [0, 1.0, 0], [-1.0, 0, 0], [1.0, 0, 1.0]])
    cylinder = Cylinder((0.0, 0.0, 0.0), (0.0, 0.0, 1.0), 1.0)
    beside, along = np.array([[0, 1, 2, 0, 1, 2]]), np.array([[0, 1, 3, 0, 1, 3]])
    assert on_surface(points, {"triangle6": beside}, cylinder, 3.0) == {}
    assert on_surface(points, {"triangle6": along}, cylinder, 3.0)["triangle6"].tolist() == along.tolist()
