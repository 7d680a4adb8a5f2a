"""Laws over their coordinates."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from reports.charts import dress
from reports.first_screen.drawn import Picture
from reports.style import ACCENT, FAINT, INK

MOST = 3
"""Laws that are drawn side by side, the first ones."""


@dataclass(frozen=True)
class Law:
    """Where a law is, its form in words, and its curve as in the record, None where there is none."""

    site: str
    equation: str
    curve: Mapping[str, Any] | None

    @classmethod
    def of(cls, record: Mapping[str, Any]) -> Law:
        """From the record of a law."""
        return cls(record["site"], record["equation"] or "no form", record["curve"])


def laws(found: Sequence[Law], name: str) -> Picture:
    """The first laws that have a curve, side by side; in words where there is none."""
    drawn = [law for law in found if law.curve is not None][:MOST]
    figure = Picture(figsize=(max(6.0, 4.6 * len(drawn)), 3.8))
    if not drawn:
        figure.text(0.5, 0.5, f"{name}: no law to draw", ha="center", va="center", color=INK)
        return figure
    for ax, law in zip(figure.subplots(1, len(drawn), squeeze=False)[0], drawn, strict=True):
        it = law.curve
        assert it is not None
        ax.plot(it["own_x"], it["own_y"], ".", ms=3, color=FAINT, label="single load steps")
        ax.fill_between(it["free_x"], it["low"], it["high"], color=INK, alpha=0.15, lw=0)
        ax.plot(it["free_x"], it["free"], color=INK, lw=1.0, ls="--", label="without a form, 95 %")
        ax.plot(it["x"], it["y"], color=ACCENT, lw=1.8, label=law.equation)
        ax.set_xlabel(it["x_unit"])
        ax.set_ylabel(it["y_unit"])
        ax.set_title(law.site, fontsize=10, loc="left", color=INK)
        dress(ax)
        ax.legend(frameon=False, fontsize=8)
    figure.tight_layout()
    return figure
