"""Load paths of the parallelogram of bars P: start, past the critical point, perfect bars, refusals.

Platform free sideways but not turning (z rx ry rz held), q = 0, coarse mesh (3 057 unknowns a bar). Theory of the
bent branch: F = P_cr + P_cr / (2 L) (x - x_cr) with P_cr of both bars together, for inextensible bars whose ends are
guided; a bow e lowers it to F (1 - e / w) at the sway w (Southwell).
"""

from __future__ import annotations

import numpy as np
import pytest

from fem import path
from fem.buckling import Mode, buckling
from fem.factor import SolveError
from fem.linear import LinearModel, submatrix
from fem.path import Path, State, follow, residual_and_tangent, with_imperfection
from tests.fem import bar_p

BOW = 0.01
PUSH = (-0.002, -0.1, -0.3, -0.4)


@pytest.fixture(scope="module")
def straight() -> LinearModel:
    return bar_p.linkage_model(1, 0.0)


@pytest.fixture(scope="module")
def mode(straight: LinearModel) -> Mode:
    return buckling(straight, bar_p.GUIDED, 1)[0]


@pytest.fixture(scope="module")
def bowed(straight: LinearModel, mode: Mode) -> LinearModel:
    return LinearModel(with_imperfection(straight.linkage, mode.displacements, BOW), bar_p.MATERIAL)


@pytest.fixture(scope="module")
def pushed(bowed: LinearModel) -> Path:
    return follow(bowed, bar_p.GUIDED, PUSH)


def test_path_reaches_its_end_at_the_values_asked_for(pushed: Path) -> None:
    assert pushed.failure == ""
    np.testing.assert_allclose(pushed.column("displacement", "x"), PUSH, atol=1e-9)
    for name in bar_p.GUIDED:
        assert np.abs(pushed.column("displacement", name)).max() < 1e-12
    # y is free of load.
    assert np.abs(pushed.column("wrench", "y")).max() < 1e-3


def test_initial_slope_is_the_linear_model(pushed: Path, bowed: LinearModel, straight: LinearModel) -> None:
    slope = pushed.points[0].wrench[0] / PUSH[0]
    assert slope == pytest.approx(bowed.stiffness[0, 0], rel=1e-3)
    assert slope == pytest.approx(straight.stiffness[0, 0], rel=1e-3)


def test_before_the_critical_load_the_path_is_straight(pushed: Path, straight: LinearModel) -> None:
    assert pushed.points[1].wrench[0] == pytest.approx(straight.stiffness[0, 0] * PUSH[1], rel=2e-3)


def test_past_the_critical_load(pushed: Path, straight: LinearModel, mode: Mode) -> None:
    """The load of the bent branch, and its slope once the bow's share is taken out."""
    start = mode.load / straight.stiffness[0, 0]
    slope = mode.load / (2 * bar_p.LENGTH)
    sway = np.abs(pushed.column("displacement", "y"))
    load = -pushed.column("wrench", "x")
    corrected = load[2:] / (1 - BOW / (sway[2:] + BOW))
    expected = mode.load + slope * (-np.array(PUSH[2:]) - start)
    np.testing.assert_allclose(load[2:], expected, rtol=3e-3)
    np.testing.assert_allclose(corrected, expected, rtol=5e-4)
    assert sway[3] > sway[2] > 100 * BOW
    # Inextensible guided bar, w (1 - cos πx/L) / 2: Δ = π² w² / (16 L).
    shortening = -np.array(PUSH[2:]) - load[2:] / straight.stiffness[0, 0]
    np.testing.assert_allclose(sway[2:] + BOW, np.sqrt(16 * bar_p.LENGTH * shortening) / np.pi, rtol=2e-2)


def test_perfect_bars_end_at_their_bifurcation(straight: LinearModel, mode: Mode) -> None:
    """With a sentence, not with a crash or a point on the unstable branch."""
    found = follow(straight, bar_p.GUIDED, (-0.1, -0.4))
    assert len(found.points) == 1
    critical = mode.load / straight.stiffness[0, 0]
    assert found.failure.startswith("no equilibrium past x = -0.2")
    said = float(found.failure.split("x = ")[1].split(" mm")[0])
    # The smallest step is 1/256 of the asked one, 0.0012 mm; the path is a shade stiffer than its linear start.
    assert -said == pytest.approx(critical, abs=3 * 0.3 / 256)
    assert "unstable, a stable branch leaves the path before it" in found.failure


def test_unstable_branches_are_followed_where_asked(straight: LinearModel, mode: Mode) -> None:
    """The straight path of perfect bars past their bifurcation: both bars' sway is one unstable mode."""
    found = follow(straight, bar_p.GUIDED, (-0.1, -0.4), unstable_past=0.0)
    assert found.failure == ""
    assert [p.unstable for p in found.points] == [0, 1]
    slope = found.column("wrench", "x") / found.column("displacement", "x")
    np.testing.assert_allclose(slope, straight.stiffness[0, 0], rtol=3e-3)
    assert -found.points[1].wrench[0] > 1.5 * mode.load


@pytest.mark.long
def test_the_way_back_is_the_way_there(bowed: LinearModel) -> None:
    """An elastic linkage unloads along its loading curve, through the bend of the path."""
    found = follow(bowed, bar_p.GUIDED, (-0.15, -0.3, -0.15))
    assert found.failure == ""
    there, _, back = found.points
    np.testing.assert_allclose(back.wrench, there.wrench, rtol=1e-6, atol=1e-3)


@pytest.mark.long
def test_tangents_of_earlier_points_change_nothing(
    bowed: LinearModel, pushed: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Newton's method with its own tangents alone ends at the same points."""
    monkeypatch.setattr(path, "STALE", 0)
    found = follow(bowed, bar_p.GUIDED, PUSH)
    for quantity in ("displacement", "wrench"):
        mine = [getattr(p, quantity) for p in found.points]
        np.testing.assert_allclose(mine, [getattr(p, quantity) for p in pushed.points], rtol=1e-6, atol=1e-5)


def test_tension_stiffens_without_buckling(bowed: LinearModel, straight: LinearModel) -> None:
    """To twice the critical travel: F = EA e (1 + 3 e / 2 + e² / 2) of Saint Venant-Kirchhoff bars, e = x / L."""
    pull = np.array([0.2, 0.45])
    found = follow(bowed, bar_p.GUIDED, pull)
    assert found.failure == "" and [p.unstable for p in found.points] == [0, 0]
    strain = pull / bar_p.LENGTH
    # The bow, straightened, takes 1e-4 of the initial slope.
    law = straight.stiffness[0, 0] * pull * (1 + 1.5 * strain + 0.5 * strain**2)
    np.testing.assert_allclose(found.column("wrench", "x"), law, rtol=2e-4)
    # The difference to the straight line is seen, not lost in the tolerance.
    assert law[1] / (straight.stiffness[0, 0] * pull[1]) - 1 > 2e-3


def test_tangents_keep_their_pattern(bowed: LinearModel) -> None:
    """At rest, where symmetry makes entries vanish, and bent: the order of elimination found once serves all."""
    r = bowed.reduction
    rest = State(np.zeros(r.starts[-1]), r.rest)
    bent = rest.moved(0.01 * np.random.default_rng(3).standard_normal(r.size))
    one, two = (residual_and_tangent(bowed, state)[1] for state in (rest, bent))
    for part in ("indptr", "indices"):
        np.testing.assert_array_equal(getattr(one, part), getattr(two, part))
    free = r.others(["x", *bar_p.GUIDED])
    factor = bowed.solver(submatrix(one, free))
    if factor.name == "pardiso":
        assert factor.renewed(submatrix(two, free)) is factor


@pytest.mark.parametrize("degrees", [0.0, 30.0])
def test_tangent_is_the_derivative_of_the_residual(degrees: float) -> None:
    """At a bent, turned state far from equilibrium. Along a constant spin s, d/dt (r·s) is s·T·s."""
    model = bar_p.linkage_model(1, degrees)
    r = model.reduction
    rng = np.random.default_rng(12)
    there = State(np.zeros(r.starts[-1]), r.rest).moved(0.05 * rng.standard_normal(r.size))
    tangent = residual_and_tangent(model, there)[1]
    assert abs(tangent - tangent.T).max() < 1e-12 * abs(tangent).max()
    faces = np.arange(r.size) >= r.starts[-1]
    for _ in range(3):
        # Rigid faces alone: among thousands of inner nodes their curvature would not be seen.
        way = rng.standard_normal(r.size) * faces
        h = 1e-6
        ahead, behind = (residual_and_tangent(model, there.moved(s * h * way))[0] @ way for s in (1, -1))
        assert (ahead - behind) / (2 * h) == pytest.approx(way @ (tangent @ way), rel=1e-7)


@pytest.mark.parametrize("held", [("z", "ry"), ("y", "z", "rx", "rz")])
def test_partly_held_rotations_are_refused(straight: LinearModel, held: tuple[str, ...]) -> None:
    with pytest.raises(ValueError, match=r"held rotations are .*, allowed are all three or none"):
        follow(straight, held, (-0.1,))


def test_points_are_handed_out_as_they_come(straight: LinearModel) -> None:
    seen: list[float] = []
    found = follow(straight, bar_p.GUIDED, (-1e-3, -2e-3), on_point=lambda p: seen.append(p.wrench[0]))
    assert seen == [p.wrench[0] for p in found.points] and len(seen) == 2


def test_no_convergence_is_told(straight: LinearModel, monkeypatch: pytest.MonkeyPatch) -> None:
    """A solver that fails at every step: the path ends where it began and says so."""

    def fail(*_: object) -> None:
        raise SolveError("the linear system is singular")

    monkeypatch.setattr(path, "settle", fail)
    found = follow(straight, bar_p.GUIDED, (-0.1,))
    assert found.points == ()
    assert found.failure == "no equilibrium past x = 0 mm: the linear system is singular"


def test_imperfection_bends_every_bar_alike(straight: LinearModel, mode: Mode) -> None:
    """Largest shift is the amplitude, the linkage stays assembled: tips on the platform, bars parallel."""
    bent = with_imperfection(straight.linkage, mode.displacements, 0.5)
    before, after = straight.linkage.members[0].space.mesh, bent.members[0].space.mesh
    shift = np.linalg.norm(after.points - before.points, axis=1)
    assert shift.max() == pytest.approx(0.5, rel=1e-6)
    assert bent.members[0].space is bent.members[1].space
    middle = np.mean([m.tip for m in bent.members], axis=0)
    np.testing.assert_allclose(bent.point, middle, atol=1e-9)
    for member in bent.members:
        tip = member.space.mesh.points[member.space.mesh.face_nodes("tip")]
        np.testing.assert_allclose((tip.min(axis=0) + tip.max(axis=0)) / 2, member.tip_middle, atol=1e-3)
