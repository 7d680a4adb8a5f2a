"""Colours stay apart for readers without red, green or blue cones, and what is dark stays dark.

Simulation: G. M. Machado, M. M. Oliveira, L. A. F. Fernandes, IEEE Trans. Vis. Comput. Graph. 15 (2009) 1291, severity
1; distances in CIELAB (CIE 1976), where 2.3 is just noticeable: ten times that is apart at a glance.
"""

from __future__ import annotations

import re
from itertools import combinations

import numpy as np
import pytest
from matplotlib.colors import to_rgb
from numpy.typing import NDArray

from reports.bars import FILLS
from reports.campaign.curve import COLOURS, SYMBOLS, WIDTHS
from reports.shading import ATTENTION, LIKENESS, MISFIT, Stops, colour, contrast, ink_on, share_of
from reports.style import FAINT, INK

Array = NDArray[np.float64]
APART = 23.0
EYES = {
    "all cones": np.eye(3),
    "no red": [
        [0.152286, 1.052583, -0.204868],
        [0.114503, 0.786281, 0.099216],
        [-0.003882, -0.048116, 1.051998],
    ],
    "no green": [
        [0.367322, 0.860646, -0.227968],
        [0.280085, 0.672501, 0.047413],
        [-0.011820, 0.042940, 0.968881],
    ],
    "no blue": [
        [1.255528, -0.076749, -0.178779],
        [-0.078411, 0.930809, 0.147602],
        [0.004733, 0.691367, 0.303900],
    ],
}
XYZ = np.array([[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]])
PAIRS = {
    "before, after": list(COLOURS.values()),
    "fitted, held out": [shade for fill in FILLS for shade in re.findall(r"#\w{6}", fill)[:1]],
    "measured, before, after": [INK, *COLOURS.values()],
    "measured, unloaded": [INK, FAINT],
}


def lab(colour: tuple[float, float, float], eye: str) -> Array:
    """CIELAB of an sRGB colour as an eye sees it, white D65."""
    rgb = np.array(colour)
    linear = np.where(rgb <= 0.04045, rgb / 12.92, ((rgb + 0.055) / 1.055) ** 2.4)
    seen = np.clip(np.array(EYES[eye]) @ linear, 0.0, 1.0)
    ratio = XYZ @ seen / XYZ.sum(axis=1)
    f = np.where(ratio > 216 / 24389, np.cbrt(ratio), (24389 / 27 * ratio + 16) / 116)
    return np.array([116 * f[1] - 16, 500 * (f[0] - f[1]), 200 * (f[1] - f[2])])


@pytest.mark.parametrize("eye", EYES)
@pytest.mark.parametrize("name", PAIRS)
def test_what_stands_side_by_side_is_told_apart(name: str, eye: str) -> None:
    for one, other in combinations(PAIRS[name], 2):
        distance = float(np.linalg.norm(lab(to_rgb(one), eye) - lab(to_rgb(other), eye)))
        assert distance > APART, (one, other, distance)


@pytest.mark.parametrize("eye", EYES)
def test_more_misfit_is_darker(eye: str) -> None:
    """Every tenth of the scale by more than is just noticeable."""
    for stops in (MISFIT, LIKENESS):
        shades = [to_rgb(colour(stops, float(share))) for share in np.linspace(0.0, 1.0, 11)]
        light = np.array([lab(shade, eye)[0] for shade in shades])
        assert np.all(np.diff(light) < -2.3), light


def test_noise_has_no_hue_and_misfit_has_one() -> None:
    """Chroma in CIELAB: white and grey below three sigmas, a strong hue from there on; a step that is seen between."""
    for sigma in (0.2, 1.0, 2.0, 2.99):
        _, a, b = lab(to_rgb(colour(MISFIT, share_of(sigma))), "all cones")
        assert np.hypot(a, b) < 5.0, sigma
    for sigma in (3.01, 10.0, 100.0, 900.0, 1e5):
        _, a, b = lab(to_rgb(colour(MISFIT, share_of(sigma))), "all cones")
        assert np.hypot(a, b) > 30.0, sigma
    below, above = (colour(MISFIT, share_of(ATTENTION * by)) for by in (0.999, 1.001))
    assert np.linalg.norm(lab(to_rgb(below), "all cones") - lab(to_rgb(above), "all cones")) > APART


@pytest.mark.parametrize("stops", [MISFIT, LIKENESS])
def test_numbers_can_be_read_on_every_colour(stops: Stops) -> None:
    """4.5 is what WCAG 2.2 asks of small text."""
    shades = [colour(stops, float(share)) for share in np.linspace(0.0, 1.0, 1001)]
    assert min(contrast(shade, ink_on(shade)) for shade in shades) > 4.5


def test_before_and_after_differ_without_any_colour() -> None:
    for look in (WIDTHS, SYMBOLS):
        assert set(look) == set(COLOURS) and len(set(look.values())) == len(look)
