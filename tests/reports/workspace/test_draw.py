"""Pictures of a sweep from a made-up folder: what is on the slices, what has an isosurface, what is refused."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from reports.errors import ReportError
from reports.workspace import isosurface, slices
from reports.workspace.draw import draw, surfaces
from reports.workspace.read import read

COLUMNS = ["x_mm", "y_mm", "z_mm", "state", "K_tran_min", "critical_factor", "displacement_error"]


def folder(path: Path, counts: tuple[int, int, int] = (5, 4, 3)) -> Path:
    """A sweep whose K_tran_min is 1000 + x + 10 y + 100 z, out of reach where x is lowest, lost where y is lowest."""
    low, high = (-20.0, -15.0, -10.0), (20.0, 15.0, 10.0)
    axes = [np.linspace(a, b, n) for a, b, n in zip(low, high, counts, strict=True)]
    x, y, z = (each.ravel() for each in np.meshgrid(*axes, indexing="ij"))
    state = (
        np.where(x == axes[0][0], 1.0, np.where(y == axes[1][0], 3.0, 0.0)) if min(counts) > 1 else 0.0 * x
    )
    values = np.stack(
        [x, y, z, state, 1000.0 + x + 10.0 * y + 100.0 * z, 0.0 * x + np.inf, 0.05 + 0.001 * x], -1
    )
    path.mkdir(parents=True, exist_ok=True)
    np.save(path / "sweep.npy", values)
    head = {
        "manipulator": "made <up>",
        "grid": {"low": low, "high": high, "counts": counts},
        "columns": COLUMNS,
        "wrench": [1.0, 0.0, 0.0, 0.0, 0.0, 0.0],
        "effects": {"modulus_error": {"scale": 0.8}},
    }
    (path / "sweep.json").write_text(json.dumps(head), encoding="utf-8")
    return path


def test_fields_lie_on_their_axes(tmp_path: Path) -> None:
    space = read(folder(tmp_path))
    field = space.field("K_tran_min")
    assert field.shape == (5, 4, 3)
    x, y, z = np.meshgrid(*space.axes, indexing="ij")
    expected = 1000.0 + x + 10.0 * y + 100.0 * z
    # Out of reach there is no number; under a wrench that is not borne there is one at rest.
    assert np.isnan(field[0]).all()
    np.testing.assert_allclose(field[1:], expected[1:])
    error = space.field("displacement_error")
    assert np.isnan(error[:, 0]).all()
    np.testing.assert_allclose(error[1:, 1:], (5.0 + 0.1 * x)[1:, 1:])
    np.testing.assert_array_equal(space.field("critical_factor")[1:, 1:], 0.0)
    assert space.title == "made <up>, under 1 0 0 0 0 0 (N, N·mm), modulus_error scale 0.8"


def test_slices_go_through_the_middle(tmp_path: Path) -> None:
    space = read(folder(tmp_path))
    planes = slices.slices(space)
    assert [p.title for p in planes] == ["z = 0 mm", "y = 5 mm", "x = 0 mm"]
    np.testing.assert_allclose(planes[2].of(space, "K_tran_min"), space.field("K_tran_min")[2])
    flat = read(folder(tmp_path / "flat", (5, 4, 1)))
    assert [p.title for p in slices.slices(flat)] == ["z = -10 mm"]


def test_pictures_are_written_beside_the_sweep(tmp_path: Path) -> None:
    written = draw(folder(tmp_path))
    names = ["slices.png", "isosurface_K_tran_min.png", "isosurface_displacement_error.png"]
    assert [path.name for path in written] == names
    for path in written:
        assert path.read_bytes().startswith(b"\x89PNG") and path.stat().st_size > 20_000


def test_a_line_has_no_slices_and_a_plane_no_isosurface(tmp_path: Path) -> None:
    line, flat = read(folder(tmp_path / "line", (5, 1, 1))), read(folder(tmp_path / "flat", (5, 4, 1)))
    assert slices.draw(line) == b"" and slices.draw(flat).startswith(b"\x89PNG")
    assert isosurface.draw(flat, "K_tran_min") == b""
    # What is the same everywhere has no surface either.
    assert isosurface.draw(read(folder(tmp_path / "box")), "critical_factor") == b""
    assert surfaces(flat) == ["K_tran_min", "displacement_error"]


def test_what_is_no_sweep_is_refused(tmp_path: Path) -> None:
    with pytest.raises(ReportError, match="holds no finished sweep"):
        draw(tmp_path)
    damaged = folder(tmp_path / "damaged")
    np.save(damaged / "sweep.npy", np.zeros((7, len(COLUMNS))))
    with pytest.raises(ReportError, match="holds no readable sweep"):
        draw(damaged)
