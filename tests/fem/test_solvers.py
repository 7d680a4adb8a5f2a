"""Solvers: agreement, singular systems, inertia, choice by size; an answer that is wrong must be an error."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
import scipy.sparse as sp

from fem import pardiso, solvers
from fem.coarse_space import linear_in_quadratic, prolongation
from fem.factor import Factor, SolveError, checked
from fem.linear import LinearModel, submatrix
from fem.linkage import PLATFORM
from fem.multigrid import MultigridFactor
from fem.pardiso import PardisoFactor, SinglePardisoFactor, TooLarge, has_pardiso
from fem.rigid_motions import rigid_motions
from fem.solvers import SuperLUFactor, automatic, direct, multigrid
from tests.fem import bar_p

needs_pardiso = pytest.mark.skipif(not has_pardiso(), reason="pypardiso is not installed on this platform")
FACTORS = [pytest.param(PardisoFactor, marks=needs_pardiso), SuperLUFactor]
Make = Callable[[sp.csr_matrix], Factor]


def indefinite(seed: int, n: int = 60) -> sp.csr_matrix:
    """Sparse symmetric with eigenvalues of both signs, away from zero."""
    rng = np.random.default_rng(seed)
    a = sp.random(n, n, 0.1, random_state=rng, data_rvs=rng.standard_normal)
    return sp.csr_matrix(a + a.T + sp.diags(rng.choice([-3.0, 3.0], n)))


@needs_pardiso
def test_both_solve_alike() -> None:
    """To 1e-10; a bar's matrix, of condition 1e8, to 1e-9."""
    regular = indefinite(5, 400)
    rhs = np.random.default_rng(0).standard_normal((400, 3))
    one, other = (make(regular)(rhs) for make in (PardisoFactor, SuperLUFactor))
    assert np.abs(one - other).max() < 1e-10 * np.abs(other).max()
    model = bar_p.model(1)
    free = model.reduction.others(bar_p.ALL_BUT_X)
    k = model.reduced[free][:, free].tocsr()
    rhs = np.random.default_rng(0).standard_normal((k.shape[0], 3))
    one, other = (make(k)(rhs) for make in (PardisoFactor, SuperLUFactor))
    assert np.abs(one - other).max() < 1e-9 * np.abs(other).max()


@pytest.mark.parametrize("make", FACTORS)
def test_solution_of_one_and_of_many_right_hand_sides(make: Make) -> None:
    k = indefinite(3)
    rhs = np.random.default_rng(1).standard_normal((k.shape[0], 4))
    factor = make(k)
    expected = np.linalg.solve(k.toarray(), rhs)
    np.testing.assert_allclose(factor(rhs), expected, rtol=1e-9, atol=1e-9 * np.abs(expected).max())
    single = factor(rhs[:, 2].copy())
    assert single.shape == (k.shape[0],)
    np.testing.assert_allclose(single, expected[:, 2], rtol=1e-9, atol=1e-9 * np.abs(expected).max())


@pytest.mark.parametrize("make", FACTORS)
@pytest.mark.parametrize("kind", ["empty row", "free body", "null space of rank one"])
def test_singular_is_an_error(make: Make, kind: str) -> None:
    if kind == "empty row":
        dense = np.diag([1.0, 2.0, 0.0, 4.0])
    elif kind == "null space of rank one":
        dense = np.diag([2.0] * 6) - np.diag([1.0] * 5, 1) - np.diag([1.0] * 5, -1)
        dense[0, 0] = dense[5, 5] = 1.0
    else:
        model = bar_p.model(1)
        dense = model.matrices[0]
    k = sp.csr_matrix(dense)
    # A load that the null space feels.
    rhs = np.random.default_rng(0).standard_normal(k.shape[0])
    with pytest.raises(SolveError):
        make(k)(rhs)


@pytest.mark.parametrize("make", FACTORS)
@pytest.mark.parametrize("seed", range(12))
def test_inertia(make: Make, seed: int) -> None:
    """The count of negative eigenvalues, or an honest refusal; for SuperLU only where it left the diagonal."""
    k = indefinite(seed)
    expected = int(np.count_nonzero(np.linalg.eigvalsh(k.toarray()) < 0.0))
    assert 0 < expected < k.shape[0]
    try:
        found = make(k).negative_eigenvalues
    except SolveError as error:
        assert make is SuperLUFactor, "pardiso has the inertia of every regular matrix"
        assert "left the diagonal" in str(error)
        return
    assert found == expected


# Small matrices are counted by both, above.
@pytest.mark.parametrize("make", [FACTORS[0], pytest.param(SuperLUFactor, marks=pytest.mark.long)])
def test_inertia_of_a_bar_past_its_critical_load(make: Make) -> None:
    """The matrices that matter: K shifted by a multiple of its own mass-like diagonal, three modes below zero."""
    model = bar_p.model(1)
    free = model.reduction.others(bar_p.ALL_BUT_X)
    k = model.reduced[free][:, free].tocsr()
    assert make(k).negative_eigenvalues == 0
    lowest = np.linalg.eigvalsh(k.toarray())[:6]
    shifted = (k - (0.5 * (lowest[2] + lowest[3])) * sp.eye(k.shape[0])).tocsr()
    assert make(shifted).negative_eigenvalues == 3


@pytest.mark.parametrize("make", FACTORS)
@pytest.mark.parametrize("bad", [np.nan, np.inf])
def test_not_finite_right_hand_side(make: Make, bad: float) -> None:
    k = sp.csr_matrix(np.diag([1.0, 2.0, 3.0]))
    with pytest.raises(SolveError), np.errstate(invalid="ignore"):
        make(k)(np.array([1.0, bad, 0.0]))


def test_wrong_answer_is_an_error() -> None:
    k = sp.csr_matrix(np.diag([1.0, 2.0]))
    rhs = np.array([1.0, 2.0])
    x, residual = checked(k, rhs, np.array([1.0, 1.0]), 2.0)
    np.testing.assert_array_equal(x, [1.0, 1.0])
    assert residual == 0.0
    with pytest.raises(SolveError, match=r"solved only to a residual of 0\.02 on a load of 2"):
        checked(k, rhs, np.array([1.0, 1.01]), 2.0)
    with pytest.raises(SolveError, match="singular to working precision"):
        checked(k, rhs, np.array([1e14, 1.0]), 2.0)
    with pytest.raises(SolveError, match="no finite solution"):
        checked(k, rhs, np.array([np.nan, 1.0]), 2.0)


def test_direct_takes_the_fastest_that_is_there(monkeypatch: pytest.MonkeyPatch) -> None:
    k = sp.csc_matrix(np.diag([1.0, 2.0]))
    assert direct(k).name == ("pardiso" if has_pardiso() else "SuperLU")
    monkeypatch.setattr("fem.solvers.has_pardiso", lambda: False)
    assert direct(k).name == "SuperLU"


@pytest.mark.parametrize("kind", ["bar", pytest.param("linkage", marks=pytest.mark.long)])
def test_multigrid_solves_like_the_direct_solver(kind: str) -> None:
    """To its tolerance of 1e-11 on the residual times a condition of 1e8 of which the smoother takes most."""
    model = bar_p.model(1) if kind == "bar" else bar_p.linkage_model(1, 30.0)
    free = model.reduction.others(("x", "z"))
    k = submatrix(model.reduced, free)
    rhs = np.random.default_rng(0).standard_normal((k.shape[0], 2))
    one, other = direct(k), multigrid(k, lambda: prolongation(model.reduction, free))
    expected = one(rhs)
    assert np.abs(other(rhs) - expected).max() < 1e-6 * np.abs(expected).max()
    np.testing.assert_allclose(other(rhs[:, 0]), other(rhs)[:, 0], atol=1e-6 * np.abs(expected).max())
    assert other.record.solver == "multigrid" and 20 < other.record.iterations < 200
    assert other.record.right_hand_sides == 5 and one.record.iterations == 0
    with pytest.raises(SolveError, match="inertia is not available"):
        _ = other.negative_eigenvalues


def test_stiffness_by_multigrid() -> None:
    """K_b is an energy: the error of the motions enters squared."""
    model = bar_p.model(1)
    other = LinearModel(model.linkage, model.material, multigrid)
    np.testing.assert_allclose(bar_p.entries(other.stiffness), bar_p.entries(model.stiffness), rtol=1e-8)


def test_multigrid_refuses_what_is_not_held() -> None:
    model = bar_p.model(1, pinned=True)
    free = model.reduction.others(("x",))
    loose = multigrid(submatrix(model.reduced, free), lambda: prolongation(model.reduction, free))
    with pytest.raises(SolveError):
        loose(np.random.default_rng(0).standard_normal(len(free)))
    negative = sp.csr_matrix(np.diag([1.0, -2.0]))
    with pytest.raises(SolveError, match="not positive definite"):
        MultigridFactor(negative, sp.csr_matrix(np.eye(2)), direct)
    with pytest.raises(ValueError, match="needs the coarse space"):
        multigrid(negative)


@pytest.mark.parametrize("tetrahedra", [False, True])
def test_rigid_motions_are_in_the_coarse_space(tetrahedra: bool) -> None:
    """And every linear field: node values come back from corner values alone."""
    mesh = bar_p.mesh(1, tetrahedra)
    matrix, corners = linear_in_quadratic(mesh)
    assert len(corners) < 0.35 * len(mesh.points)
    motions = rigid_motions(mesh.points).reshape(-1, 3, 6)
    for axis in range(3):
        np.testing.assert_allclose(matrix @ motions[corners, axis], motions[:, axis], atol=1e-9)


def three() -> sp.csr_matrix:
    return sp.csr_matrix(np.diag([1.0, 2.0, 3.0]))


def test_choice_by_size(monkeypatch: pytest.MonkeyPatch) -> None:
    """Direct for the small; without pardiso multigrid for the large where there is a coarse space."""
    assert automatic(three(), three).name == direct(three()).name
    monkeypatch.setattr(solvers, "has_pardiso", lambda: False)
    monkeypatch.setattr(solvers, "LARGE", 2)
    assert automatic(three(), three).name == "multigrid"
    assert automatic(three()).name == "SuperLU"
    np.testing.assert_allclose(automatic(three(), three)(np.ones(3)), [1.0, 0.5, 1 / 3], rtol=1e-9)


@needs_pardiso
def test_choice_by_memory(monkeypatch: pytest.MonkeyPatch) -> None:
    """What the analysis foretells has to be free."""
    monkeypatch.setattr(solvers, "SINGLE", 2)
    assert (automatic(three()).name, automatic(three(), few=True).name) == (
        "pardiso",
        "pardiso in single precision",
    )
    kept = automatic(bar_p.model(1).reduced + sp.eye(bar_p.model(1).reduction.size)).forecast
    assert 2**20 < kept < 2**28
    # Of the factor in either precision, then of multigrid's own of its coarse space, then of the factors again.
    there = iter((1, 1, 2**40, 1, 2**40, 1, 2**40, 1, 1))
    monkeypatch.setattr(pardiso, "free_memory", lambda: next(there))
    monkeypatch.setattr(pardiso, "ALWAYS_THERE", 0)
    assert automatic(three(), three).name == "multigrid"
    assert automatic(three(), three).name == "pardiso in single precision"
    assert automatic(three(), three, few=True).name == "multigrid"
    with pytest.raises(TooLarge, match=r"3 unknowns takes 0\.0 GiB of memory, of which 0\.0 are free"):
        automatic(three())


@needs_pardiso
def test_single_precision_and_iterations_are_double_precision() -> None:
    """A bar's matrix, of condition 1e8, to 1e-7; its stiffness, an energy, to 1e-11."""
    model = bar_p.model(1)
    free = model.reduction.others(PLATFORM)
    k = submatrix(model.reduced, free)
    rhs = np.random.default_rng(0).standard_normal((k.shape[0], 3))
    rhs[:, 1] = 0.0
    factor = SinglePardisoFactor(k)
    found, expected = factor(rhs), PardisoFactor(k)(rhs)
    assert np.abs(found - expected).max() < 1e-7 * np.abs(expected).max()
    assert factor.handed.dtype == np.float32 and 3 < factor.iterations < 15
    with pytest.raises(SolveError, match="inertia is not available"):
        _ = factor.negative_eigenvalues
    again = factor.renewed(sp.csr_matrix(2.0 * k))
    np.testing.assert_allclose(again(rhs), 0.5 * expected, atol=1e-7 * np.abs(expected).max())
    single = LinearModel(
        model.linkage, model.material, lambda matrix, _=None: SinglePardisoFactor(matrix.tocsr())
    )
    np.testing.assert_allclose(bar_p.entries(single.stiffness), bar_p.entries(model.stiffness), rtol=1e-11)
    assert single.solved_by == "pardiso in single precision"


@needs_pardiso
def test_what_single_precision_does_not_hold_is_factorised_in_double() -> None:
    """A beam by differences, of condition n^4; and a matrix that nothing holds is an error by either."""
    n = 1500
    second = sp.diags([np.ones(n - 1), np.full(n, -2.0), np.ones(n - 1)], [-1, 0, 1])
    beam = sp.csr_matrix(second @ second)
    factor = SinglePardisoFactor(beam)
    assert factor.name == "pardiso" and factor.handed.dtype == np.float64
    np.testing.assert_array_equal(factor(np.ones(n)), PardisoFactor(beam)(np.ones(n)))
    assert factor.negative_eigenvalues == 0
    with pytest.raises(SolveError):
        SinglePardisoFactor(bar_p.model(1).matrices[0]).require_held()


@pytest.mark.parametrize("make", FACTORS)
def test_record(make: Make) -> None:
    k = indefinite(3)
    factor = make(k)
    assert (factor.record.unknowns, factor.record.nonzeros) == (k.shape[0], k.nnz)
    assert factor.record.right_hand_sides == 0
    factor(np.ones((k.shape[0], 4)))
    factor(np.ones(k.shape[0]))
    record = factor.record
    assert record.solver == factor.name and record.right_hand_sides == 5
    assert record.setup_seconds > 0.0 and record.solve_seconds > 0.0
    assert 0.0 <= record.residual < 1e-10


@pytest.mark.parametrize("make", FACTORS)
def test_renewed_factor(make: Make) -> None:
    """Of a matrix with the same pattern, and of one with another."""
    k = indefinite(3)
    rhs = np.random.default_rng(1).standard_normal(k.shape[0])
    for other in (2.0 * k + sp.diags(k.diagonal()), indefinite(4)):
        other = sp.csr_matrix(other)
        factor = make(k).renewed(other)
        np.testing.assert_allclose(factor(rhs), np.linalg.solve(other.toarray(), rhs), rtol=1e-8, atol=1e-9)
        if make is PardisoFactor:
            negative = int(np.count_nonzero(np.linalg.eigvalsh(other.toarray()) < 0.0))
            assert factor.negative_eigenvalues == negative
