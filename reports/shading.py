"""Colours of what is counted in sigmas or between 0 and 1, and the ink in which a number on them can be read.

White to grey is what nobody need look at; one strong hue, darker the more, is what somebody should.
"""

from collections.abc import Sequence
from itertools import pairwise
from math import log10

from matplotlib.colors import LinearSegmentedColormap, to_hex, to_rgb

Stops = tuple[tuple[float, str], ...]
ATTENTION = 3.0
"""Sigmas below which a misfit is drawn in white and grey: the root mean square of noise stays far below."""
TOP = 1000.0
"""Sigmas of the darkest colour. The same on every page, so that one colour is one misfit everywhere."""
_EDGE = log10(ATTENTION) / log10(TOP)
MISFIT: Stops = (
    (0.0, "#ffffff"),
    (_EDGE, "#d5dade"),
    (_EDGE, "#f8bd90"),
    (0.36, "#ec8a4a"),
    (0.67, "#b54d08"),
    (1.0, "#521b00"),
)
"""Over log10 of sigmas from 1 to `TOP`, as shares of the way."""
LIKENESS: Stops = ((0.0, "#ffffff"), (0.3, "#dfe5ea"), (0.8, "#5aa2cf"), (1.0, "#083f66"))
"""From nothing in common to the same."""
DARK, LIGHT = "#000000", "#ffffff"


def share_of(sigma: float | None) -> float:
    """Where a misfit stands on `MISFIT`; one that is unknown (no prediction) is the worst."""
    return 1.0 if sigma is None else min(log10(max(sigma, 1.0)) / log10(TOP), 1.0)


def colour(stops: Stops, share: float) -> str:
    """The colour at a share from 0 to 1, as plotly.js and matplotlib mix it: linearly in RGB."""
    share = min(max(share, 0.0), 1.0)
    for (low, one), (high, other) in pairwise(stops):
        if share <= high and high > low:
            way = (share - low) / (high - low)
            mixed = [a + way * (b - a) for a, b in zip(to_rgb(one), to_rgb(other), strict=True)]
            return to_hex((mixed[0], mixed[1], mixed[2]))
    return stops[-1][1]


def scale(stops: Stops) -> list[list[float | str]]:
    """As plotly.js reads it."""
    return [[place, shade] for place, shade in stops]


def colormap(stops: Stops) -> LinearSegmentedColormap:
    """As matplotlib reads it."""
    return LinearSegmentedColormap.from_list("stops", list(stops), N=1024)


def luminance(shade: str) -> float:
    """Relative luminance (WCAG 2.2)."""
    linear = [c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in to_rgb(shade)]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]


def contrast(one: str, other: str) -> float:
    """Ratio of contrast of two colours, 1 to 21 (WCAG 2.2)."""
    low, high = sorted((luminance(one), luminance(other)))
    return (high + 0.05) / (low + 0.05)


def ink_on(shade: str) -> str:
    """Black or white, whichever is read better: of the two one always has a contrast above 4.5."""
    return max((DARK, LIGHT), key=lambda ink: contrast(shade, ink))


def inks(stops: Stops, shares: Sequence[float | None]) -> list[str]:
    """The ink on each cell; where there is none, any."""
    return [DARK if share is None else ink_on(colour(stops, share)) for share in shares]
