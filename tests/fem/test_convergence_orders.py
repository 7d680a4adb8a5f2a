"""The declared orders of the quadratic elements on a manufactured solution.

u = a sin(k·x) with constant vectors a and k. Lamé's equations, -(λ + μ) ∇(∇·u) - μ ∇²u = f, give by hand
∇·u = (a·k) cos(k·x), hence f = [(λ + μ) (a·k) k + μ |k|² a] sin(k·x).
Quadratic elements: the displacement error falls with h³, the energy error with h².
"""

from __future__ import annotations

import numpy as np
import pytest
import skfem
from skfem.io.meshio import INV_HEX_MAPPING

from fem.elasticity import stiffness_matrix
from fem.material import Isotropic
from fem.reduction import node_dofs
from fem.solvers import direct
from fem.space import Space
from meshes.discrete import discretise
from meshes.solid import SolidMesh

SIDES = (10.0, 8.0, 6.0)
AMPLITUDE = np.array([1.0, -0.6, 0.4])
WAVE = np.array([0.25, 0.2, -0.3])
# Below four cells a side the serendipity element falls faster than it will (order 3.6 from 2 to 4).
DIVISIONS = (4, 6, 9)
TO_MESHIO = np.argsort(INV_HEX_MAPPING)


def box(kind: str, n: int) -> SolidMesh:
    """An n x n x n box of one cell kind."""
    lines = [np.linspace(0.0, side, n + 1) for side in SIDES]
    if kind == "tetra10":
        basis = skfem.Basis(skfem.MeshTet.init_tensor(*lines), skfem.ElementTetP2())
        return SolidMesh(basis.doflocs.T.copy(), basis.element_dofs.T.astype(np.int64), kind, {})
    element, nodes = {"hexahedron20": (skfem.ElementHexS2, 20), "hexahedron27": (skfem.ElementHex2, 27)}[kind]
    basis = skfem.Basis(skfem.MeshHex.init_tensor(*lines), element())
    cells = basis.element_dofs[TO_MESHIO[:nodes]].T.astype(np.int64)
    return SolidMesh(basis.doflocs.T.copy(), cells, kind, {})


def errors(mesh: SolidMesh, material: Isotropic) -> tuple[float, float]:
    """L2 error of the displacement and of its gradient."""
    space, discrete = Space.of(mesh), discretise(mesh)
    basis = discrete.basis
    x = np.asarray(basis.global_coordinates())
    phase = np.einsum("a,amq->mq", WAVE, x)
    lame, mu = material.lame, material.shear_modulus
    amplitude = (lame + mu) * (AMPLITUDE @ WAVE) * WAVE + mu * (WAVE @ WAVE) * AMPLITUDE
    shapes = np.stack([np.broadcast_to(np.asarray(f[0]), phase.shape) for f in basis.basis], axis=-1)
    order = np.argsort(discrete.connectivity, axis=1)
    shapes = np.take_along_axis(shapes, order[:, None], axis=2)
    local = np.einsum("mq,mq,mqk,a->mka", space.weights, np.sin(phase), shapes, amplitude)
    load = space.vector(local)
    exact = (np.sin(mesh.points @ WAVE)[:, None] * AMPLITUDE).ravel()
    surface = np.any((mesh.points < 1e-9) | (mesh.points > np.array(SIDES) - 1e-9), axis=1)
    held, inner = node_dofs(np.flatnonzero(surface)), node_dofs(np.flatnonzero(~surface))
    k = stiffness_matrix(space, material)
    u = exact.copy()
    u[inner] = direct(k[inner][:, inner])(load[inner] - k[inner][:, held] @ exact[held])
    value = np.einsum("mqk,mka->mqa", shapes, u.reshape(-1, 3)[space.connectivity])
    gradient = space.displacement_gradient(u)
    off = value - np.sin(phase)[..., None] * AMPLITUDE
    slope = gradient - np.cos(phase)[..., None, None] * np.outer(AMPLITUDE, WAVE)
    return (
        float(np.sqrt(np.sum(space.weights[..., None] * off**2))),
        float(np.sqrt(np.sum(space.weights[..., None, None] * slope**2))),
    )


def orders(sizes: list[float], errors: np.ndarray) -> np.ndarray:
    """Order log(e_i / e_i+1) / log(h_i / h_i+1) between neighbouring meshes."""
    return np.asarray(np.diff(np.log(errors)) / np.diff(np.log(sizes)))


@pytest.mark.parametrize(
    "kind", ["hexahedron20", pytest.param("hexahedron27", marks=pytest.mark.long), "tetra10"]
)
def test_orders(kind: str, material: Isotropic) -> None:
    found = np.array([errors(box(kind, n), material) for n in DIVISIONS])
    sizes = [1.0 / n for n in DIVISIONS]
    displacement = orders(sizes, found[:, 0])
    energy = orders(sizes, found[:, 1])
    assert np.all(np.abs(displacement - 3.0) < 0.3), displacement
    assert np.all(np.abs(energy - 2.0) < 0.2), energy
