"""How closely a run looks: mesh levels for each kind of question."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Detail:
    """Mesh levels: `working` of K_b and linear buckling, `study` of the convergence study, `path` of load paths.

    `steps` in which one path of the solid is followed anew, to see that they make no difference.
    The paths are sampled at `travel`, at the first `path_angles` angles of the case and the first `path_sets` ways of
    holding the platform (None: all of them).
    """

    name: str
    working: int
    study: tuple[int, ...]
    path: int
    travel: tuple[float, ...]
    steps: tuple[int, ...] = (10, 20)
    path_angles: int | None = None
    path_sets: int | None = None

    @property
    def companion(self) -> int:
        """Mesh level beside the working one, for the error of critical loads."""
        return self.working - 1 if self.working > 1 else self.working + 1


# Travel of a load path in units of that at the linear critical load: close-set where the branches part.
LOOK = (0.4, 0.8, 0.97, 1.0, 1.1)
SOME = (0.3, 0.6, 0.8, 0.9, 0.95, 0.98, 1.0, 1.02, 1.05, 1.1, 1.2, 1.4, 1.7)
MANY = tuple(
    sorted({*SOME, 0.15, 0.45, 0.7, 0.85, 0.93, 0.965, 0.99, 1.01, 1.035, 1.075, 1.15, 1.3, 1.55, 1.85, 2.0})
)
COARSE = Detail(
    "coarse", working=1, study=(1, 2, 3), path=1, travel=LOOK, steps=(5, 10), path_angles=1, path_sets=1
)
DEFAULT = Detail("default", working=2, study=(1, 2, 3, 4), path=1, travel=SOME)
FINE = Detail("fine", working=3, study=(1, 2, 3, 4, 5), path=2, travel=MANY, steps=(10, 20, 40))
