"""What a law placed at a site of a linkage is: force over its own coordinate and over what it remembers."""

from abc import ABC, abstractmethod
from typing import ClassVar

import numpy as np

from meshes.solid import Floats

Response = tuple[Floats, Floats, Floats]
"""Force, stiffness and the memory that this coordinate would leave."""


class Law(ABC):
    """A force (N, or moment N mm) as a function of a coordinate (mm, or rad) and of a memory.

    abrupt: it has a kink or a nearly rigid branch, so that a load step may need to be cut finer.
    by_load_step: the memory moves on at the end of a load step only, however the solver divides the step.
    width: how many numbers it remembers; all are zero in the unloaded linkage.
    loaded: the frame writes the axial load of the joint, N, into memory[..., 0] whenever the memory moves on.
    """

    by_load_step: ClassVar[bool] = False
    loaded: ClassVar[bool] = False
    width: ClassVar[int] = 0

    @property
    def abrupt(self) -> bool:
        """As said above."""
        return False

    @abstractmethod
    def respond(self, q: Floats, memory: Floats) -> Response:
        """Force (...), stiffness dF/dq (...) and new memory (..., width) at q (...), from the memory before."""


class Elastic(Law):
    """A law without memory: conservative."""

    def advanced(self, q: Floats, step: Floats) -> Floats:
        """Where Newton's method goes on from q (...), told a step (...) along the tangent."""
        return q + step

    @abstractmethod
    def curve(self, q: Floats) -> tuple[Floats, Floats]:
        """Force and stiffness (...) at q (...)."""

    def respond(self, q: Floats, memory: Floats) -> Response:
        """As of `Law`; the memory is left as it is."""
        return (*self.curve(q), memory)


def jenkins(q: Floats, slider: Floats, stiffness: Floats | float, most: Floats | float) -> Response:
    """Force, stiffness and new slider of a spring in series with a slider that carries `most`, zero or more.

    All (...), broadcast. The slider moves with its force where the spring would carry more: that is dissipative,
    also where `most` changes from step to step. Source: W. D. Iwan, J. Appl. Mech. 33 (1966) 893-900.
    """
    trial = stiffness * (q - slider)
    force = np.clip(trial, -most, most)
    slides = np.abs(trial) > most
    return force, np.where(slides, 0.0, stiffness), np.where(slides, q - force / stiffness, slider)
