"""Slices of a sweep: filled contours in the planes through the middle of the box, a row for each quantity."""

from dataclasses import dataclass

import numpy as np
from matplotlib.figure import Figure, SubFigure

from reports.charts import picture
from reports.formats import number
from reports.style import FAINT, INK
from reports.workspace.read import QUANTITIES, Floats, Workspace

COLOURS = "cividis"
LEVELS = 11
_NARROW = 1e-9


@dataclass(frozen=True, eq=False)
class Slice:
    """A plane of the grid: numbers of the axes across and up, of the one normal to it, and its place there, mm."""

    across: int
    up: int
    normal: int
    number: int
    place: float

    @property
    def title(self) -> str:
        return f"{'xyz'[self.normal]} = {self.place:g} mm"

    def of(self, space: Workspace, name: str) -> Floats:
        """(across, up) a quantity on the plane."""
        where: list[slice | int] = [slice(None)] * 3
        where[self.normal] = self.number
        return space.field(name, (where[0], where[1], where[2]))


def slices(space: Workspace) -> list[Slice]:
    """Planes that two long axes span: xy, xz, yz through the middle point of the third."""
    out = []
    for across, up, normal in ((0, 1, 2), (0, 2, 1), (1, 2, 0)):
        if across in space.long and up in space.long:
            middle = len(space.axes[normal]) // 2
            out.append(Slice(across, up, normal, middle, float(space.axes[normal][middle])))
    return out


def draw(space: Workspace) -> bytes:
    """PNG of all quantities; b"" for a sweep along a line or of a point."""
    planes = slices(space)
    if not planes:
        return b""
    names = [name for name in space.quantities if known(space, planes, name)]
    if not names:
        return b""
    figure = Figure(figsize=(4.0 * len(planes) + 1.2, 3.9 * len(names) + 0.6), layout="constrained")
    figure.suptitle(space.title, color=INK, fontsize=11, x=0.01, ha="left")
    parts = figure.subfigures(len(names), 1, squeeze=False)[:, 0]
    for part, name in zip(parts, names, strict=True):
        row(part, space, planes, name)
    return picture(figure)


def known(space: Workspace, planes: list[Slice], name: str) -> bool:
    """Whether there is a number to draw."""
    return any(bool(np.isfinite(plane.of(space, name)).any()) for plane in planes)


def row(figure: SubFigure, space: Workspace, planes: list[Slice], name: str) -> None:
    """One quantity on all planes with one scale."""
    axes = list(figure.subplots(1, len(planes), squeeze=False)[0])
    fields = [plane.of(space, name) for plane in planes]
    low, high = (float(f(np.concatenate([x.ravel() for x in fields]))) for f in (np.nanmin, np.nanmax))
    title, unit = QUANTITIES[name]
    constant = high - low <= _NARROW * max(abs(low), abs(high), _NARROW)
    levels = np.linspace(low, high, LEVELS) if not constant else np.array([low - 0.5, low + 0.5])
    for ax, plane, field in zip(axes, planes, fields, strict=True):
        x, y = space.axes[plane.across], space.axes[plane.up]
        drawn = ax.contourf(x, y, field.T, levels=levels, cmap=COLOURS, extend="neither")
        ax.set_facecolor("#eef1f3")
        ax.set_aspect("equal")
        ax.set_xlabel(f"{'xyz'[plane.across]}, mm")
        ax.set_ylabel(f"{'xyz'[plane.up]}, mm")
        ax.set_title(plane.title, fontsize=9, color=INK, loc="left")
        ax.tick_params(colors=INK, labelsize=8)
        for spine in ax.spines.values():
            spine.set_color(FAINT)
    figure.suptitle(title, color=INK, fontsize=10, fontweight="bold", x=0.01, ha="left")
    bar = figure.colorbar(drawn, ax=axes, shrink=0.9, pad=0.01)
    bar.set_label(unit, fontsize=8)
    bar.ax.tick_params(labelsize=8)
    if constant:
        bar.set_ticks([low], labels=[number(low, 4)])
