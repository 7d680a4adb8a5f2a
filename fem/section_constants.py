"""Constants of a section as a beam: torsion, warping and shear areas, from Saint-Venant's problems.

Two Poisson problems for sections with two axes of symmetry (centroid and shear centre coincide):
torsion: ∇²ω = 0 with n·∇ω = z n_y - y n_z gives J = ∫ (ω_y - z)² + (ω_z + y)² dA and Iw = ∫ ω² dA;
shear:   ∇²Ψ = -2 s with n·∇Ψ = n·d, s the coordinate along the force, gives the shear stress
τ = V (∇Ψ - d) / (2 (1 + ν) I), and the shear area from its energy, V² / A_s = ∫ τ² dA.
Source: W. D. Pilkey, Analysis and Design of Elastic Beams, Wiley 2002, chapters 5 and 6.
"""

from dataclasses import dataclass

import numpy as np
import skfem
from skfem.helpers import dot, grad

from fem.solvers import direct
from meshes.plane import PlaneMesh, mesh_section
from meshes.section import Section
from meshes.solid import Floats


@dataclass(frozen=True)
class SectionConstants:
    """Area in mm²; Iy = ∫z² dA, Iz = ∫y² dA, J in mm⁴; Iw in mm⁶; shear areas for forces along y and z in mm²."""

    area: float
    Iy: float
    Iz: float
    J: float
    Iw: float
    shear_area_y: float
    shear_area_z: float


def section_constants(section: Section, nu: float, size: float | None = None) -> SectionConstants:
    """Constants of a section for Poisson's ratio `nu`; element `size` in mm, by default a fiftieth of the section."""
    mesh = mesh_section(section, size or max(section.size) / 50)
    basis = skfem.Basis(plane_to_skfem(mesh), skfem.ElementQuad2(), intorder=6)
    y, z = np.asarray(basis.global_coordinates())
    weights = basis.dx
    iy, iz = float(np.sum(z * z * weights)), float(np.sum(y * y * weights))
    omega = solve_poisson(basis, np.stack([z, -y]), np.zeros_like(y))
    value = basis.interpolate(omega)
    wy, wz = value.grad
    j = float(np.sum(((wy - z) ** 2 + (wz + y) ** 2) * weights))
    iw = float(np.sum(np.asarray(value) ** 2 * weights))
    # d makes the shear stress compatible with the anticlastic bending strains.
    d_y = 0.5 * nu * np.stack([y * y - z * z, 2 * y * z])
    d_z = 0.5 * nu * np.stack([2 * y * z, z * z - y * y])
    area_y = shear_area(basis, d_y, y, iz, nu)
    area_z = shear_area(basis, d_z, z, iy, nu)
    return SectionConstants(float(np.sum(weights)), iy, iz, j, iw, area_y, area_z)


def shear_area(basis: skfem.Basis, d: Floats, along: Floats, moment: float, nu: float) -> float:
    """Shear area, mm², for a force along one axis; `moment` is the second moment for bending by that force, mm⁴.

    d: (2, cells, q) mm², at q points of each cell. along: (cells, q) the coordinate along the force, mm.
    """
    psi = basis.interpolate(solve_poisson(basis, d, 2.0 * (1.0 + nu) * along))
    tau = (psi.grad - d) / (2.0 * (1.0 + nu) * moment)
    return float(1.0 / np.sum(np.sum(tau**2, axis=0) * basis.dx))


def solve_poisson(basis: skfem.Basis, flux: Floats, source: Floats) -> Floats:
    """Nodal u of zero mean with ∫∇u·∇v = ∫ flux·∇v + source v, for `flux` (2, m, q) and `source` (m, q)."""
    laplace = skfem.BilinearForm(lambda u, v, _: dot(grad(u), grad(v))).assemble(basis)
    load = skfem.LinearForm(lambda v, w: dot(w.flux, grad(v)) + w.source * v).assemble(
        basis, flux=flux, source=source
    )
    u = np.zeros(basis.N)
    u[1:] = direct(laplace[1:][:, 1:])(load[1:])
    return u - float(np.sum(np.asarray(basis.interpolate(u)) * basis.dx) / np.sum(basis.dx))


def plane_to_skfem(mesh: PlaneMesh) -> skfem.MeshQuad2:
    """The section mesh with curved quadrilaterals."""
    return skfem.MeshQuad2(
        np.ascontiguousarray(mesh.points.T), np.ascontiguousarray(mesh.cells.T), validate=False
    )
