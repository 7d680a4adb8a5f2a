"""The linkage to scale, in two postures: the paper's Fig. 1."""

from math import cos, radians, sin

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Arc, Circle, Rectangle

from reports.drafting import Point, arrow, dimension, save
from reports.load import Json
from reports.style import ACCENT, FAINT, INK

TURNED = "#D55E00"
"""Colour of the bar frame."""

ANGLES = (0.0, 30.0)
"""The two postures of the drawing, degrees."""

KEY = (
    "$q_{ij}$  passive hinge j of bar i, turns about y\n"
    "x, y, z  base frame; ⊗ y points into the drawing\n"
    "$x_b, z_b$  bar frame: base frame turned by q about y\n"
    "$F_x$  force on the platform; compression is negative"
)


def draw(result: Json) -> tuple[str, bytes]:
    """The linkage at q = 0 and q = 30 degrees as (SVG, PNG)."""
    length, width = float(result["length_mm"]), float(result["width_mm"])
    figure = Figure(figsize=(11.0, 4.6))
    axes = figure.subplots(1, 2, sharey=True, gridspec_kw={"wspace": 0.05})
    for ax, angle in zip(axes, ANGLES, strict=True):
        posture(ax, length, width, angle)
    return save(figure, "linkage")


def posture(ax: Axes, length: float, width: float, angle: float) -> None:
    """One posture: wall, two bars, platform, frames, dimensions."""
    c, s = cos(radians(angle)), sin(radians(angle))
    tip = (length * c, 0.0 - length * s)
    half, unit = width / 2, length / 310.0
    wall(ax, half, unit)
    for bar, z in ((1, -half), (2, half)):
        ax.plot([0, tip[0]], [z, tip[1] + z], color=INK, lw=4.5, solid_capstyle="round", zorder=3)
        beside = 13 * unit * (1 if bar == 2 else -1)
        at = (0.66 * tip[0] + beside * s, 0.66 * tip[1] + z + beside * c)
        ax.text(*at, f"bar {bar}", ha="center", va="center", rotation=-angle, color=INK)
    ax.plot(
        [tip[0]] * 2, [tip[1] - half, tip[1] + half], color=ACCENT, lw=6, solid_capstyle="round", zorder=2
    )
    for x, z in ((0, 0), tip):
        for side in (-half, half):
            ax.add_patch(Circle((x, z + side), 4.6 * unit, fc="white", ec=INK, lw=1.4, zorder=5))
    joints(ax, tip, half, unit)
    frames(ax, tip, angle, unit)
    top = [(0.0, half), (tip[0], tip[1] + half)]
    dimension(ax, top[0], top[1], 40 * unit, f"L = {length:g} mm", 11 * unit)
    ax.texts[-1].set_rotation(-angle)
    dimension(ax, (tip[0], tip[1] + half), (tip[0], tip[1] - half), 76 * unit, f"d = {width:g} mm", 17 * unit)
    ax.texts[-1].set_rotation(90)
    ax.set_title(f"q = {angle:g}°", loc="left", fontsize=12, color=INK)
    ax.set_aspect("equal")
    ax.set_xlim(-55 * unit, 412 * unit)
    ax.set_ylim(-(length * sin(radians(ANGLES[-1])) + half + 42 * unit), half + 72 * unit)
    ax.axis("off")


def wall(ax: Axes, half: float, unit: float) -> None:
    """The fixed base, hatched."""
    reach = half + 16 * unit
    box = Rectangle((-46 * unit, -reach), 12 * unit, 2 * reach, fc="none", ec=FAINT, hatch="////", lw=0)
    ax.add_patch(box)
    ax.plot([-34 * unit] * 2, [-reach, reach], color=INK, lw=1.4)
    for z in (-half, half):
        ax.plot([-34 * unit, 0], [z, z], color=INK, lw=1.4, zorder=1)
    ax.text(-40 * unit, reach + 8 * unit, "base", ha="center", va="bottom", color=INK)


def joints(ax: Axes, tip: Point, half: float, unit: float) -> None:
    """Symbols of the four passive joints and of the platform point."""
    for bar, side in ((1, -1), (2, 1)):
        z, drop = side * half, side * 13 * unit
        ax.text(-5 * unit, z + drop, f"$q_{{{bar}1}}$", ha="right", va="center", color=FAINT)
        # Where neither a bar nor the lines of the dimensions run: beside the platform, between its ends.
        near = tip[1] + z - side * 15 * unit
        ax.text(tip[0] + 8 * unit, near, f"$q_{{{bar}2}}$", ha="left", va="center", color=FAINT)
    ax.add_patch(Circle(tip, 3.6 * unit, fc=ACCENT, ec="white", lw=1.0, zorder=6))
    label = f"platform point\n({tip[0]:.4g}, 0, {tip[1]:.4g}) mm".replace("-", "\u2212")
    ax.text(tip[0], tip[1] - half - 24 * unit, label, ha="center", va="top", color=ACCENT)


def frames(ax: Axes, tip: Point, angle: float, unit: float) -> None:
    """Base frame at the origin, bar frame turned by q, and the angle between them."""
    reach, c, s = 52 * unit, cos(radians(angle)), sin(radians(angle))
    arrow(ax, (0, 0), (reach, 0))
    ax.text(reach - 1 * unit, -9 * unit, "x", style="italic", ha="left", va="center", color=INK)
    arrow(ax, (0, 0), (0, 27 * unit))
    ax.text(-6 * unit, 22 * unit, "z", style="italic", ha="right", va="center", color=INK)
    ax.add_patch(Circle((0.0, 0.0), 4.2 * unit, fc="white", ec=INK, lw=1.1, zorder=6))
    cross = 2.6 * unit
    for sign in (1, -1):
        ax.plot([-cross, cross], [-sign * cross, sign * cross], color=INK, lw=1.0, zorder=7)
    ax.text(-6 * unit, -9 * unit, "y", style="italic", ha="right", va="center", color=INK)
    arrow(ax, tip, (tip[0] + 46 * unit, tip[1]), ACCENT)
    ax.text(tip[0] + 50 * unit, tip[1], "$F_x$", ha="left", va="center", color=ACCENT)
    if not angle:
        ax.plot([reach, tip[0]], [0, 0], color=FAINT, lw=0.7, ls=(0, (6, 4)), zorder=1)
        ax.text(
            0.5 * tip[0],
            -11 * unit,
            "bar frame = base frame",
            color=FAINT,
            ha="center",
            va="center",
            fontsize=9,
        )
        ax.text(-46 * unit, -112 * unit, KEY, color=INK, va="top", fontsize=9.5, linespacing=1.7)
        return
    ax.plot([0, tip[0]], [0, tip[1]], color=FAINT, lw=0.7, ls=(0, (6, 4)), zorder=1)
    ax.plot([reach, 112 * unit], [0, 0], color=FAINT, lw=0.7, ls=(0, (6, 4)), zorder=1)
    arrow(ax, (0, 0), (reach * c, -reach * s), TURNED)
    ax.text(reach * c - 1 * unit, -reach * s - 12 * unit, "$x_b$", ha="center", va="center", color=TURNED)
    arrow(ax, (0, 0), (20 * unit * s, 20 * unit * c), TURNED)
    ax.text(20 * unit * s + 3 * unit, 13 * unit, "$z_b$", ha="left", va="center", color=TURNED)
    radius = 84 * unit
    ax.add_patch(Arc((0, 0), 2 * radius, 2 * radius, theta1=-angle, theta2=0, color=INK, lw=1.0))
    turn = radians(0.6 * angle)
    ax.text(
        (radius + 9 * unit) * cos(turn), -(radius + 9 * unit) * sin(turn), "q", style="italic", va="center"
    )
