"""Colours (Okabe and Ito, told apart by colour-blind readers) and names of models, for all pictures."""

from collections.abc import Mapping
from types import MappingProxyType
from typing import Any

ACCENT = "#0072B2"
INK = "#1c2733"
FAINT = "#8a949e"
GRID = "#e3e7eb"

# Okabe-Ito without its yellow, which vanishes on white; grey stands in for it.
CYCLE = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000", "#7f7f7f")

MODEL_COLOURS: Mapping[str, str] = MappingProxyType(
    {
        "LIN": "#000000",
        "solid FE": "#D55E00",
        "frame": "#7B3294",
        "beam formula": "#E69F00",
        "VJM, spring at tip": "#0072B2",
        "VJM, spring at middle": "#56B4E9",
        "VJM, spring at base": "#009E73",
        "VJM, distributed": "#CC79A7",
        "VJM": "#7f7f7f",
    }
)


def colour_of(label: str) -> str:
    """The colour of a model by its label."""
    for name, colour in MODEL_COLOURS.items():
        if label.startswith(name):
            return colour
    return CYCLE[-1]


def model_label(item: Mapping[str, Any]) -> str:
    """A curve's or critical load's model as the report names it everywhere."""
    model, spring = str(item["model"]), item.get("spring_at")
    if model == "vjm":
        if spring in ("tip", "middle", "base"):
            return f"VJM, spring at {spring}"
        return f"VJM, {spring}" if spring else "VJM"
    return {"fea": "solid FE", "lin": "LIN", "solid": "solid FE"}.get(model, model)
