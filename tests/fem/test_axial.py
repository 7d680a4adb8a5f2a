"""K_b + P K_g of solid bars: invariance, differences of condensed stiffness, nonlinear states, beams."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
from scipy.integrate import quad

from fem.axial import AxialStiffness, axial_stiffness, mean_square_twist, uniform_geometric_stiffness
from fem.beam import Segment
from fem.buckling import buckling
from fem.linear import LinearModel
from fem.linkage import PLATFORM, single_bar
from fem.path import State, residual_and_tangent
from fem.prestress import prestress
from fem.space import Space
from meshes.bar import Bar, Lug
from meshes.resolution import Resolution
from meshes.section import ISection
from meshes.store import mesh_bar
from tests.fem import bar_p

# A bar with hinge lugs, of the proportions of the one that meets the paper's K_b.
LUGGED = Bar(ISection(12.0, 2.2, 15.5, 4.0), 310.0, Lug(8.0, 12.0, 15.5))
BARS = ["plain", "lugged"]
PULL = 10.0


@cache
def model(name: str) -> LinearModel:
    if name == "plain":
        return bar_p.model(1)
    space = Space.of(mesh_bar(LUGGED, Resolution(6.0, 1)))
    return LinearModel(single_bar(space, LUGGED.length), bar_p.MATERIAL)


@cache
def found(name: str) -> AxialStiffness:
    return axial_stiffness(model(name))


def condensed(matrix: np.ndarray) -> np.ndarray:
    """Schur complement on the last six unknowns."""
    inner = matrix[:-6, :-6]
    return np.asarray(matrix[-6:, -6:] - matrix[-6:, :-6] @ np.linalg.solve(inner, matrix[:-6, -6:]))


@pytest.mark.parametrize("name", BARS)
def test_elastic_part_and_structure(name: str) -> None:
    """K_b itself; K_g has the same two coupled blocks and nothing else."""
    k = found(name)
    np.testing.assert_allclose(k.elastic, model(name).stiffness, rtol=1e-12, atol=1e-6)
    scaled = bar_p.scaled(k.geometric)
    coupled = np.eye(6, dtype=bool)
    for i, j in ((1, 5), (2, 4)):
        coupled[i, j] = coupled[j, i] = True
    assert np.abs(scaled[~coupled]).max() < 1e-8
    np.testing.assert_array_equal(k.geometric, k.geometric.T)


@pytest.mark.parametrize("name", BARS)
def test_a_rigid_turn_of_the_stressed_bar(name: str) -> None:
    """A bar that turns as a whole by θ under P at both ends is pushed sideways by P θ, whatever its section.

    With base and tip alike that reads K_g22 L + 2 K_g26 = 1 and K_g33 L - 2 K_g35 = 1, per N.
    """
    g = found(name).geometric
    assert 310.0 * g[1, 1] + 2 * g[1, 5] == pytest.approx(1.0, abs=1e-8)
    assert 310.0 * g[2, 2] - 2 * g[2, 4] == pytest.approx(1.0, abs=1e-8)


@pytest.mark.parametrize("name", BARS)
def test_central_differences_of_the_condensed_stiffness(name: str) -> None:
    """S(P) of K + P K_g, condensed anew at ±P, against its derivative; and S(P) is K_b + P K_g to second order."""
    m = model(name)
    state = prestress(m, "x", ())
    unit = state.geometric @ np.eye(m.reduction.size) / state.wrench[0]
    k = m.reduced.toarray()
    ahead, behind = (condensed(k + s * PULL * unit) for s in (1, -1))
    # Both leave a share of (P / P_cr)², 3e-7 at 10 N of the clamped bar's 20 kN (a hundred times more at 100 N, seen),
    # and the subtraction the rounding of matrices of condition 1e8: 2e-6 here, another on another processor.
    np.testing.assert_allclose(
        bar_p.entries(ahead - behind) / (2 * PULL), bar_p.entries(found(name).geometric), rtol=5e-6
    )
    np.testing.assert_allclose(bar_p.entries(found(name).at(PULL)), bar_p.entries(ahead), rtol=1e-6)


@pytest.mark.long
def test_nonlinear_states_of_the_pulled_bar() -> None:
    """Tangents of the large-displacement solid at two uniaxially stretched equilibria give the same derivative.

    They hold the axial strain's own effect on length, section and law too, of the order of P / EA of every entry of
    K_b: a thousandth of K_g22, a hundredth of K_g55.
    """
    m = model("plain")
    r = m.reduction
    pull = m.motions(PLATFORM, ()) @ np.linalg.solve(m.stiffness, PULL * np.eye(6)[0])
    free = np.arange(r.starts[-1])
    tangents = []
    for sign in (1.0, -1.0):
        state = State(np.zeros(r.starts[-1]), r.rest).moved(sign * pull)
        for _ in range(4):
            residual, tangent = residual_and_tangent(m, state)
            step = np.zeros(r.size)
            step[free] = -np.linalg.solve(tangent.toarray()[: len(free), : len(free)], residual[free])
            state = state.moved(step)
        residual, tangent = residual_and_tangent(m, state)
        assert np.abs(residual[free]).max() < 1e-7 * PULL
        assert residual[r.platform(["x"])[0]] == pytest.approx(sign * PULL, rel=1e-3)
        tangents.append(condensed(tangent.toarray()))
    slope = bar_p.entries(tangents[0] - tangents[1]) / (2 * PULL)
    bending = [i for i, name in enumerate(bar_p.ENTRIES) if name not in ("K11", "K44")]
    off = slope - bar_p.entries(found("plain").geometric)
    strain = np.abs(bar_p.entries(m.stiffness)) / (bar_p.MATERIAL.E * bar_p.constants().area)
    assert np.all(np.abs(off)[bending] < 2.0 * strain[bending])


def test_bar_p_against_the_uniform_beam() -> None:
    """Within 1.2 %: the rigid faces stiffen the ends, so that the bar bends a little nearer to its middle.

    By the law of the rigid turn half of what K_g22 L gains goes to K_g26, which is twelve times smaller.
    """
    c = bar_p.constants()
    beam = Segment.of(c, bar_p.MATERIAL, bar_p.LENGTH)
    expected = bar_p.entries(uniform_geometric_stiffness(beam, (c.Iy + c.Iz) / c.area))
    solid = bar_p.entries(axial_stiffness(bar_p.model(2)).geometric)
    names = list(bar_p.ENTRIES)
    limits = np.full(8, 3e-3)
    for name, limit in (
        ("K11", 6e-3),
        ("K26", 1.2e-2),
        ("K35", 1.4e-2),
        ("K44", 1e-2),
        ("K55", 9e-3),
        ("K66", 6e-3),
    ):
        limits[names.index(name)] = limit
    off = np.abs(solid / expected - 1.0)
    assert np.all(off < limits), dict(zip(names, off, strict=True))


def test_textbook_values_of_a_slender_beam() -> None:
    """6/(5L), 1/10, 2L/15 (Timoshenko & Gere) where neither shear nor the radius of gyration matters."""
    slender = Segment(100.0, 1e12, 3e4, 2e4, 1e4)
    k = uniform_geometric_stiffness(slender, 8.0)
    np.testing.assert_allclose(
        bar_p.entries(k), [0.01, 0.012, -0.1, 0.012, 0.1, 0.08, 40 / 3, 40 / 3], rtol=1e-6
    )
    # The law of the rigid turn holds with shear too.
    soft = uniform_geometric_stiffness(Segment(100.0, 1e6, 3e6, 2e6, 1e4, 5e3, 4e3), 8.0)
    assert 100 * soft[1, 1] + 2 * soft[1, 5] == pytest.approx(1.0, rel=1e-12)
    assert 100 * soft[2, 2] - 2 * soft[2, 4] == pytest.approx(1.0, rel=1e-12)


@pytest.mark.parametrize("warping", [0.0, 1e3, 1e5, 1e7])
def test_mean_square_twist_by_quadrature(warping: float) -> None:
    beam = Segment(100.0, 1e6, 1e4, 1e4, 1e4, EIw=warping)
    k = np.sqrt(beam.GJ / warping) if warping else 1e3

    def slope(x: float) -> float:
        # cosh a / cosh b without overflow.
        a, b = k * abs(x - 50.0), k * 50.0
        return float(1.0 - np.exp(a - b) * (1 + np.exp(-2 * a)) / (1 + np.exp(-2 * b)))

    mean = quad(slope, 0, 100, points=[0.05, 99.95], limit=400)[0] / 100
    square = quad(lambda x: slope(x) ** 2, 0, 100, points=[0.05, 99.95], limit=400)[0] / 100
    expected = square / mean**2 if warping else 1.0
    assert mean_square_twist(beam) == pytest.approx(expected, rel=1e-5)


def test_critical_load_from_the_two_matrices() -> None:
    """det(K_b - P K_g) = 0 over the guided tip is the one-element load, some per cent above the solid's."""
    k = found("plain")
    one = k.elastic[1, 1] / k.geometric[1, 1]
    solid = buckling(model("plain"), ("rx", "ry", "rz"), 1)[0].load
    # Rayleigh's quotient with the cubic shape: 10 EI / L² against π² EI / L², 1.3 % high.
    assert one / solid == pytest.approx(10 / np.pi**2, rel=3e-3)
    assert one > solid
