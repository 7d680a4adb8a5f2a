"""A thinned surface is the same body with fewer points."""

import numpy as np
import pyvista

from reports.turntable import thin


def surface(lugs: bool) -> tuple[np.ndarray, np.ndarray]:
    """A swept bar 60 mm long, on request with a block of 5 mm at each end that is wider than the bar."""
    grid = pyvista.ImageData(dimensions=(61, 5, 5), origin=(0.0, -2.0, -2.0)).cast_to_unstructured_grid()
    x, y, _ = np.asarray(grid.cell_centers().points).T
    wide = (x < 5) | (x > 55) if lugs else np.ones(len(x), dtype=bool)
    solid = grid.extract_cells(np.flatnonzero(wide | (abs(y) < 1)))
    skin = solid.extract_surface(algorithm="dataset_surface").triangulate()
    return np.asarray(skin.points, dtype=float), np.asarray(skin.faces, dtype=np.int64).reshape(-1, 4)[:, 1:]


def area(points: np.ndarray, corners: np.ndarray) -> float:
    a, b, c = points[corners].transpose(1, 0, 2)
    return float(np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2)


def test_fewer_points_and_the_same_body() -> None:
    for lugs in (False, True):
        points, corners = surface(lugs)
        found = thin(points, corners, limit=300)
        assert len(found.points) <= 300 < len(points)
        kept = points[found.points]
        assert np.isclose(area(kept, found.corners), area(points, corners), rtol=1e-12)
        assert found.corners.min() == 0 and found.corners.max() == len(found.points) - 1


def test_a_bent_bar_keeps_stations_to_bend_at() -> None:
    points, corners = surface(lugs=True)
    found = thin(points, corners, limit=300)
    stations = np.unique(points[found.points][:, 0])
    assert np.diff(stations).max() < 12.0
    assert {0.0, 5.0, 55.0, 60.0} <= set(stations)


def test_a_small_surface_stays() -> None:
    points, corners = surface(lugs=True)
    found = thin(points, corners, limit=len(points))
    assert np.array_equal(found.points, np.arange(len(points)))
    assert np.array_equal(found.corners, corners)


def test_an_unswept_surface_stays() -> None:
    ball = pyvista.Icosphere(radius=5.0, nsub=2)
    points = np.asarray(ball.points, dtype=float) @ np.linalg.qr(np.vander([1.0, 2.0, 3.0]))[0]
    corners = np.asarray(ball.faces, dtype=np.int64).reshape(-1, 4)[:, 1:]
    found = thin(points, corners, limit=20)
    assert np.array_equal(found.points, np.arange(len(points)))
