"""K_b of solid bars: structure, the yardstick of bar P, the beam oracle, tetrahedra, scaling laws, virtual experiments.

Where a solid differs from a beam: the rigid end faces hold the Poisson contraction (K11 and the bending entries some
0.3 to 0.8 % up) and the warping (K44 9 to 10 % above GJ/L).
"""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fem.beam import Segment, one_end_warping_factor, stepped_stiffness
from fem.convergence import extrapolate
from fem.factor import SolveError
from fem.linear import LinearModel
from fem.linkage import PLATFORM, single_bar
from fem.material import Isotropic
from fem.section_constants import section_constants
from fem.solvers import SuperLUFactor, direct
from fem.space import Space
from fem.stiffness import bar_stiffness
from fem.virtual_experiments import virtual_experiments
from meshes.bar import Bar, Lug
from meshes.resolution import Resolution
from meshes.section import ISection, Rectangle
from meshes.solid import Floats, SolidMesh
from meshes.store import mesh_bar
from tests.fem import bar_p

# K11 K22 K26 K33 K35 K44 K55 K66 of bar P on uniform meshes of 20k, 101k and 301k unknowns (origin: bar_p.py).
UNIFORM_20K = np.array([22036.2, 19.6717, -3049.11, 78.7048, 12199.2, 33420, 2528089, 629612])
UNIFORM_101K = np.array([22010.2, 19.5774, -3034.49, 78.4052, 12152.8, 33173, 2520084, 627098])
UNIFORM_301K = np.array([22004.5, 19.5558, -3031.15, 78.3384, 12142.5, 33090, 2518302, 626524])
# Timoshenko with GJ/L and rigid shear areas of the yardstick (59.7, 51.8 mm²; J 357.4 mm⁴).
TIMOSHENKO = np.array([21948.4, 19.460, -3016.2, 77.888, 12072.7, 30339, 2506300, 623950])
K44 = list(bar_p.ENTRIES).index("K44")

# This program on 18 063 unknowns, November 2026: pardiso and SuperLU agree on it to 1e-9. A regression, no oracle.
LEVEL_2 = np.array(
    [22007.033, 19.575232, -3034.1610, 78.379865, 12148.879, 33406.825, 2519366.61, 627011.491]
)


def within(share: float, torsion: float) -> Floats:
    """Allowed relative differences of the eight entries, K44 with its own."""
    limits = np.full(8, share)
    limits[K44] = torsion
    return limits


def assert_within(found: Floats, expected: Floats, limits: Floats) -> None:
    off = np.abs(found / expected - 1.0)
    assert np.all(off < limits), dict(zip(bar_p.ENTRIES, off, strict=True))


def stiffness_of(bar: Bar, resolution: Resolution, material: Isotropic = bar_p.MATERIAL) -> Floats:
    return bar_stiffness(mesh_bar(bar, resolution), bar.length, material)


@pytest.mark.parametrize("level", [1, 2])
def test_structure(level: int) -> None:
    """Symmetric before it is symmetrised, positive definite, nothing but the two coupled blocks."""
    model = bar_p.model(level)
    unit = model.motions(PLATFORM, ())
    raw = bar_p.scaled(unit.T @ (model.reduced @ unit))
    assert np.abs(raw - raw.T).max() < 1e-9
    scaled = bar_p.scaled(model.stiffness)
    assert np.linalg.eigvalsh(scaled)[0] > 0.01
    coupled = np.eye(6, dtype=bool)
    for i, j in ((1, 5), (2, 4)):
        coupled[i, j] = coupled[j, i] = True
    assert np.abs(scaled[~coupled]).max() < 1e-8
    assert scaled[1, 5] < -0.8 and scaled[2, 4] > 0.8


def test_yardstick_of_bar_p() -> None:
    """18 063 unknowns, graded towards the ends, stand where a uniform mesh stands with 101k."""
    found = bar_p.entries(bar_p.model(2).stiffness)
    # The uniform mesh of as many unknowns is itself up to 0.6 % from its limit (K22).
    assert_within(found, UNIFORM_20K, within(6e-3, 1.5e-2))
    assert_within(found, UNIFORM_101K, within(1e-3, 1.5e-2))
    assert np.all(np.abs(found - UNIFORM_301K) < np.abs(UNIFORM_20K - UNIFORM_301K))


@pytest.mark.long
def test_extrapolated_bar_p() -> None:
    """Three nested meshes to their limit, against 301k unknowns; conforming elements come from above."""
    values = np.array([bar_p.entries(bar_p.model(level).stiffness) for level in (1, 2, 3)])
    found = [extrapolate([3.0, 1.5, 1.0], column.tolist()) for column in values.T]
    # In K44 level 1 has one cell across a flange, too coarse to extrapolate from, and 301k unknowns still fall.
    assert_within(np.array([f.limit for f in found]), UNIFORM_301K, within(1e-3, 1.2e-2))
    assert np.all(np.diff(np.abs(values), axis=0) < 0.0)


def test_regression_of_bar_p() -> None:
    assert_within(bar_p.entries(bar_p.model(2).stiffness), LEVEL_2, within(1e-3, 1e-3))


def test_other_solver_gives_the_same(coarse: SolidMesh) -> None:
    other = bar_stiffness(coarse, bar_p.LENGTH, bar_p.MATERIAL, lambda m, _=None: SuperLUFactor(m.tocsr()))
    scaled = bar_p.scaled(bar_p.model(1).stiffness) - bar_p.scaled(other)
    np.testing.assert_allclose(bar_p.entries(other), bar_p.entries(bar_p.model(1).stiffness), rtol=1e-8)
    assert np.abs(scaled).max() < 1e-8


def test_bar_p_against_timoshenko() -> None:
    """The printed oracle, then ours with Vlasov's restrained warping: K44 comes down from 10 % to under 1.5 %."""
    solid = bar_p.entries(bar_p.model(2).stiffness)
    assert_within(solid, TIMOSHENKO, within(8e-3, 0.11))
    beam = Segment.of(bar_p.constants(), bar_p.MATERIAL, bar_p.LENGTH)
    oracle = bar_p.entries(stepped_stiffness([beam]))
    # The shear area at nu = 0.33 and a converged J differ from the printed ones by 1.5 % and 0.2 %.
    no_warping = oracle.copy()
    no_warping[K44] = beam.GJ / beam.length
    assert_within(no_warping, TIMOSHENKO, within(1e-3, 2e-3))
    assert_within(solid, oracle, within(8e-3, 1.5e-2))
    assert solid[K44] / no_warping[K44] > 1.09


def test_rectangle_against_timoshenko() -> None:
    """The paper's length with a plain rectangle, where Timoshenko's beam is textbook."""
    bar = Bar(Rectangle(8.0, 14.0), 310.0)
    solid = bar_p.entries(stiffness_of(bar, Resolution(7.0, 2)))
    segment = Segment.of(section_constants(bar.section, 0.33), bar_p.MATERIAL, bar.length)
    oracle = bar_p.entries(stepped_stiffness([segment]))
    # The rigid faces hold the Poisson contraction, as if the bar were 0.3 % shorter: once in K11, three times in K22.
    assert_within(solid, oracle, within(1.2e-2, 2e-3))
    bending = np.arange(8) != K44
    assert np.all(np.abs(solid[bending]) > np.abs(oracle[bending]))


@cache
def by_tetrahedra(level: int) -> Floats:
    return bar_p.entries(bar_stiffness(bar_p.mesh(level, True), bar_p.LENGTH, bar_p.MATERIAL))


def test_tetrahedra_agree_with_hexahedra() -> None:
    """An independent mesh of bar P. The stress of held warping at the face edges wants finer tetrahedra than this."""
    assert_within(by_tetrahedra(1), bar_p.entries(bar_p.model(2).stiffness), within(7e-3, 4e-2))


@pytest.mark.long
def test_finer_tetrahedra_agree_better() -> None:
    assert_within(by_tetrahedra(2), bar_p.entries(bar_p.model(2).stiffness), within(1e-3, 2.5e-2))
    assert np.all(np.abs(by_tetrahedra(2)) < np.abs(by_tetrahedra(1)))


@pytest.mark.long
def test_fine_tetrahedra_agree_in_torsion_too() -> None:
    """138 000 unknowns: K44 1.8 % off, on its way down from 2.6 % (65 000) to 1.0 % (258 000)."""
    fine = bar_stiffness(bar_p.mesh(3, True), bar_p.LENGTH, bar_p.MATERIAL)
    assert_within(bar_p.entries(fine), bar_p.entries(bar_p.model(3).stiffness), within(7e-4, 2e-2))


def test_a_bar_that_is_not_held_is_refused() -> None:
    """Pinned at its base and driven along x alone it swings freely."""
    model = bar_p.model(1, pinned=True)
    with pytest.raises(SolveError, match="not held"):
        model.motions(("x",), ())
    with pytest.raises(ValueError, match="'rt' is unknown, allowed are x, y, z, rx, ry, rz"):
        model.motions(("rt",), ())


small_bars = st.builds(
    lambda b, h, t, w, length: Bar(ISection(b, t * h, h, w * b), length),
    st.floats(8.0, 14.0),
    st.floats(10.0, 18.0),
    st.floats(0.12, 0.3),
    st.floats(0.2, 0.6),
    st.floats(80.0, 200.0),
)
fixed_seed = settings(max_examples=4, derandomize=True, deadline=None, database=None)
COARSE = Resolution(8.0, 1)


@fixed_seed
@given(small_bars, st.floats(0.1, 10.0))
def test_modulus_scales_the_matrix(bar: Bar, factor: float) -> None:
    k = stiffness_of(bar, COARSE)
    stiffer = stiffness_of(bar, COARSE, Isotropic(70e3 * factor, 0.33))
    np.testing.assert_allclose(bar_p.entries(stiffer), factor * bar_p.entries(k), rtol=1e-9)


@fixed_seed
@given(small_bars, st.floats(0.3, 3.0))
def test_similar_bars(bar: Bar, s: float) -> None:
    """All lengths times s: translations by s, couplings by s², rotations by s³."""
    section = bar.section
    assert isinstance(section, ISection)
    larger = Bar(
        ISection(s * section.flange_width, s * section.flange_thickness, s * section.height, s * section.web),
        s * bar.length,
    )
    k, similar = stiffness_of(bar, COARSE), stiffness_of(larger, Resolution(8.0 * s, 1))
    power = np.repeat([0.5, 1.5], 3)
    expected = bar_p.entries(k * s ** np.add.outer(power, power))
    np.testing.assert_allclose(bar_p.entries(similar), expected, rtol=1e-7)


@fixed_seed
@given(st.floats(6.0, 14.0), st.floats(6.0, 14.0), st.floats(80.0, 200.0))
def test_turned_section_exchanges_the_planes(width: float, height: float, length: float) -> None:
    """R_x(90°) brings y to z and z to -y: K22 <-> K33, K66 <-> K55, K26 <-> -K35."""
    k = stiffness_of(Bar(Rectangle(width, height), length), COARSE)
    turned = stiffness_of(Bar(Rectangle(height, width), length), COARSE)
    quarter = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]])
    both = np.kron(np.eye(2), quarter)
    np.testing.assert_allclose(bar_p.entries(both @ k @ both.T), bar_p.entries(turned), rtol=1e-8)


def test_point_of_reference_moves_by_the_adjoint(coarse: SolidMesh) -> None:
    """Symmetric bar: about its middle the couplings vanish, which fixes K26 / K22 = -L/2 and K35 / K33 = L/2."""
    k = bar_p.model(1).stiffness
    assert -k[1, 5] / k[1, 1] == pytest.approx(155.0, rel=1e-8)
    assert k[2, 4] / k[2, 2] == pytest.approx(155.0, rel=1e-8)


def test_virtual_experiments_with_flush_lugs() -> None:
    """The second route: the free tip face may warp, so every entry is a little lower than the rigid tie's."""
    bar = Bar(bar_p.SECTION, bar_p.LENGTH, Lug(20.0, 12.0, 15.5))
    mesh = mesh_bar(bar, Resolution(6.0, 1))
    tied = bar_p.entries(bar_stiffness(mesh, bar.length, bar_p.MATERIAL))
    found = virtual_experiments(mesh, bar.length, bar_p.MATERIAL)
    assert_within(bar_p.entries(found.stiffness), tied, within(3e-2, 3e-2))
    assert np.all(np.abs(bar_p.entries(found.stiffness)) < np.abs(tied))
    assert np.all(found.leftover < 2e-2)


def test_virtual_experiments_free_the_warping_of_a_plain_bar(fine: SolidMesh) -> None:
    """Without lugs one end warps freely: Vlasov's factor on K44, the rest within 1 %."""
    found = bar_p.entries(virtual_experiments(fine, bar_p.LENGTH, bar_p.MATERIAL).stiffness)
    tied = bar_p.entries(bar_p.model(2).stiffness)
    factor = one_end_warping_factor(Segment.of(bar_p.constants(), bar_p.MATERIAL, bar_p.LENGTH))
    assert 1.04 < factor < 1.06
    assert tied[K44] / found[K44] == pytest.approx(factor, rel=5e-3)
    assert_within(found, tied, within(1e-2, 6e-2))


def test_compliance_of_the_virtual_experiments_is_symmetric(
    coarse: SolidMesh, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Seen before it is symmetrised: traction and fit are dual to one another."""
    seen: list[Floats] = []
    invert = np.linalg.inv

    def watch(matrix: Floats) -> Floats:
        seen.append(matrix)
        return np.asarray(invert(matrix))

    monkeypatch.setattr("fem.virtual_experiments.np.linalg.inv", watch)
    virtual_experiments(coarse, bar_p.LENGTH, bar_p.MATERIAL, direct)
    (compliance,) = (m for m in seen if m.shape == (6, 6))
    scaled = bar_p.scaled(compliance)
    assert np.abs(scaled - scaled.T).max() < 1e-8


def test_space_is_not_changed_by_its_use() -> None:
    """Two models of one space see the same arrays."""
    space = Space.of(bar_p.mesh(1))
    before = space.gradients.copy()
    first = LinearModel(single_bar(space, bar_p.LENGTH), bar_p.MATERIAL).stiffness
    np.testing.assert_array_equal(space.gradients, before)
    second = LinearModel(single_bar(space, bar_p.LENGTH), bar_p.MATERIAL).stiffness
    np.testing.assert_allclose(first, second, rtol=1e-12, atol=1e-6)
