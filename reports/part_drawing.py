"""A brought part to scale, in two views, from the surface that is stored with its modes."""

from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection
from matplotlib.figure import Figure

from reports.drafting import dimension, save
from reports.errors import ReportError
from reports.load import Json
from reports.style import FAINT

Floats = npt.NDArray[np.float64]

VIEWS = (("side view, x\u2013z", 2, 1, -1.0), ("top view, x\u2013y", 1, 2, 1.0))
"""Title, axis that points up, axis along which one looks, and from which side."""
LIT, DARK = np.array([0.88, 0.94, 0.98]), np.array([0.42, 0.53, 0.62])


def draw(folder: Path, record: Json) -> tuple[str, bytes] | None:
    """As (SVG, PNG) of a bar with this record; None where no modes are stored. ReportError for an unusable file."""
    path = folder / "modes" / "free.vtu"
    if not path.is_file():
        return None
    import pyvista

    try:
        surface = pyvista.read(path).extract_surface(algorithm="dataset_surface").triangulate()
    except Exception as error:
        raise ReportError(f"{path} is not a readable VTU file: {error}") from None
    figure = Figure(figsize=(11.0, 4.4))
    axes = figure.subplots(2, 1, sharex=True)
    for ax, view in zip(axes, VIEWS, strict=True):
        seen(ax, surface, float(record["length_mm"]), *view)
    return save(figure, "part")


def seen(ax: Axes, surface: Any, length: float, title: str, up: int, along: int, side: float) -> None:
    """One view: triangles that face it, the far ones first, shaded by how they stand; the axis and the length."""
    points = np.asarray(surface.points, dtype=float)
    corners = points[np.asarray(surface.faces).reshape(-1, 4)[:, 1:]]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    size = np.linalg.norm(normals, axis=1)
    facing = side * normals[:, along] / np.where(size > 0.0, size, 1.0)
    shown = np.flatnonzero(facing > 1e-6)
    shown = shown[np.argsort(side * corners[shown, :, along].mean(axis=1))]
    colours = DARK + facing[shown, None] * (LIT - DARK)
    flat = corners[shown][:, :, [0, up]]
    ax.add_collection(PolyCollection(list(flat), facecolors=colours, edgecolors=colours, linewidths=0.3))
    low, high = points.min(axis=0), points.max(axis=0)
    reach = 0.06 * (high[0] - low[0])
    ax.plot([low[0] - reach, high[0] + reach], [0.0, 0.0], color=FAINT, lw=0.7, ls=(0, (8, 3, 2, 3)))
    ax.text(high[0] + 1.3 * reach, 0.0, title, va="center", color=FAINT)
    if up == 2:
        top = (0.0, float(high[up])), (length, float(high[up]))
        dimension(ax, *top, 0.8 * reach, f"L = {length:g} mm", 0.5 * reach)
    ax.set_aspect("equal")
    ax.set_xlim(low[0] - 2 * reach, high[0] + 6 * reach)
    ax.set_ylim(low[up] - reach, high[up] + (3.0 if up == 2 else 1.0) * reach)
    ax.axis("off")
