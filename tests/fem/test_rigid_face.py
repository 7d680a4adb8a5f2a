"""Rigid faces and finite rotations: first and second derivatives against central differences at any pose."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.linalg import expm

from fem.linkage import Linkage, Member, parallelogram, single_bar
from fem.rigid_face import Face, PlatformPose, faces_of, to_bar_frame, to_base_frame
from fem.rotation import cross_matrix, rotation, rotation_vector
from tests.fem import bar_p

SHIFT = np.array([1.0, 2.0, 3.0])
KINDS = ["clamped on the ground", "hinged on the ground", "clamped on the platform", "hinged on the platform"]


def linkage(hinged: bool) -> Linkage:
    space = bar_p.space(1)
    return parallelogram(space, 310.0, 80.0, 0.4) if hinged else single_bar(space, 310.0)


def face(kind: str) -> tuple[Face, np.ndarray]:
    """A face and the platform point of its linkage; hinged ones with an axis that no base direction shares."""
    whole = linkage("hinged" in kind)
    m = whole.members[-1]
    axis = (0.36, 0.8, 0.48) if "hinged" in kind else None
    whole = Linkage((Member(m.space, m.origin, m.turn, m.tip_middle, axis, axis),), whole.point)
    return faces_of(whole)[0]["platform" in kind], whole.point


def moved(f: Face, point: np.ndarray, pose: PlatformPose, angle: float, step: np.ndarray) -> np.ndarray:
    """Positions after a step in the face's own coordinates."""
    platform = step[:6] if f.on_platform else np.zeros(6)
    turn = step[-1] if f.axis is not None else 0.0
    return f.place(pose.moved(platform), point, angle + turn).positions


vectors = st.lists(st.floats(-1.5, 1.5), min_size=3, max_size=3).map(np.array)


@settings(max_examples=6, derandomize=True, deadline=None, database=None)
@given(vectors, vectors, st.floats(-1.0, 1.0))
@pytest.mark.parametrize("kind", KINDS)
def test_derivatives(kind: str, position: np.ndarray, spin: np.ndarray, angle: float) -> None:
    f, point = face(kind)
    pose = PlatformPose(point + 20.0 * position, rotation(spin))
    place = f.place(pose, point, angle)
    size = len(f.columns)
    jacobian = place.jacobian()
    assert jacobian.shape == (len(f.nodes), 3, size)
    force = np.random.default_rng(0).standard_normal(place.positions.shape)
    h = 1e-5
    steps = h * np.eye(size)
    if not size:
        np.testing.assert_allclose(place.positions, f.rest, atol=1e-12)
        return
    numerical = np.stack(
        [(moved(f, point, pose, angle, s) - moved(f, point, pose, angle, -s)) / (2 * h) for s in steps],
        axis=-1,
    )
    np.testing.assert_allclose(jacobian, numerical, atol=1e-8 * 400)

    def work(step: np.ndarray) -> float:
        return float(np.sum(force * moved(f, point, pose, angle, step)))

    h = 1e-3
    second = np.zeros((size, size))
    for i, a in enumerate(h * np.eye(size)):
        for j, b in enumerate(h * np.eye(size)):
            second[i, j] = (work(a + b) - work(a - b) - work(b - a) + work(-a - b)) / (4 * h * h)
    curvature = place.curvature(force)
    # Central differences of a rotation leave h² of its fourth derivative.
    np.testing.assert_allclose(curvature, second, atol=3e-6 * np.abs(force).sum() * 20.0)
    np.testing.assert_array_equal(curvature, curvature.T)


def test_clamped_platform_face_is_rigid() -> None:
    """Distances do not change, and a pure translation moves every node alike."""
    f, point = face("clamped on the platform")
    turned = f.place(PlatformPose(point + SHIFT, rotation(np.array([0.3, -0.5, 0.9]))), point, 0.0)
    before = np.linalg.norm(f.rest[:, None] - f.rest[None], axis=2)
    after = np.linalg.norm(turned.positions[:, None] - turned.positions[None], axis=2)
    np.testing.assert_allclose(after, before, atol=1e-10)
    shifted = f.place(PlatformPose(point + SHIFT, np.eye(3)), point, 0.0)
    np.testing.assert_allclose(shifted.positions - f.rest, np.tile(SHIFT, (len(f.rest), 1)), atol=1e-12)


@settings(max_examples=20, derandomize=True, deadline=None, database=None)
@given(vectors)
def test_rotation_is_the_matrix_exponential(v: np.ndarray) -> None:
    r = rotation(v)
    np.testing.assert_allclose(r, expm(cross_matrix(v)), atol=1e-12)
    np.testing.assert_allclose(r @ r.T, np.eye(3), atol=1e-13)
    np.testing.assert_allclose(rotation_vector(r), v, atol=1e-7)


@pytest.mark.parametrize("size", [0.0, 1e-14, 1e-9, 1e-4, 3.1])
def test_rotation_vector_from_nothing_to_almost_half_a_turn(size: float) -> None:
    v = size * np.array([0.48, -0.6, 0.64])
    np.testing.assert_allclose(rotation_vector(rotation(v)), v, rtol=1e-9, atol=1e-15)


def test_frames_of_a_member() -> None:
    """To the base frame and back; the tip's middle is the member's tip."""
    member = parallelogram(bar_p.space(1), 310.0, 80.0, 0.5).members[0]
    points = np.random.default_rng(0).standard_normal((5, 3))
    np.testing.assert_allclose(to_bar_frame(member, to_base_frame(member, points)), points, atol=1e-12)
    np.testing.assert_allclose(to_base_frame(member, member.tip_middle), member.tip, atol=1e-12)
    np.testing.assert_allclose(member.tip, [310 * np.cos(0.5), 0.0, -310 * np.sin(0.5) - 40.0], atol=1e-9)
