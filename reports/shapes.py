"""Buckling modes drawn from modes/<supports>.vtu: surfaces, and off-screen pictures."""

import ctypes
import io
import os
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize
from matplotlib.figure import Figure

from reports.errors import ReportError
from reports.formats import number
from reports.load import Json
from reports.style import INK

Floats = npt.NDArray[np.float64]

COLOURS = "cividis"
SHARE = 0.09
"""Largest drawn displacement of a bending mode, as a share of the bar's length."""

WINDOW, MARGIN = (1800, 1000), 12
"""Pixels of a picture in space, at most, and around what is drawn."""
LIGHT = {"ambient": 0.45, "diffuse": 0.6, "specular": 0.0, "smooth_shading": True}

VIEWS: dict[str, tuple[tuple[float, float, float], tuple[float, float, float]]] = {
    "xy": ((0.0, -0.35, 1.0), (0.0, 1.0, 0.0)),
    "xz": ((0.0, -1.0, 0.35), (0.0, 0.0, 1.0)),
    "torsion": ((-0.45, -1.0, 0.55), (0.0, 0.0, 1.0)),
}
"""Where the camera stands, seen from the bar, and which way is up, for each plane of deflection."""


@dataclass(frozen=True)
class Mode:
    """One mode of one support: displacement (n, 3) in mm, largest 1, on the points of its `Shapes`."""

    number: int
    plane: str
    load_N: float
    displacement: Floats

    @property
    def title(self) -> str:
        return f"mode {self.number}, {self.plane}, {number(self.load_N)} N"


@dataclass(frozen=True)
class Shapes:
    """The surface of the bar (a pyvista PolyData of triangles) and its modes under one kind of support."""

    supports: str
    surface: Any
    modes: Sequence[Mode]

    def scale(self, mode: Mode) -> float:
        """Factor on the displacement; a torsion mode is limited by the thickness, or it would wind up."""
        box = np.ptp(np.asarray(self.surface.points), axis=0)
        return 0.5 * max(box[1], box[2]) if mode.plane == "torsion" else SHARE * box[0]


def require_egl() -> None:
    """Raise ReportError where pyvista cannot draw: without libEGL it crashes with no exception."""
    if sys.platform != "linux":
        return
    try:
        ctypes.CDLL("libEGL.so.1")
    except OSError:
        raise ReportError(
            "shapes in space cannot be drawn without libEGL.so.1; on Debian the package libegl1 has it"
        ) from None
    os.environ.setdefault("VTK_DEFAULT_OPENGL_WINDOW", "vtkEGLRenderWindow")


def supports_of(result: Json) -> list[str]:
    """Supports of the solid bar's modes, in the order of the result."""
    return list(dict.fromkeys(item["supports"] for item in solid_modes(result)))


def solid_modes(result: Json) -> list[Json]:
    """The bar's modes that come from the solid model, which alone has shapes."""
    return [item for item in result["buckling"] if item["body"] == "bar" and item["model"] == "solid"]


def read(folder: Path, result: Json, supports: str) -> Shapes | None:
    """The shapes beside the result, None if they are not stored; ReportError if the file is unusable."""
    path = folder / "modes" / f"{supports}.vtu"
    if not path.is_file():
        return None
    import pyvista

    try:
        solid = pyvista.read(path)
    except Exception as error:
        raise ReportError(f"{path} is not a readable VTU file: {error}") from None
    # Faces of the quadratic cells are curved: by their corners alone a bent bar would be a polygon.
    surface = solid.extract_surface(nonlinear_subdivision=1, algorithm="dataset_surface").triangulate()
    modes = []
    for item in solid_modes(result):
        key = f"mode_{item['mode']}"
        if item["supports"] == supports and key in surface.point_data:
            shape = np.asarray(surface.point_data[key], dtype=float)
            modes.append(Mode(int(item["mode"]), item["plane"], float(item["load_N"]), shape))
    if not modes:
        raise ReportError(f"{path} has none of the point data mode_1 .. mode_6 that result.json lists")
    return Shapes(supports, surface, modes)


def picture(shapes: Shapes, count: int = 3) -> bytes:
    """The first modes stacked, coloured by the size of the displacement, as PNG."""
    modes = shapes.modes[:count]
    images = [render(shapes, mode) for mode in modes]
    width = 9.0
    heights = [width * image.shape[0] / image.shape[1] + 0.4 for image in images]
    figure = Figure(figsize=(width, sum(heights) + 0.7))
    grid = figure.add_gridspec(len(images), 1, height_ratios=heights, hspace=0.1, top=0.98, bottom=0.1)
    for row, (mode, image) in enumerate(zip(modes, images, strict=True)):
        ax = figure.add_subplot(grid[row])
        ax.imshow(image, interpolation="lanczos")
        ax.set_title(mode.title, fontsize=15, color=INK, loc="left")
        ax.axis("off")
    bar = figure.add_axes((0.3, 0.055, 0.4, 0.018))
    figure.colorbar(ScalarMappable(Normalize(0.0, 1.0), COLOURS), cax=bar, orientation="horizontal")
    bar.tick_params(labelsize=12)
    bar.set_xlabel("displacement / largest displacement", fontsize=12, color=INK)
    out = io.BytesIO()
    figure.savefig(out, format="png", dpi=110, bbox_inches="tight", metadata={"Software": None})
    return out.getvalue()


def render(shapes: Shapes, mode: Mode) -> npt.NDArray[np.uint8]:
    """One mode over the outline of the undeformed bar, cropped to what is drawn: pixels (rows, columns, 3)."""
    require_egl()
    import pyvista

    plotter = pyvista.Plotter(off_screen=True, window_size=WINDOW)
    try:
        plotter.set_background("white")
        bent = shapes.surface.copy()
        bent.points = np.asarray(bent.points) + shapes.scale(mode) * mode.displacement
        bent.clear_data()
        bent["size"] = np.linalg.norm(mode.displacement, axis=1)
        bent = bent.compute_normals(feature_angle=40.0, split_vertices=True)
        edges = shapes.surface.extract_feature_edges(30.0)
        plotter.add_mesh(edges, color="#98a2ac", line_width=2.0)
        plotter.add_mesh(bent, scalars="size", cmap=COLOURS, clim=(0.0, 1.0), show_scalar_bar=False, **LIGHT)
        plotter.enable_anti_aliasing("ssaa")
        direction, up = VIEWS.get(mode.plane, VIEWS["torsion"])
        plotter.view_vector(direction, viewup=up)
        plotter.enable_parallel_projection()
        plotter.reset_camera()
        plotter.camera.zoom(1.5)
        lower(plotter, np.vstack([bent.points, shapes.surface.points]))
        return crop(np.asarray(plotter.screenshot(return_img=True)))
    finally:
        plotter.close()


def lower(plotter: Any, points: Floats) -> None:
    """Make the window of a parallel projection no higher than what is drawn, (n, 3), at the same scale: a slender bar
    fills a strip of it, and every pixel costs as much as any other."""
    camera, (width, height) = plotter.camera, WINDOW
    forward = np.subtract(camera.focal_point, camera.position)
    side = np.cross(forward, camera.up)
    up = np.cross(side, forward)
    reach = np.abs((points - camera.focal_point) @ (up / np.linalg.norm(up))).max()
    half = int(np.ceil(0.5 * height * reach / camera.parallel_scale)) + 2 * MARGIN
    if half < height // 2:
        camera.parallel_scale *= 2.0 * half / height
        plotter.window_size = (width, 2 * half)


def crop(image: npt.NDArray[np.uint8], margin: int = MARGIN) -> npt.NDArray[np.uint8]:
    """The picture (rows, columns, 3) without its white border."""
    inked = np.min(image, axis=2) < 250
    if not inked.any():
        return image
    rows, columns = np.flatnonzero(inked.any(axis=1)), np.flatnonzero(inked.any(axis=0))
    top, left = max(0, rows[0] - margin), max(0, columns[0] - margin)
    return image[top : rows[-1] + margin + 1, left : columns[-1] + margin + 1]
