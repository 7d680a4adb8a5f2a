"""The bent parallelogram at its critical loads, coloured by stress, from modes/linkage_*.vtu beside a result."""

import io
from collections.abc import Sequence
from dataclasses import dataclass
from html import escape
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
import plotly.graph_objects as go
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize
from matplotlib.figure import Figure

from reports.errors import ReportError
from reports.formats import held_label, number
from reports.load import Json
from reports.shapes import COLOURS, LIGHT, SHARE, crop, require_egl
from reports.style import INK
from reports.turntable import LIGHT as PAGE_LIGHT
from reports.turntable import turning

Floats = npt.NDArray[np.float64]
VIEW = ((-0.45, -1.0, 0.5), (0.0, 0.0, 1.0))
SHOWN = 2
"""Pictures in the Markdown twin."""


@dataclass(frozen=True, eq=False)
class Bent:
    """Surface of both bars (pyvista PolyData of triangles), displacement (n, 3) mm and von Mises stress (n,) MPa."""

    title: str
    surface: Any
    displacement: Floats
    stress: Floats

    @property
    def scale(self) -> float:
        """Factor on the displacement, so that it is seen; a round number."""
        reach = float(np.ptp(np.asarray(self.surface.points)[:, 0]))
        return float(f"{SHARE * reach / np.linalg.norm(self.displacement, axis=1).max():.1g}")


def read(folder: Path, result: Json) -> list[Bent]:
    """Every shape that is stored, in the order of the critical loads; ReportError if a file is unusable."""
    found = []
    for q, held, load in lowest(result):
        path = folder / "modes" / f"linkage_q{q:g}_{'-'.join(held)}.vtu"
        if not path.is_file():
            continue
        import pyvista

        try:
            solid = pyvista.read(path)
            # The page need not carry the mid-side nodes.
            surface = solid.extract_surface(
                nonlinear_subdivision=0, algorithm="dataset_surface"
            ).triangulate()
            displacement = np.asarray(surface.point_data["displacement"], dtype=float)
            stress = np.asarray(surface.point_data["stress"], dtype=float)
        except Exception as error:
            raise ReportError(f"{path} is not a readable shape of the linkage: {error}") from None
        title = f"q = {q:g}°, held {held_label(held)}: {number(load / 1e3, 3)} kN"
        found.append(Bent(title, surface, displacement, stress))
    return found


def lowest(result: Json) -> list[tuple[float, list[str], float]]:
    """Angle, held coordinates and lowest critical load, N, of the solid."""
    loads: dict[tuple[float, tuple[str, ...]], float] = {}
    for item in result["critical"]:
        if item["model"] == "solid" and item["load_N"] is not None:
            key = (item["q_deg"], tuple(item["held"]))
            loads[key] = min(abs(item["load_N"]), loads.get(key, np.inf))
    return [(q, list(held), load) for (q, held), load in loads.items()]


def figure(found: Sequence[Bent]) -> go.Figure:
    """All of them, one visible at a time."""
    plot = go.Figure()
    for bent in found:
        rest = np.asarray(bent.surface.points, dtype=float)
        drawn = (rest + bent.scale * bent.displacement).astype(np.float32)
        corners = np.asarray(bent.surface.faces, dtype=np.int64).reshape(-1, 4)[:, 1:]
        i, j, k = corners.T.astype(np.uint16 if len(rest) < 2**16 else np.uint32)
        plot.add_mesh3d(
            x=drawn[:, 0],
            y=drawn[:, 1],
            z=drawn[:, 2],
            i=i,
            j=j,
            k=k,
            intensity=np.rint(bent.stress).astype(np.uint16),
            colorscale=COLOURS,
            cmin=0,
            cmax=int(np.ceil(bent.stress.max())),
            flatshading=True,
            lighting=PAGE_LIGHT,
            colorbar={"title": {"text": "von Mises stress, MPa"}, "thickness": 12, "len": 0.7},
            hovertemplate="%{intensity:.0f} MPa<extra></extra>",
        )
    titles = [f"{escape(bent.title)}, drawn × {bent.scale:g}" for bent in found]
    # Across the bars there is room for a number at each end only.
    return turning(plot, titles, 1.9, 560).update_layout(scene_yaxis_nticks=2)


def picture(found: Sequence[Bent]) -> bytes:
    """The first of them with one scale of stress, as PNG."""
    shown = found[:SHOWN]
    top = max(float(bent.stress.max()) for bent in shown)
    images = [render(bent, top) for bent in shown]
    figure = Figure(figsize=(9.0, 4.4 * len(images)))
    for row, (bent, image) in enumerate(zip(shown, images, strict=True)):
        ax = figure.add_subplot(len(images), 1, row + 1)
        ax.imshow(image, interpolation="lanczos")
        ax.set_title(f"{bent.title}, drawn × {bent.scale:g}", fontsize=12, color=INK, loc="left")
        ax.axis("off")
    figure.subplots_adjust(hspace=0.12, bottom=0.14, top=0.95)
    bar = figure.add_axes((0.3, 0.07, 0.4, 0.018))
    figure.colorbar(ScalarMappable(Normalize(0.0, top), COLOURS), cax=bar, orientation="horizontal")
    bar.set_xlabel("von Mises stress, MPa", color=INK)
    out = io.BytesIO()
    figure.savefig(out, format="png", dpi=110, bbox_inches="tight", metadata={"Software": None})
    return out.getvalue()


def render(bent: Bent, top: float) -> npt.NDArray[np.uint8]:
    """One of them over the outline of the unloaded bars, cropped to what is drawn: pixels (rows, columns, 3)."""
    require_egl()
    import pyvista

    plotter = pyvista.Plotter(off_screen=True, window_size=(1800, 1000))
    try:
        plotter.set_background("white")
        drawn = bent.surface.copy()
        drawn.points = np.asarray(drawn.points) + bent.scale * bent.displacement
        drawn.clear_data()
        drawn["stress"] = bent.stress
        drawn = drawn.compute_normals(feature_angle=40.0, split_vertices=True)
        plotter.add_mesh(bent.surface.extract_feature_edges(30.0), color="#98a2ac", line_width=2.0)
        plotter.add_mesh(
            drawn, scalars="stress", cmap=COLOURS, clim=(0.0, top), show_scalar_bar=False, **LIGHT
        )
        plotter.enable_anti_aliasing("ssaa")
        plotter.view_vector(VIEW[0], viewup=VIEW[1])
        plotter.enable_parallel_projection()
        plotter.reset_camera()
        plotter.camera.zoom(1.3)
        return crop(np.asarray(plotter.screenshot(return_img=True)))
    finally:
        plotter.close()
