"""The bar to scale: its section with dimensions, side view and top view."""

from collections.abc import Sequence
from math import cos, radians, sin
from typing import Any

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Polygon, Rectangle

from reports.drafting import Point, arrow, dimension, save
from reports.load import Json
from reports.style import FAINT, INK


def section_outline(section: Json) -> tuple[list[Sequence[Point]], list[tuple[Point, Point, float, str]]]:
    """Closed outlines (y, z) in mm, holes after bodies, and their dimensions (from, to, side, text)."""
    kind = section["kind"]
    if kind == "i_section":
        b, t = section["flange_width_mm"] / 2, section["flange_thickness_mm"]
        h, w = section["height_mm"] / 2, section["web_mm"] / 2
        right = [(w, -h + t), (b, -h + t), (b, -h), (-b, -h), (-b, -h + t), (-w, -h + t)]
        outline = [(-y, -z) for y, z in right] + right
        sizes: list[tuple[Point, Point, float, str]] = [
            ((-b, h), (b, h), 1.0, f"{2 * b:.2f}"),
            ((-b, -h), (-b, h), 1.0, f"{2 * h:.2f}"),
            ((-w, 0), (w, 0), 0.0, f"{2 * w:.2f}"),
            ((b, h), (b, h - t), 1.0, f"{t:.2f}"),
        ]
        return [outline], sizes
    if kind == "rectangle":
        y, z = section["width_mm"] / 2, section["height_mm"] / 2
        box: list[Point] = [(-y, -z), (y, -z), (y, z), (-y, z)]
        return [box], [((-y, z), (y, z), 1.0, f"{2 * y:.2f}"), ((-y, -z), (-y, z), 1.0, f"{2 * z:.2f}")]
    outer = section["diameter_mm" if kind == "round" else "outer_diameter_mm"] / 2
    rings = [ring(outer)] + ([ring(outer - section["wall_mm"])] if kind == "tube" else [])
    text = f"⌀ {2 * outer:.2f}" + (f", wall {section['wall_mm']:.2f}" if kind == "tube" else "")
    return rings, [((-outer, outer), (outer, outer), 1.0, text)]


def ring(radius: float) -> Sequence[Point]:
    """A circle as a polygon."""
    return [(radius * cos(radians(a)), radius * sin(radians(a))) for a in range(0, 360, 3)]


def draw(result: Json) -> tuple[str, bytes]:
    """Section with dimensions, and side and top view of the bar, as (SVG, PNG)."""
    part = result["bar"]
    rings, sizes = section_outline(part["section"])
    figure = Figure(figsize=(11.0, 3.6))
    left, right = figure.subplots(1, 2, gridspec_kw={"width_ratios": (1.0, 2.6), "wspace": 0.08})
    draw_section(left, rings, sizes, part["lug"])
    views(right, part, rings[0])
    return save(figure, "bar")


def draw_section(ax: Axes, rings: list[Sequence[Point]], sizes: Any, lug: Json | None) -> None:
    """The section between the lugs, its dimensions in mm, and the outline of a lug behind it."""
    reach = max(max(abs(y), abs(z)) for y, z in rings[0])
    if lug is not None:
        y, z = lug["width_mm"] / 2, lug["height_mm"] / 2
        ax.add_patch(Rectangle((-y, -z), 2 * y, 2 * z, fc="none", ec=FAINT, lw=1.0, ls=(0, (5, 3))))
        reach = max(reach, y, z)
    for outline, fill in zip(rings, ("#cfe3f1", "white"), strict=False):
        ax.add_patch(Polygon(outline, closed=True, fc=fill, ec=INK, lw=1.5))
    for a, b, side, text in sizes:
        place(ax, a, b, side, text, reach)
    ax.text(
        0,
        -1.36 * reach,
        "section, mm" + ("; lug dashed" if lug else ""),
        ha="center",
        va="center",
        color=FAINT,
    )
    ax.set_aspect("equal")
    ax.set_xlim(-1.75 * reach, 1.75 * reach)
    ax.set_ylim(-1.5 * reach, 1.75 * reach)
    ax.axis("off")


def place(ax: Axes, a: Point, b: Point, side: float, text: str, reach: float) -> None:
    """One dimension of the section, outside its outline, or (side 0) across it."""
    if not side:
        arrow(ax, (a[0] - 0.3 * reach, a[1]), a, FAINT, width=0.8)
        arrow(ax, (b[0] + 0.3 * reach, b[1]), b, FAINT, width=0.8)
        box = {"fc": "white", "ec": "none", "pad": 1.5}
        ax.text(b[0] + 0.34 * reach, b[1], text, ha="left", va="center", color=INK, bbox=box)
        return
    if a[0] == b[0] and a[0] > 0:
        x = a[0] + 0.35 * reach
        for z in (a[1], b[1]):
            ax.plot([a[0], x + 0.08 * reach], [z, z], color=FAINT, lw=0.7)
        arrow(ax, (x, a[1] + 0.28 * reach), (x, a[1]), FAINT, width=0.8)
        arrow(ax, (x, b[1] - 0.28 * reach), (x, b[1]), FAINT, width=0.8)
        ax.text(x + 0.12 * reach, (a[1] + b[1]) / 2, text, ha="left", va="center", color=INK)
        return
    margin = (1.2 * reach - abs(a[0])) if a[0] == b[0] else (1.2 * reach - a[1])
    dimension(ax, a, b, margin, text, 0.14 * reach)
    if a[0] == b[0]:
        ax.texts[-1].set_rotation(90)


def views(ax: Axes, part: Json, outline: Sequence[Point]) -> None:
    """Side view (x, z) above, top view (x, y) below, to one scale, with length and lugs."""
    length, lug = float(part["length_mm"]), part["lug"]
    half_y, half_z = max(y for y, _ in outline), max(z for _, z in outline)
    ends = (
        {"y": half_y, "z": half_z} if lug is None else {"y": lug["width_mm"] / 2, "z": lug["height_mm"] / 2}
    )
    apart = 3.4 * max(half_y, half_z, *ends.values())
    for name, half, middle in (("z", half_z, apart / 2), ("y", half_y, -apart / 2)):
        inset = 0.0 if lug is None else lug["length_mm"]
        edges = [(inset, half, length - 2 * inset)]
        edges += [] if lug is None else [(0.0, ends[name], inset), (length - inset, ends[name], inset)]
        for x, h, run in edges:
            ax.add_patch(Rectangle((x, middle - h), run, 2 * h, fc="#cfe3f1", ec=INK, lw=1.2))
        hidden_edges(ax, outline, 1 if name == "z" else 0, half, middle, (inset, length - inset))
        ax.plot([-8, length + 8], [middle] * 2, color=FAINT, lw=0.7, ls=(0, (8, 3, 2, 3)))
        ax.text(
            length + 12,
            middle,
            f"{'side' if name == 'z' else 'top'} view, x\u2013{name}",
            va="center",
            color=FAINT,
        )
    top = apart / 2 + max(half_z, ends["z"])
    dimension(ax, (0, top), (length, top), 26, f"L = {length:g} mm", 9)
    if lug is not None:
        dimension(ax, (0, top), (lug["length_mm"], top), 10, "", 0)
        sizes = " x ".join(f"{lug[key]:.2f}" for key in ("length_mm", "width_mm", "height_mm"))
        ax.text(lug["length_mm"] + 4, top + 10, f"lug {sizes} mm (x, y, z)", va="center", color=INK)
    ax.set_aspect("equal")
    ax.set_xlim(-12, length + 80)
    ax.axis("off")


def hidden_edges(
    ax: Axes, outline: Sequence[Point], along: int, half: float, middle: float, span: tuple[float, float]
) -> None:
    """Edges of the section inside a view: full where seen, dashed where a flange covers them."""
    if len({abs(p[along]) for p in outline}) > 4:
        return
    for level in sorted({p[along] for p in outline if abs(p[along]) < half}):
        look = "-" if along else (0, (4, 3))
        ax.plot(span, [middle + level] * 2, color=INK, lw=0.7, ls=look)
