"""What the stages of a linkage need to know of it and of its bars, whether a section or a file describes them."""

from collections.abc import Sequence
from typing import Protocol

from fem.anisotropic import Regional
from fem.beam import Segment
from fem.material import Isotropic
from fem.slices.solver import SolverOf
from fem.space import Space
from pipeline.validation.case_tables import LinkageSize
from pipeline.validation.detail import Detail


class Sized(Protocol):
    """Something with the dimensions and angles of a parallelogram."""

    @property
    def linkage(self) -> LinkageSize: ...


class Long(Protocol):
    """Something with a length between its pins, mm."""

    @property
    def length(self) -> float: ...


class SolidBar(Protocol):
    """One bar with its displacement spaces: of the working mesh, and of load paths."""

    @property
    def bar(self) -> Long: ...

    @property
    def material(self) -> Isotropic | Regional: ...

    @property
    def detail(self) -> Detail: ...

    @property
    def space(self) -> Space: ...

    @property
    def solver_of(self) -> SolverOf:
        """The solver of a linkage of bars on the working mesh."""
        ...

    @property
    def path_space(self) -> Space: ...

    @property
    def segments(self) -> Sequence[Segment]:
        """As a stepped beam, whose middle one has the shear stiffness GAy, GAz; infinite where it is not known."""
        ...
