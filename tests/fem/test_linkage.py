"""The parallelogram of solid bars against Eq. 11 of the paper, evaluated with the K_b of the same solid bar.

A. Pashkevich, A. Klimchik, S. Caro, D. Chablat, Stiffness modelling of parallelogram-based parallel manipulators,
EUCOMES 2010, Eq. 11. It holds in the bar frame and is exact for bars whose end faces are rigid.
"""

from __future__ import annotations

from math import cos, radians, sin

import numpy as np
import pytest

from fem.linear import LinearModel
from fem.linkage import parallelogram
from tests.fem import bar_p

ANGLE = float(np.degrees(np.random.default_rng(11).uniform(-1.0, 1.0)))


def equation_11(k: np.ndarray, d: float, q: float) -> np.ndarray:
    """K_p in the bar frame, written out from the paper."""
    c, s, s2 = cos(q), sin(q), sin(2 * q)
    half = np.zeros((6, 6))
    half[0, 0] = k[0, 0]
    half[1, 1] = k[1, 1]
    half[1, 5] = half[5, 1] = k[1, 5]
    half[3, 3] = k[3, 3] + d**2 * c**2 * k[1, 1] / 4
    half[3, 5] = half[5, 3] = d**2 * s2 * k[1, 1] / 8
    half[4, 4] = d**2 * c**2 * k[0, 0] / 4
    half[5, 5] = k[5, 5] + d**2 * s**2 * k[1, 1] / 4
    return 2 * half


def bar_frame(k: np.ndarray, q: float) -> np.ndarray:
    """A 6x6 in the base frame seen from the frame turned by R_y(q), about the same point."""
    turn = np.array([[cos(q), 0.0, sin(q)], [0.0, 1.0, 0.0], [-sin(q), 0.0, cos(q)]])
    both = np.kron(np.eye(2), turn)
    return both.T @ k @ both


@pytest.mark.parametrize("degrees", [0.0, 30.0, ANGLE])
def test_equation_11(degrees: float) -> None:
    q = radians(degrees)
    found = bar_frame(bar_p.linkage_model(1, degrees).stiffness, q)
    expected = equation_11(bar_p.model(1).stiffness, bar_p.WIDTH, q)
    diagonal = np.diag(expected).copy()
    # z is free: its row is measured against the softest translation.
    diagonal[2] = diagonal[1]
    scaled = (found - expected) / np.sqrt(np.outer(diagonal, diagonal))
    assert np.abs(scaled).max() < 1e-6
    nonzero = expected != 0.0
    np.testing.assert_allclose(found[nonzero], expected[nonzero], rtol=1e-6)


@pytest.mark.parametrize("degrees", [0.0, 30.0, ANGLE])
def test_rank_five_and_the_free_direction(degrees: float) -> None:
    """The null vector is z of the bar frame: the platform swings on its parallel bars."""
    q = radians(degrees)
    # Rotations counted as arcs on the bar's length make the entries comparable.
    arcs = np.repeat([1.0, 1.0 / bar_p.LENGTH], 3)
    scaled = arcs[:, None] * bar_p.linkage_model(1, degrees).stiffness * arcs
    values, vectors = np.linalg.eigh(scaled)
    # The softest of the five is out of plane, three orders below the stiffest.
    assert abs(values[0]) < 1e-6 * values[1]
    assert values[1] > 1e-5 * values[-1]
    np.testing.assert_allclose(np.abs(vectors[:, 0]), np.abs([sin(q), 0, cos(q), 0, 0, 0]), atol=1e-6)


def test_two_bars_are_twice_one_where_the_width_does_not_matter() -> None:
    """The paper's own reference, 2 K_b: entries 11, 22, 26 at q = 0."""
    one, two = bar_p.model(1).stiffness, bar_p.linkage_model(1, 0.0).stiffness
    for place in ((0, 0), (1, 1), (1, 5), (5, 5)):
        assert two[place] == pytest.approx(2 * one[place], rel=1e-6)


def test_members_of_one_space_share_their_matrix() -> None:
    model = bar_p.linkage_model(1, 0.0)
    first, second = model.matrices
    assert first is second
    assert model.linkage.hinges == 4
    assert model.linkage.dofs == 2 * bar_p.space(1).dofs
    assert bar_p.model(1).linkage.hinges == 0


def test_unloaded_platform_is_where_the_paper_puts_it() -> None:
    """(L cos q, 0, -L sin q); bar 1 starts at z = -d/2, bar 2 at +d/2 (Eq. 1)."""
    q = radians(30.0)
    linkage = parallelogram(bar_p.space(1), 310.0, 80.0, q)
    np.testing.assert_allclose(linkage.point, [310 * cos(q), 0.0, -310 * sin(q)], atol=1e-9)
    np.testing.assert_allclose([m.origin[2] for m in linkage.members], [-40.0, 40.0])
    np.testing.assert_allclose(np.mean([m.tip for m in linkage.members], axis=0), linkage.point, atol=1e-9)


def test_a_driven_coordinate_leaves_the_rest_free_of_load() -> None:
    """Drive x by 1 mm with z held: only x and z carry a load."""
    model = bar_p.linkage_model(1, 30.0)
    assert isinstance(model, LinearModel)
    motion = model.motions(("x",), ("z",))
    r = model.reduction
    load = (model.reduced @ motion)[:, 0]
    assert motion[r.platform(("x", "z")), 0] == pytest.approx([1.0, 0.0])
    driven = load[r.platform(("x",))][0]
    assert driven > 1e4
    assert np.abs(load[r.others(("x", "z"))]).max() < 1e-8 * driven
