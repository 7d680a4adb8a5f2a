"""The buckling modes as one plot that can be turned."""

from collections.abc import Sequence
from dataclasses import dataclass
from html import escape
from typing import Any

import numpy as np
import numpy.typing as npt
import plotly.graph_objects as go

from reports.plots import style
from reports.shapes import COLOURS, Mode, Shapes

Floats = npt.NDArray[np.float64]
Ints = npt.NDArray[np.int64]

# A VTU may hold single precision: some 1e-5 mm at the end of a bar, 1e-6 mm across it.
X_DECIMALS, YZ_DECIMALS = 3, 4

COLOUR_BAR = {
    "title": {"text": "displacement, % of the largest", "side": "top"},
    "orientation": "h",
    "thickness": 10,
    "len": 0.6,
    "y": 0.0,
    "yanchor": "bottom",
}

# Plotly leaves faces below the epsilon, such as the small ones beside a lug, without light.
LIGHT = {"ambient": 0.6, "diffuse": 0.6, "specular": 0.0, "facenormalsepsilon": 0}

POINTS = 4000
"""Most points of a swept surface in the page; a finer one is thinned along the bar."""

BUDGET = 45_000
"""Most points of all modes together, some 30 bytes each; beyond it the higher modes are left out."""


@dataclass(frozen=True)
class Triangles:
    """`corners` (m, 3) count within `points`, the numbers of the original points that are kept."""

    points: Ints
    corners: Ints


def figure(found: Sequence[Shapes]) -> go.Figure:
    """All modes of all supports, one visible at a time, chosen in a drop-down."""
    plot = go.Figure()
    titles = []
    surfaces = [surface_of(shapes) for shapes in found]
    count = max(1, BUDGET // sum(len(surface.points) for surface in surfaces))
    for shapes, surface in zip(found, surfaces, strict=True):
        for mode in shapes.modes[:count]:
            plot.add_trace(mesh(surface, shapes, mode))
            titles.append(f"{escape(shapes.supports)}: {escape(mode.title)}")
    return turning(plot, titles, 2.8, 480)


def turning(plot: go.Figure, titles: Sequence[str], reach: float, height: int) -> go.Figure:
    """Surfaces of which one is seen at a time, chosen in a drop-down, to scale; reach: how long x is drawn."""
    for index, trace in enumerate(plot.data):
        trace.visible = index == 0
    buttons = [
        {"label": title, "method": "update", "args": [{"visible": [i == k for i in range(len(titles))]}]}
        for k, title in enumerate(titles)
    ]
    low, high = limits(plot)
    span = high - low
    axis = {"showbackground": False, "showgrid": False, "zeroline": False, "ticks": "", "showspikes": False}
    scene = {
        "aspectmode": "manual",
        "aspectratio": dict(zip("xyz", reach * span / span[0], strict=True)),
        "camera": {
            "eye": {"x": -0.42, "y": -1.15, "z": 0.62},
            "projection": {"type": "orthographic"},
        },
        "dragmode": "turntable",
        **{
            f"{a}axis": {**axis, "title": {"text": f"{a}, mm"}, "nticks": 4, "range": [low[k], high[k]]}
            for k, a in enumerate("xyz")
        },
    }
    menu = {"buttons": buttons, "x": 0, "xanchor": "left", "y": 1.0, "yanchor": "bottom", "showactive": True}
    return style(plot, height, scene=scene, updatemenus=[menu], margin={"l": 0, "r": 0, "t": 60, "b": 0})


def limits(plot: go.Figure) -> tuple[Any, Any]:
    """Lowest and highest x, y, z over all modes, so that the view stays when another mode is chosen."""
    points = [np.stack([trace.x, trace.y, trace.z]) for trace in plot.data]
    low = np.min([p.min(axis=1) for p in points], axis=0)
    high = np.max([p.max(axis=1) for p in points], axis=0)
    return low.astype(float), high.astype(float)


def surface_of(shapes: Shapes) -> Triangles:
    """The surface that the page carries."""
    corners = np.asarray(shapes.surface.faces, dtype=np.int64).reshape(-1, 4)[:, 1:]
    return thin(np.asarray(shapes.surface.points, dtype=float), corners, POINTS)


def mesh(surface: Triangles, shapes: Shapes, mode: Mode) -> go.Mesh3d:
    """One bent surface, coloured by the size of its displacement."""
    shape = mode.displacement[surface.points]
    rest = np.asarray(shapes.surface.points, dtype=float)[surface.points]
    bent = (rest + shapes.scale(mode) * shape).astype(np.float32)
    i, j, k = surface.corners.T.astype(np.uint16 if len(rest) < 2**16 else np.uint32)
    return go.Mesh3d(
        x=bent[:, 0],
        y=bent[:, 1],
        z=bent[:, 2],
        i=i,
        j=j,
        k=k,
        # Whole per cents take a quarter of the page that floating-point numbers would.
        intensity=np.rint(100 * np.linalg.norm(shape, axis=1)).astype(np.uint8),
        colorscale=COLOURS,
        cmin=0,
        cmax=100,
        flatshading=True,
        lighting=LIGHT,
        colorbar=COLOUR_BAR,
        hovertemplate="x %{x:.1f}, y %{y:.1f}, z %{z:.1f} mm (drawn)<extra></extra>",
    )


def thin(points: Floats, corners: Ints, limit: int) -> Triangles:
    """The surface on as many stations along x as `limit` points allow; all of it if it is not swept.

    points (n, 3) in mm; corners (m, 3). Stations where the outline changes (ends, lugs) are always kept.
    """
    _, at = np.unique(np.round(points[:, 0], X_DECIMALS), return_inverse=True)
    kept = stations_within(np.bincount(at), limit)
    target = nearest_on_line(points, kept[at])
    moved = target[corners]
    moved = moved[(moved != np.roll(moved, 1, axis=1)).all(axis=1)]
    used, numbered = np.unique(moved, return_inverse=True)
    return Triangles(used, numbered.reshape(-1, 3))


def stations_within(counts: Ints, limit: int) -> npt.NDArray[np.bool_]:
    """Which stations (s,) stay, given their numbers of points (s,): every second, third, .. until `limit` is met."""
    change = np.ones(len(counts), dtype=bool)
    change[1:-1] = (counts[1:-1] != counts[:-2]) | (counts[1:-1] != counts[2:])
    kept = np.ones_like(change)
    for step in range(1, len(counts)):
        kept = change | (np.arange(len(counts)) % step == 0)
        if counts[kept].sum() <= limit:
            break
    return kept


def nearest_on_line(points: Floats, kept: npt.NDArray[np.bool_]) -> Ints:
    """For each point (n, 3) the nearest kept one (n,) with the same y and z; itself where that line has none."""
    target = np.arange(len(points))
    _, line = np.unique(np.round(points[:, 1:], YZ_DECIMALS), axis=0, return_inverse=True)
    for members in np.split(np.argsort(line, kind="stable"), np.cumsum(np.bincount(line))[:-1]):
        stay = members[kept[members]]
        if len(stay):
            distance = np.abs(points[members, None, 0] - points[None, stay, 0])
            target[members] = stay[distance.argmin(axis=1)]
    return target
