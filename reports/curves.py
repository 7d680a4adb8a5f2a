"""Force-deflection curves arranged for drawing: one panel for each angle and held set.

Drawn with compression to the right and up: abscissa -x in mm, ordinate -Fx in kN.
"""

from collections.abc import Sequence
from dataclasses import dataclass

from reports.formats import held_label, number
from reports.load import Json
from reports.style import colour_of, model_label

LABEL = 0.05
"""Height of a label as part of that of a panel."""


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

    @property
    def text(self) -> str:
        """As it stands beside its line."""
        sense = " tension" if self.load < 0 else ""
        return f"{number(abs(self.load), 4)} kN{sense}: {self.label}"


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
        """Range of the abscissa."""
        return padded([v for line in self.lines for v in line.x])

    @property
    def y_range(self) -> tuple[float, float]:
        """Range of the ordinate: LIN may leave it, since a straight line needs no room."""
        bent = [v for line in self.lines if line.label != "LIN" for v in line.y]
        bent = bent or [v for line in self.lines for v in line.y]
        return padded(bent + [level.load for level in self.levels])

    def level_labels(self) -> list[tuple[float, str]]:
        """Labels of the critical loads, kN, and the ordinates beside which they stand right of the panel: at their
        loads, and where loads are too near to each other one above the other about their mean."""
        low, high = self.y_range
        gap = LABEL * (high - low)
        groups: list[list[Level]] = []
        for level in sorted(self.levels, key=lambda item: item.load):
            groups.append([level])
            while len(groups) > 1 and _places(groups[-1], gap)[0] - _places(groups[-2], gap)[-1] < gap:
                groups[-2:] = [[*groups[-2], *groups[-1]]]
        return [
            (place, it.text) for each in groups for place, it in zip(_places(each, gap), each, strict=True)
        ]


def _places(levels: Sequence[Level], gap: float) -> list[float]:
    """So far apart, about the mean of the loads."""
    middle = sum(it.load for it in levels) / len(levels)
    return [middle + gap * (k - (len(levels) - 1) / 2) for k in range(len(levels))]


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
