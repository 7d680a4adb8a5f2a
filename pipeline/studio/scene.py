"""The linkage in space: as it was measured at a load step, coloured by misfit, and as the model has it."""

from __future__ import annotations

from typing import Any

import pyvista

from pipeline.page.record import TestPage
from reports.campaign.linkage import lines, scale_of
from reports.quantities import sigma
from reports.shading import ATTENTION, MISFIT, colour, share_of
from reports.shapes import require_egl
from reports.style import FAINT, INK

FINE = "#aab4bd"
"""Of a misfit that nobody need look at."""
OF_LEGS = 2.0
"""Times a bar's, the thickness of what is drawn by the lines of its legs: it is some bars wide."""


class Scene:
    """A view of three sets of tubes; what is measured is coloured."""

    def __init__(self) -> None:
        require_egl()
        self.plotter: Any = pyvista.Plotter(off_screen=True, window_size=(600, 400))
        self.plotter.set_background("white")
        self.plotter.view_vector((-0.5, -1.0, 0.6), (0.0, 0.0, 1.0))

    def show(self, test: TestPage, step: int) -> str:
        """Draw a step; returns what is seen, in words."""
        data = test.model_dump()
        scale = scale_of(data)
        misfit = test.misfit_after[step] if test.curves else 1.0
        self._add("nominal", data, None, scale, FAINT, 1.5)
        self._add("measured", data, test.measured_pose[step], scale, _shade(misfit), 4.0)
        self._add("predicted", data, test.predicted_pose[step], scale, INK, 1.2)
        said = "no prediction" if misfit is None else f"misfit {sigma(misfit)} sigma"
        if not test.curves:
            said = "nothing measured"
        return f"step {test.steps[step]}, displacements × {scale:g}, {said}"

    def _add(self, name: str, data: Any, pose: Any, scale: float, shade: str, radius: float) -> None:
        parts = [pyvista.lines_from_points(points) for points in lines(data, pose, scale)]
        thick = radius * (OF_LEGS if data["rig"]["place_mm"] is not None else 1.0)
        tubes = pyvista.merge(parts).tube(radius=thick * data["rig"]["length_mm"] / 310.0)
        self.plotter.add_mesh(tubes, name=name, color=shade, render=False, reset_camera=False)


def _shade(misfit: float | None) -> str:
    """As on the map, but for what is white there: nothing would be seen."""
    return FINE if misfit is not None and misfit < ATTENTION else colour(MISFIT, share_of(misfit))
