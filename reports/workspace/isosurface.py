"""Isosurfaces of a quantity over the workspace: three nested levels, drawn off screen."""

from typing import Any

import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.colors import BoundaryNorm, ListedColormap
from matplotlib.figure import Figure

from reports.charts import picture
from reports.formats import number
from reports.shapes import crop, require_egl
from reports.style import CYCLE, FAINT, INK
from reports.workspace.read import LARGEST, QUANTITIES, Floats, Workspace

SHARES = (0.25, 0.5, 0.75)
"""Of the points with a lower value, at each level."""
OPACITY = 0.45
_SEEN_FROM = (1.0, -1.5, 0.8)


def draw(space: Workspace, name: str) -> bytes:
    """PNG of one quantity; b"" for a sweep that is no box, or where the quantity hardly changes. ReportError
    without libEGL."""
    if len(space.long) < 3:
        return b""
    steps = [max(1, -(-len(axis) // LARGEST)) for axis in space.axes]
    x, y, z = (slice(None, None, step) for step in steps)
    field = space.field(name, (x, y, z))
    found = field[np.isfinite(field)]
    if not found.size or np.ptp(found) <= 1e-9 * np.max(np.abs(found)):
        return b""
    levels = np.quantile(found, SHARES)
    axes = [axis[::step] for axis, step in zip(space.axes, steps, strict=True)]
    return framed(space, name, levels, render(axes, field, levels))


def render(axes: list[Floats], field: Floats, levels: Floats) -> Any:
    """The surfaces of a field (l, m, n) over three axes, (l,), (m,) and (n,) mm, at levels (k,) in their box, as pixels
    (rows, columns, 3)."""
    require_egl()
    import pyvista

    grid = pyvista.RectilinearGrid(*axes)
    grid["value"] = np.nan_to_num(field, nan=0.0).ravel(order="F")
    grid["found"] = np.isfinite(field).astype(float).ravel(order="F")
    # Cells at the edge of reach are left out whole, or they would get a surface of their own.
    inside = grid.threshold(0.5, scalars="found", all_scalars=True)
    plotter = pyvista.Plotter(off_screen=True, window_size=(1300, 1050))
    try:
        plotter.set_background("white")
        for level, colour in zip(levels, CYCLE, strict=False):
            surface = inside.contour([float(level)], scalars="value") if inside.n_cells else inside
            if surface.n_points:
                plotter.add_mesh(surface, color=colour, opacity=OPACITY, smooth_shading=True, specular=0.1)
        plotter.add_mesh(grid.outline(), color=FAINT, line_width=2.0)
        plotter.show_bounds(
            bounds=grid.bounds,
            xtitle="x, mm",
            ytitle="y, mm",
            ztitle="z, mm",
            font_size=14,
            fmt="%.0f",
            color=INK,
            location="outer",
            n_xlabels=3,
            n_ylabels=3,
            n_zlabels=3,
        )
        plotter.view_vector(_SEEN_FROM, viewup=(0.0, 0.0, 1.0))
        plotter.enable_anti_aliasing("ssaa")
        return crop(np.asarray(plotter.screenshot(return_img=True)))
    finally:
        plotter.close()


def framed(space: Workspace, name: str, levels: Floats, image: Any) -> bytes:
    """The picture (rows, columns, 3) with its title and a legend of the levels (k,)."""
    title, unit = QUANTITIES[name]
    width = 7.0
    figure = Figure(figsize=(width + 1.4, width * image.shape[0] / image.shape[1] + 0.7))
    ax = figure.add_axes((0.0, 0.0, 0.82, 0.9))
    ax.imshow(image, interpolation="lanczos")
    ax.axis("off")
    ax.set_title(f"{title}\n{space.title}", fontsize=10, color=INK, loc="left")
    colours = ListedColormap(list(CYCLE[: len(levels)]))
    edges = np.arange(len(levels) + 1) - 0.5
    bar = figure.colorbar(
        ScalarMappable(BoundaryNorm(edges, colours.N), colours),
        cax=figure.add_axes((0.85, 0.3, 0.03, 0.3)),
        ticks=np.arange(len(levels)),
    )
    bar.ax.set_yticklabels([number(float(level), 3) for level in levels])
    bar.ax.set_title(unit, fontsize=9, loc="left")
    return picture(figure)
