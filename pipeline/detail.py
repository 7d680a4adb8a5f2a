"""How closely a run looks: mesh levels for each kind of question."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Detail:
    """`working`: level of K_b and linear buckling; `study`: levels of the convergence study; `path`: of load paths."""

    name: str
    working: int
    study: tuple[int, ...]
    path: int
    points: int


COARSE = Detail("coarse", working=1, study=(1, 2, 3), path=1, points=10)
DEFAULT = Detail("default", working=2, study=(1, 2, 3, 4), path=1, points=16)
FINE = Detail("fine", working=3, study=(1, 2, 3, 4, 5), path=2, points=28)
