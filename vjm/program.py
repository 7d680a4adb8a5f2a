"""A chain and points of it as arrays, as compiled functions read them."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from vjm.frames import Array


class Program(NamedTuple):
    """A chain as arrays, E elements with J joints.

    kinds: (E,). along: (E,) number of the own axis that a joint has, -1 for any other direction. vectors: (E, 3)
    translation, or axis of the joint. rotations: (E, 3, 3) of constant transforms. coordinate: (J,) that moves a joint,
    share: (J,) by which. turns: (J,) of bool. reference: (3, 3) from which the rotation vector counts.
    """

    kinds: np.ndarray
    along: np.ndarray
    vectors: Array
    rotations: Array
    coordinate: np.ndarray
    share: Array
    turns: np.ndarray
    reference: Array


class Marks(NamedTuple):
    """Points of a chain, those nearer the base first.

    elements: (s,) before each. offsets: (s, 3) in the frame there, mm.
    """

    elements: np.ndarray
    offsets: Array
