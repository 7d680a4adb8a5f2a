"""The refined bar: K_b given back, Euler's loads, shortening, an independent rod, accuracy at bench size."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.vjm.beams import BAR_P, SLENDER, Section, rod_load
from tests.vjm.strategies import LENGTH, WIDTH, angles, bar_stiffness, fixed_seed
from vjm import closed_forms, paper, stiffness
from vjm.critical import critical_load
from vjm.equilibrium import equilibrium
from vjm.mechanisms.bar import Bar
from vjm.mechanisms.parallelogram import Parallelogram
from vjm.refined import SEGMENTS, Refined, share_out

GUIDED = ("z", "rx", "ry", "rz")
CLAMPED = ("y", *GUIDED)


def entrywise(found: np.ndarray, expected: np.ndarray) -> float:
    """Largest difference of an entry relative to the geometric mean of its two diagonal entries."""
    diagonal = np.sqrt(np.diag(expected))
    return float(np.max(np.abs(found - expected) / np.outer(diagonal, diagonal)))


def stepped_bar(lug: float = 15.0, stiffer: float = 4.0) -> np.ndarray:
    """K_b of bar P with ends `lug` long and several times as stiff, the base's twice as long."""
    pieces = [(2 * lug, stiffer), (LENGTH - 3 * lug, 1.0), (lug, stiffer)]
    total, rest = np.zeros((6, 6)), LENGTH
    for size, factor in pieces:
        rest -= size
        move = np.eye(6)
        move[1, 5], move[2, 4] = rest, -rest
        total += move @ np.linalg.inv(BAR_P.stiffness(size)) @ move.T / factor
    return np.linalg.inv(total)


@fixed_seed(40)
@given(bar_stiffness(), angles, st.integers(1, 12))
def test_unloaded_stiffness_is_the_identified_one(k: np.ndarray, q: float, segments: int) -> None:
    assert entrywise(stiffness.unloaded_stiffness(Bar(LENGTH, k, bar=Refined(segments))), k) < 1e-9
    linkage = Parallelogram(LENGTH, WIDTH, k, q).refined(segments)
    expected, found = stiffness.closed_form(k, WIDTH, q), stiffness.unloaded_stiffness(linkage, q)
    assert stiffness.rank(found, LENGTH) == 5
    np.testing.assert_allclose(found, expected, atol=1e-9 * np.max(np.abs(expected)))


@pytest.mark.parametrize("segments", [1, 2, 4, 16])
def test_bars_that_are_not_uniform_are_given_back(segments: int) -> None:
    stepped = stepped_bar()
    # The elastic centre lies off the middle, and the ratio is below that of any uniform bar.
    assert -stepped[1, 5] / stepped[1, 1] < LENGTH / 2 - 1
    assert stepped[1, 1] * stepped[5, 5] / stepped[1, 5] ** 2 < 4 / 3
    generator = np.random.default_rng(3)
    scale = np.sqrt(np.diag(paper.BAR_STIFFNESS))
    square = generator.normal(size=(6, 6))
    coupled = scale[:, None] * (square @ square.T + np.eye(6)) * scale
    for k in (stepped, paper.BAR_STIFFNESS, coupled):
        assert entrywise(stiffness.unloaded_stiffness(Bar(LENGTH, k, bar=Refined(segments))), k) < 1e-9


def test_shares_of_a_uniform_bar_are_its_pieces() -> None:
    shares = share_out(LENGTH, BAR_P.stiffness(LENGTH), 5)
    piece = np.linalg.inv(BAR_P.stiffness(LENGTH / 5))
    move = np.eye(6)
    move[1, 5], move[2, 4] = -LENGTH / 10, LENGTH / 10
    for k in shares.stiffness:
        assert entrywise(np.linalg.inv(move @ piece @ move.T), k) < 1e-9
    np.testing.assert_allclose(shares.offset, 0, atol=1e-9 * LENGTH)


def in_plane(section: Section) -> Section:
    """Three times as stiff sideways, so that in plane buckling comes first."""
    return Section(section.ea, section.gj, section.ei_y, 9 * section.ei_z, section.ga_y, section.ga_z)


@pytest.mark.parametrize(("segments", "limit"), [(2, 0.02), (SEGMENTS, 0.005), (12, 0.004)])
def test_critical_loads_are_euler_loads(segments: int, limit: float) -> None:
    """Uniform bars with K22 and K33 of Eq. 12: 9.2, 36.9, 2.3 and 40.1 kN."""
    euler = closed_forms.euler_loads(SLENDER.ei_y, SLENDER.ei_z, LENGTH)
    np.testing.assert_allclose(
        [-euler.guided, -euler.clamped, -euler.cantilever, -euler.in_plane],
        [9.23e3, 36.9e3, 2.31e3, 40.1e3],
        rtol=2e-3,
    )
    cases = [
        (GUIDED, SLENDER, euler.guided),
        (CLAMPED, SLENDER, euler.clamped),
        (("z",), SLENDER, euler.cantilever),
        (CLAMPED, in_plane(SLENDER), euler.in_plane),
    ]
    for held, section, load in cases:
        linkage = Parallelogram(LENGTH, WIDTH, section.stiffness(LENGTH)).refined(segments)
        # The bars are not axially rigid: what is left at full refinement is P/EA.
        assert critical_load(linkage, held).load == pytest.approx(load, rel=limit)


def test_equation_12_buckles_as_a_flexible_length_between_rigid_ends() -> None:
    """K22, K26, K66 of Eq. 12 are those of EI_z over 304 mm between rigid ends: 2 pi² EI_z / 304²."""
    compliance = np.linalg.inv(paper.BAR_STIFFNESS)
    spread = compliance[1, 1] - compliance[1, 5] ** 2 / compliance[5, 5]
    flexible = np.sqrt(12 * spread / compliance[5, 5])
    assert flexible == pytest.approx(304.0, abs=0.05)
    expected = -2 * np.pi**2 / (flexible * compliance[5, 5])
    found = critical_load(Parallelogram(LENGTH, WIDTH, paper.BAR_STIFFNESS).refined(), GUIDED).load
    assert found == pytest.approx(expected, rel=2e-3)
    # The formula of a uniform bar with EI_z of K22 lies 2 % above it.
    uniform = closed_forms.euler_loads(SLENDER.ei_y, SLENDER.ei_z, LENGTH).guided
    assert found / uniform == pytest.approx(0.981, abs=2e-3)


def test_shear_lowers_the_critical_load_as_haringx_says() -> None:
    """J. A. Haringx, Philips Research Reports 3 (1948): P = (sqrt(1 + 4 P_E / GA) - 1) GA / 2."""
    soft = Section(1e9, 1e8, 2e8, 4.5e7, 2e5, 2e5)
    found = -critical_load(Parallelogram(LENGTH, WIDTH, soft.stiffness(LENGTH)).refined(16), GUIDED).load
    euler = np.pi**2 * soft.ei_z / LENGTH**2
    expected = 0.5 * soft.ga_y * (np.sqrt(1 + 4 * euler / soft.ga_y) - 1)
    assert found / 2 == pytest.approx(expected, rel=1e-3)
    assert found / 2 < 0.98 * euler


def test_twist_buckles_where_the_polar_radius_is_given() -> None:
    """H. Wagner 1929: GJ / i_p² for each bar; without the polar radius a twist does not shorten the bar."""
    section, radius = Section(7e6, 1e5, 4e8, 4e8), 12.0
    held = ("y", "z", "ry", "rz")
    bar = Bar(LENGTH, section.stiffness(LENGTH), bar=Refined(4, radius))
    found = critical_load(bar, held)
    assert -found.load == pytest.approx(section.gj / radius**2, rel=1e-6)
    plain = Bar(LENGTH, section.stiffness(LENGTH), bar=Refined(4))
    assert critical_load(plain, held, max_strain=2e-4).found is False


@pytest.mark.parametrize("k", [SLENDER.stiffness(LENGTH), paper.BAR_STIFFNESS], ids=["uniform", "Eq. 12"])
def test_a_guided_tip_moves_in_x_by_three_fifths_of_y_squared_over_the_length(k: np.ndarray) -> None:
    bar = Bar(LENGTH, k, tip="guided", bar=Refined())
    y = np.array([1.0, 3.0, 6.0])
    targets = np.tile(bar.unloaded_pose, (3, 1))
    targets[:, 0], targets[:, 1] = 0.0, y
    state = equilibrium(bar, targets, ("y", "z", *bar.held))
    assert np.all(state.converged)
    np.testing.assert_allclose(state.pose[:, 0] - LENGTH, -0.6 * y**2 / LENGTH, rtol=0.02)
    lumped = equilibrium(Bar(LENGTH, k), targets, ("y", "z", *bar.held))
    np.testing.assert_allclose(lumped.pose[:, 0], LENGTH, atol=1e-9)


BENCH = [
    [0.02, 8.0, 0.0, 0.0, 0.0, 0.03],
    [-0.1, 8.0, 2.0, 0.0, 0.001, 0.03],
    [-0.05, 8.0, 0.0, 0.06, 0.0, 0.03],
    [-0.1, 3.0, 2.0, 0.06, 0.0, -0.06],
]


@pytest.mark.parametrize("motion", BENCH)
@pytest.mark.parametrize("section", [BAR_P, SLENDER], ids=["bar P", "slender"])
def test_load_of_an_independent_geometrically_exact_rod(section: Section, motion: list[float]) -> None:
    expected = rod_load(section, LENGTH, np.array(motion))
    bar = Bar(LENGTH, section.stiffness(LENGTH), bar=Refined())
    found = equilibrium(bar, bar.unloaded_pose + motion).wrench
    assert np.max(np.abs(found - expected)[:3]) < 0.5
    # Moments: what a bar answers when its tip turns by 20 microradians and moves by 1 micrometre, and 1 N
    # at half the width of the section.
    k = bar.bar_stiffness
    slack = np.array([20e-6 * k[3, 3], 20e-6 * k[4, 4] + 1e-3 * k[2, 4], 20e-6 * k[5, 5] - 1e-3 * k[1, 5]])
    assert np.all(np.abs(found - expected)[3:] < slack + 6.0)


@pytest.mark.parametrize("degrees", [pytest.param(0, marks=pytest.mark.long), 30])
@pytest.mark.parametrize(
    "k",
    [pytest.param(BAR_P.stiffness(LENGTH), marks=pytest.mark.long), paper.BAR_STIFFNESS],
    ids=["bar P", "Eq. 12"],
)
def test_default_refinement_is_converged_at_bench_size(k: np.ndarray, degrees: int) -> None:
    """4 kN along x, rotations to 0.06 rad, held and loaded coordinates at random: 1 µm, 20 µrad, 1 N."""
    generator = np.random.default_rng(0)
    linkage = Parallelogram(LENGTH, WIDTH, k, np.radians(degrees))
    held = generator.random((80, 6)) < 0.5
    held[:, 0], held[:, 2] = False, True
    motion = generator.uniform(-1, 1, (80, 6)) * [0, 8, 15, 0.06, 0.002, 0.06]
    load = generator.uniform(-1, 1, (80, 6)) * [4000, 40, 0, 2000, 2000, 5000]
    # A platform that is free in y and rz buckles at 2 kN: pull it.
    free = ~(held[:, 1] | held[:, 5])
    load[free, 0] = np.abs(load[free, 0])
    targets = np.where(held, linkage.unloaded_pose + motion, load)
    fine = equilibrium(linkage.refined(16), targets, held)
    coarse = equilibrium(linkage.refined(), targets, held)
    # A bar's slope reaches 1.5 y / L besides the platform's own rotation.
    slope = np.maximum(np.max(np.abs(fine.pose[:, 3:]), axis=1), 1.5 * np.abs(fine.pose[:, 1]) / LENGTH)
    usable = fine.converged & (slope < 0.06)
    assert np.sum(usable) > 60 and np.all(coarse.converged[usable])
    moved = np.abs(coarse.pose - fine.pose)[usable]
    assert moved[:, :3].max() < 1e-3 and moved[:, 3:].max() < 20e-6
    assert np.abs(coarse.load - fine.load)[usable][:, :3].max() < 1.0


def test_a_bar_has_segments() -> None:
    with pytest.raises(ValueError, match="one segment or more"):
        Refined(0)
