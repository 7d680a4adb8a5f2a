"""Orthotropic material, and materials by region of a mesh."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from fem.material import Isotropic
from meshes.solid import Floats, Ints

# Strains 11 22 33 23 13 12 as places of a tensor.
PLACES = ((0, 0), (1, 1), (2, 2), (1, 2), (0, 2), (0, 1))


@dataclass(frozen=True)
class Orthotropic:
    """Nine constants along three axes at right angles, MPa; `axes` (3 rows of 3) in the frame of the mesh.

    nu12: contraction along 2 under a pull along 1, so that nu12 / E1 = nu21 / E2.
    Raises ValueError for constants that no stable solid has, or axes that are not at right angles.
    """

    E1: float
    E2: float
    E3: float
    nu12: float
    nu13: float
    nu23: float
    G12: float
    G13: float
    G23: float
    axes: tuple[tuple[float, float, float], ...] = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
    source: str = ""

    def __post_init__(self) -> None:
        for name in ("E1", "E2", "E3", "G12", "G13", "G23"):
            if not getattr(self, name) > 0.0:
                raise ValueError(f"{name} is {getattr(self, name):g} MPa, allowed is above 0")
        if np.linalg.eigvalsh(self.compliance[:3, :3])[0] <= 0.0:
            raise ValueError(
                f"nu12 = {self.nu12:g}, nu13 = {self.nu13:g}, nu23 = {self.nu23:g} with these E would give energy back "
                "when strained, allowed is a positive definite stiffness"
            )
        turn = np.array(self.axes)
        if turn.shape != (3, 3) or np.abs(turn @ turn.T - np.eye(3)).max() > 1e-6:
            raise ValueError("the material's axes are not three unit vectors at right angles")

    @property
    def compliance(self) -> Floats:
        """(6, 6) from stresses 11 22 33 23 13 12 to strains (shear strains as angles), material axes, 1/MPa."""
        s = np.diag([1 / self.E1, 1 / self.E2, 1 / self.E3, 1 / self.G23, 1 / self.G13, 1 / self.G12])
        s[0, 1] = s[1, 0] = -self.nu12 / self.E1
        s[0, 2] = s[2, 0] = -self.nu13 / self.E1
        s[1, 2] = s[2, 1] = -self.nu23 / self.E2
        return s

    @cached_property
    def tensor(self) -> Floats:
        """C_abcd, (3, 3, 3, 3) MPa, frame of the mesh."""
        return turned(full_tensor(np.asarray(np.linalg.inv(self.compliance), float)), np.array(self.axes).T)


def full_tensor(voigt: Floats) -> Floats:
    """(6, 6) stiffness by places 11 22 33 23 13 12 as (3, 3, 3, 3)."""
    c = np.zeros((3, 3, 3, 3))
    for i, (a, b) in enumerate(PLACES):
        for j, (d, e) in enumerate(PLACES):
            for first in {(a, b), (b, a)}:
                for second in {(d, e), (e, d)}:
                    c[(*first, *second)] = voigt[i, j]
    return c


def turned(tensor: Floats, turn: Floats) -> Floats:
    """The tensor seen from the frame that `turn` (3, 3) leads to: columns are the old axes in it."""
    return np.asarray(np.einsum("abcd,ia,jb,kc,ld->ijkl", tensor, turn, turn, turn, turn, optimize=True))


def isotropic_tensor(material: Isotropic) -> Floats:
    """(3, 3, 3, 3) C_abcd = λ δ_ab δ_cd + μ (δ_ac δ_bd + δ_ad δ_bc), MPa."""
    d = np.eye(3)
    shear = np.einsum("ac,bd->abcd", d, d) + np.einsum("ad,bc->abcd", d, d)
    return np.asarray(material.lame * np.einsum("ab,cd->abcd", d, d) + material.shear_modulus * shear)


@dataclass(frozen=True, eq=False)
class Regional:
    """Different materials in one mesh: `of_cell` (m,) is the number of each cell's material, in the space's order."""

    materials: tuple[Isotropic | Orthotropic, ...]
    of_cell: Ints

    @cached_property
    def tensors(self) -> Floats:
        """(n, 3, 3, 3, 3) C_abcd of every material, MPa."""
        return np.stack([tensor_of(each) for each in self.materials])

    def in_frame(self, turn: Floats) -> "Regional":
        """The same materials where the mesh has been turned by `turn` (3, 3): new = turn old."""
        return Regional(tuple(in_frame(each, turn) for each in self.materials), self.of_cell)


def tensor_of(material: Isotropic | Orthotropic) -> Floats:
    """C_abcd of a material, (3, 3, 3, 3) MPa."""
    return material.tensor if isinstance(material, Orthotropic) else isotropic_tensor(material)


def in_frame(material: Isotropic | Orthotropic, turn: Floats) -> Isotropic | Orthotropic:
    """The material in a mesh that has been turned by a rotation (3, 3)."""
    if isinstance(material, Isotropic):
        return material
    axes = tuple((float(x), float(y), float(z)) for x, y, z in np.array(material.axes) @ turn.T)
    values = {k: v for k, v in vars(material).items() if k in material.__dataclass_fields__}
    return Orthotropic(**{**values, "axes": axes})


def regional_blocks(gram: Floats, tensors: Floats, of_cell: Ints) -> Floats:
    """C_abcd ∂_b N_i ∂_d N_j, integrated: (m, k, k, 3, 3) over i, j, a, c, of the cells' Gram blocks of that shape."""
    m, k = gram.shape[:2]
    out = np.empty_like(gram)
    for number in np.unique(of_cell):
        own = of_cell == number
        law = tensors[number].transpose(1, 3, 0, 2).reshape(9, 9)
        out[own] = (gram[own].reshape(-1, 9) @ law).reshape(-1, k, k, 3, 3)
    assert m == len(of_cell)
    return out


def regional_stress(strain: Floats, tensors: Floats, of_cell: Ints) -> Floats:
    """Stress (m, q, 3, 3) MPa of strains (m, q, 3, 3)."""
    m, q = strain.shape[:2]
    law = tensors[of_cell].reshape(m, 9, 9)
    return (strain.reshape(m, q, 9) @ law.transpose(0, 2, 1)).reshape(m, q, 3, 3)
