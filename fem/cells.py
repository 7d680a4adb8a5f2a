"""Shape functions of the quadratic cells and facets of a brought mesh, and where they are integrated.

Nodes in the order of meshio. Serendipity functions of the 15-node wedge and the 20-node hexahedron: O. C. Zienkiewicz,
R. L. Taylor, The Finite Element Method, 5th ed., vol. 1, ch. 8. A wedge has 9 points, as it has in other programs.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from itertools import product

import numpy as np
from numpy.polynomial.legendre import leggauss

from meshes.solid import EDGES, Floats

TET_EDGES = ((0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3))
TRIANGLE_EDGES = ((0, 1), (1, 2), (2, 0))
HEX_CORNERS = np.array(
    [[-1, -1, -1], [1, -1, -1], [1, 1, -1], [-1, 1, -1], [-1, -1, 1], [1, -1, 1], [1, 1, 1], [-1, 1, 1]]
)
# Of meshio's 27-node hexahedron, beyond the edges: middles of the faces, then of the cell.
HEX_FACES = np.array([[-1, 0, 0], [1, 0, 0], [0, -1, 0], [0, 1, 0], [0, 0, -1], [0, 0, 1], [0, 0, 0]])


@dataclass(frozen=True, eq=False)
class Reference:
    """A reference cell at q integration points: `values` (q, k), `slopes` (q, k, d) of k functions, `weights` (q,)."""

    values: Floats
    slopes: Floats
    weights: Floats


@cache
def reference(kind: str) -> Reference:
    """The reference cell of one of meshio's kinds; ValueError for another one."""
    if kind not in _FUNCTIONS:
        raise ValueError(f"cell kind is {kind!r}, allowed are {', '.join(_FUNCTIONS)}")
    functions, rule = _FUNCTIONS[kind]
    points, weights = rule()
    values, slopes = functions(points)
    return Reference(values, slopes, weights)


def nodal_slopes(kind: str) -> Floats:
    """(k, k, d) slopes of the functions at the nodes themselves: where a curved cell folds over first."""
    functions, _ = _FUNCTIONS[kind]
    return functions(_NODES[kind]())[1]


def corner_functions(barycentric: Floats, gradients: Floats) -> tuple[Floats, Floats]:
    """Linear functions (q, k) and slopes (q, k, d) to the quadratic ones: corners, then `edges`."""
    edges = TRIANGLE_EDGES if barycentric.shape[1] == 3 else TET_EDGES
    b, g = barycentric, gradients
    corners = b * (2.0 * b - 1.0)
    slopes = (4.0 * b - 1.0)[:, :, None] * g
    middles = [4.0 * b[:, i] * b[:, j] for i, j in edges]
    middle_slopes = [4.0 * (b[:, i, None] * g[:, j] + b[:, j, None] * g[:, i]) for i, j in edges]
    return (
        np.concatenate((corners, np.stack(middles, axis=1)), axis=1),
        np.concatenate((slopes, np.stack(middle_slopes, axis=1)), axis=1),
    )


def _simplex(points: Floats) -> tuple[Floats, Floats]:
    """Barycentric functions (q, d + 1) of points (q, d) and their slopes (q, d + 1, d)."""
    d = points.shape[1]
    b = np.concatenate((1.0 - points.sum(axis=1, keepdims=True), points), axis=1)
    g = np.concatenate((-np.ones((1, d)), np.eye(d)))
    return b, np.broadcast_to(g, (len(points), d + 1, d))


def _quadratic_simplex(points: Floats) -> tuple[Floats, Floats]:
    return corner_functions(*_simplex(points))


def _wedge15(points: Floats) -> tuple[Floats, Floats]:
    """Corners below and above, edges below, edges above, upright edges."""
    b, g = _simplex(points[:, :2])
    z = points[:, 2]
    values: list[Floats] = []
    slopes: list[Floats] = []

    def add(plane: Floats, plane_slope: Floats, along: Floats, along_slope: Floats) -> None:
        values.append(plane * along)
        slopes.append(np.concatenate((plane_slope * along[:, None], (plane * along_slope)[:, None]), axis=1))

    bubble, bubble_slope = 1.0 - z**2, -2.0 * z
    for side in (-1.0, 1.0):
        half, half_slope = 0.5 * (1.0 + side * z), np.full_like(z, 0.5 * side)
        for i in range(3):
            add(b[:, i] * (2.0 * b[:, i] - 1.0), (4.0 * b[:, i] - 1.0)[:, None] * g[:, i], half, half_slope)
            values[-1] = values[-1] - 0.5 * b[:, i] * bubble
            less = np.concatenate((g[:, i] * bubble[:, None], (b[:, i] * bubble_slope)[:, None]), axis=1)
            slopes[-1] = slopes[-1] - 0.5 * less
    for side in (-1.0, 1.0):
        half, half_slope = 0.5 * (1.0 + side * z), np.full_like(z, 0.5 * side)
        for i, j in TRIANGLE_EDGES:
            add(
                4.0 * b[:, i] * b[:, j],
                4.0 * (b[:, i, None] * g[:, j] + b[:, j, None] * g[:, i]),
                half,
                half_slope,
            )
    for i in range(3):
        add(b[:, i], g[:, i], bubble, bubble_slope)
    return np.stack(values, axis=1), np.stack(slopes, axis=1)


def _serendipity(places: Floats) -> Callable[[Floats], tuple[Floats, Floats]]:
    """Functions of nodes at `places` (k, d) of a square or a cube: corners and middles of edges."""

    def functions(points: Floats) -> tuple[Floats, Floats]:
        d = places.shape[1]
        values, slopes = [], []
        for place in places:
            middle = place == 0
            factors = np.where(middle, 1.0 - points**2, 0.5 * (1.0 + points * place))
            rates = np.where(middle, -2.0 * points, 0.5 * np.broadcast_to(place, points.shape))
            # A corner is less by one for every edge that meets there.
            more = np.ones(len(points)) if middle.any() else points @ place - (d - 1.0)
            more_rate = np.zeros(d) if middle.any() else place.astype(float)
            whole = np.prod(factors, axis=1)
            others = [np.prod(np.delete(factors, a, axis=1), axis=1) for a in range(d)]
            values.append(whole * more)
            slopes.append(
                np.stack([rates[:, a] * others[a] * more + whole * more_rate[a] for a in range(d)], axis=1)
            )
        return np.stack(values, axis=1), np.stack(slopes, axis=1)

    return functions


def _lagrange(places: Floats) -> Callable[[Floats], tuple[Floats, Floats]]:
    """Products of quadratic functions of each coordinate."""

    def one(x: Floats, at: float) -> tuple[Floats, Floats]:
        if at == 0.0:
            return 1.0 - x**2, -2.0 * x
        return 0.5 * x * (x + at), x + 0.5 * at

    def functions(points: Floats) -> tuple[Floats, Floats]:
        values, slopes = [], []
        for place in places:
            parts = [one(points[:, a], float(place[a])) for a in range(places.shape[1])]
            values.append(np.prod([p[0] for p in parts], axis=0))
            own = [
                np.prod([p[1] if b == a else p[0] for b, p in enumerate(parts)], axis=0)
                for a in range(len(parts))
            ]
            slopes.append(np.stack(own, axis=1))
        return np.stack(values, axis=1), np.stack(slopes, axis=1)

    return functions


def _cube(dimension: int) -> tuple[Floats, Floats]:
    x, w = leggauss(3)
    points = np.array(list(product(x, repeat=dimension)))
    return points, np.array([np.prod(p) for p in product(w, repeat=dimension)])


def _triangle() -> tuple[Floats, Floats]:
    """Six points, exact to degree 4. Source: D. A. Dunavant, Int. J. Numer. Meth. Engng 21 (1985) 1129-1148."""
    points, weights = [], []
    for a, w in ((0.445948490915965, 0.223381589678011), (0.091576213509771, 0.109951743655322)):
        points += [(a, a), (1.0 - 2.0 * a, a), (a, 1.0 - 2.0 * a)]
        weights += [0.5 * w] * 3
    return np.array(points), np.array(weights)


def _wedge() -> tuple[Floats, Floats]:
    x, w = leggauss(3)
    corners = [(1 / 6, 1 / 6), (2 / 3, 1 / 6), (1 / 6, 2 / 3)]
    points = np.array([(*p, z) for z in x for p in corners])
    return points, np.repeat(w, 3) / 6.0


def _tetrahedron() -> tuple[Floats, Floats]:
    # Late: it is slow to import.
    from skfem import quadrature, refdom

    points, weights = quadrature.get_quadrature(refdom.RefTet, 5)
    return np.asarray(points.T), np.asarray(weights)


def _simplex_nodes(dimension: int) -> Floats:
    corners = np.concatenate((np.zeros((1, dimension)), np.eye(dimension)))
    edges = TRIANGLE_EDGES if dimension == 2 else TET_EDGES
    return np.concatenate((corners, [0.5 * (corners[i] + corners[j]) for i, j in edges]))


def _wedge_nodes() -> Floats:
    flat = _simplex_nodes(2)
    layers = [(flat[:3], -1.0), (flat[:3], 1.0), (flat[3:], -1.0), (flat[3:], 1.0), (flat[:3], 0.0)]
    return np.concatenate([np.column_stack((part, np.full(len(part), z))) for part, z in layers])


HEX20 = np.concatenate((HEX_CORNERS, HEX_CORNERS[EDGES].mean(axis=1)))
HEX27 = np.concatenate((HEX20, HEX_FACES))
QUAD8 = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1], [0, -1], [1, 0], [0, 1], [-1, 0]], dtype=float)
QUAD9 = np.concatenate((QUAD8, [[0.0, 0.0]]))

_Functions = Callable[[Floats], tuple[Floats, Floats]]
_FUNCTIONS: dict[str, tuple[_Functions, Callable[[], tuple[Floats, Floats]]]] = {
    "tetra10": (_quadratic_simplex, _tetrahedron),
    "wedge15": (_wedge15, _wedge),
    "hexahedron20": (_serendipity(HEX20), lambda: _cube(3)),
    "hexahedron27": (_lagrange(HEX27), lambda: _cube(3)),
    "triangle6": (_quadratic_simplex, _triangle),
    "quad8": (_serendipity(QUAD8), lambda: _cube(2)),
    "quad9": (_lagrange(QUAD9), lambda: _cube(2)),
}
_NODES: dict[str, Callable[[], Floats]] = {
    "tetra10": lambda: _simplex_nodes(3),
    "wedge15": _wedge_nodes,
    "hexahedron20": lambda: HEX20,
    "hexahedron27": lambda: HEX27,
    "triangle6": lambda: _simplex_nodes(2),
    "quad8": lambda: QUAD8,
    "quad9": lambda: QUAD9,
}
