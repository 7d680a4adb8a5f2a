"""Random mechanisms and states for the property tests; every test draws the same ones on every run."""

from __future__ import annotations

import numpy as np
from hypothesis import settings
from hypothesis import strategies as st

from vjm import paper
from vjm.chain import Chain, Element, Fixed, Joint, Role
from vjm.frames import exp

LENGTH, WIDTH = paper.LENGTH, paper.WIDTH
ROTATION_RADIUS = np.repeat([1.0, 1.0 / LENGTH], 3)
"""Makes a 6x6 comparable entry by entry: rotations counted as arcs on the radius of the bar length."""


def fixed_seed(examples: int) -> settings:
    """The same examples on every run, no time limit."""
    return settings(max_examples=examples, derandomize=True, deadline=None, database=None)


def vectors(size: float, count: int = 3) -> st.SearchStrategy[np.ndarray]:
    return st.lists(st.floats(-size, size), min_size=count, max_size=count).map(np.array)


angles = st.floats(-np.pi / 3, np.pi / 3)


@st.composite
def bar_stiffness(draw: st.DrawFn) -> np.ndarray:
    """Positive definite K_b with the coupled blocks 26 and 35, entries within a factor 5 of Eq. 12."""
    scale = np.array([draw(st.floats(0.2, 5.0)) for _ in range(6)])
    k = np.diag(scale * np.diag(paper.BAR_STIFFNESS))
    for i, j in ((1, 5), (2, 4)):
        k[i, j] = k[j, i] = draw(st.floats(-0.95, 0.95)) * np.sqrt(k[i, i] * k[j, j])
    return k


@st.composite
def chains(draw: st.DrawFn) -> Chain:
    """Up to eight joints of any kind and axis between random fixed transforms."""
    elements: list[Element] = []
    for _ in range(draw(st.integers(1, 8))):
        elements.append(Fixed(draw(vectors(2.0)), exp(draw(vectors(1.0)))))
        axis = exp(draw(vectors(2.0))) @ np.array([1.0, 0.0, 0.0])
        kind = draw(st.sampled_from(["translation", "rotation"]))
        elements.append(Joint(kind, tuple(axis / np.linalg.norm(axis)), draw(st.sampled_from(Role))))
    return Chain((*elements, Fixed(draw(vectors(2.0)))), exp(draw(vectors(1.0))))


def displacements(translation: float, rotation: float) -> st.SearchStrategy[np.ndarray]:
    """Platform displacement (6,), mm and rad."""
    return vectors(1.0, 6).map(lambda v: v * np.repeat([translation, rotation], 3))
