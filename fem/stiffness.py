"""K_b: the 6x6 stiffness of a solid bar, base face fixed, tip face rigid about its middle."""

from fem.linear import LinearModel
from fem.linkage import single_bar
from fem.material import Isotropic
from fem.solvers import Solver, automatic
from fem.space import Space
from meshes.solid import Floats, SolidMesh


def bar_stiffness(mesh: SolidMesh, length: float, material: Isotropic, solver: Solver = automatic) -> Floats:
    """(6, 6) stiffness at the middle of the tip face, bar frame, N, mm, rad; symmetric and positive definite.

    One factorisation serves the six unit motions of the tip. Raises SolveError if the system cannot be solved.
    """
    return LinearModel(single_bar(Space.of(mesh), length), material, solver).stiffness
