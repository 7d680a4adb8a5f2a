"""Force-deflection curves arranged for drawing: one panel for each angle and held set.

Drawn with compression to the right and up: abscissa -x in mm, ordinate -Fx in kN.
"""

from collections.abc import Sequence
from dataclasses import dataclass

from reports.formats import held_label, number
from reports.load import Json
from reports.style import colour_of, model_label


@dataclass(frozen=True)
class Line:
    """One branch of one model; `named` on the first branch of its label in the panel."""

    label: str
    colour: str
    dash: str
    named: bool
    x: Sequence[float]
    y: Sequence[float]

    @property
    def width(self) -> float:
        """Line width: what is drawn on top is thinner, so that coinciding lines stay visible."""
        return {"solid": 3.2, "dash": 2.2, "dot": 1.4}[self.dash]


@dataclass(frozen=True)
class Level:
    """A critical load, kN, compression positive."""

    label: str
    colour: str
    load: float


@dataclass(frozen=True)
class Panel:
    """Everything to be drawn for one angle and held set."""

    q_deg: float
    held: tuple[str, ...]
    lines: Sequence[Line]
    levels: Sequence[Level]

    @property
    def title(self) -> str:
        return f"q = {self.q_deg:g}°, held: {held_label(self.held)}"

    @property
    def x_range(self) -> tuple[float, float]:
        """Range of the abscissa, with a margin for the labels."""
        return padded([v for line in self.lines for v in line.x])

    @property
    def y_range(self) -> tuple[float, float]:
        """Range of the ordinate: LIN may leave it, since a straight line needs no room."""
        bent = [v for line in self.lines if line.label != "LIN" for v in line.y]
        bent = bent or [v for line in self.lines for v in line.y]
        return padded(bent + [level.load for level in self.levels])

    def level_labels(self) -> list[tuple[float, str]]:
        """Labels of the critical loads; loads too near to each other to be labelled apart share one label."""
        low, high = self.y_range
        merged: list[tuple[float, list[str]]] = []
        for level in sorted(self.levels, key=lambda item: item.load):
            sense = " tension" if level.load < 0 else ""
            text = f"{level.label} {number(abs(level.load), 4)} kN{sense}"
            if merged and level.load - merged[-1][0] < 0.05 * (high - low):
                merged[-1] = (level.load, [*merged[-1][1], text])
            else:
                merged.append((level.load, [text]))
        return [(load, "; ".join(texts)) for load, texts in merged]


def padded(numbers: Sequence[float]) -> tuple[float, float]:
    """Their range with 6 % on both sides."""
    low, high = min(numbers, default=0.0), max(numbers, default=1.0)
    margin = 0.06 * ((high - low) or 1.0)
    return low - margin, high + margin


def panels(result: Json) -> list[Panel]:
    """One panel for each (q, held), in the order of the result."""
    groups: dict[tuple[float, tuple[str, ...]], list[Json]] = {}
    for curve in result["curves"]:
        groups.setdefault((curve["q_deg"], tuple(curve["held"])), []).append(curve)
    return [panel(q, held, curves) for (q, held), curves in groups.items()]


def panel(q_deg: float, held: tuple[str, ...], curves: Sequence[Json]) -> Panel:
    """The panel of these curves."""
    lines: list[Line] = []
    levels: dict[tuple[str, str], Level] = {}
    for curve in curves:
        label = model_label(curve)
        dash = "solid" if label == "solid FE" else "dash" if label.startswith("VJM") else "dot"
        named = all(line.label != label for line in lines)
        x, y = [-v for v in curve["x_mm"]], [-v / 1e3 for v in curve["fx_N"]]
        lines.append(Line(label, colour_of(label), dash, named, x, y))
        for load in curve["critical_N"]:
            level = Level(label, colour_of(label), -load / 1e3)
            levels[label, number(level.load, 4)] = level
    # Coinciding lines stay visible: dots over dashes over solid lines.
    lines.sort(key=lambda line: ("solid", "dash", "dot").index(line.dash))
    return Panel(q_deg, held, lines, list(levels.values()))
