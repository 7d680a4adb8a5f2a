"""A mode of a bar as the motion of its axis and the twist of its sections, and how alike two such shapes are.

How alike: the modal assurance criterion (MAC), weighted with the geometric stiffness of an axial force,
(a, b)² / ((a, a)(b, b)) with (a, b) = ∫ y_a' y_b' + z_a' z_b' + r₀² θ_a' θ_b' dx. Buckling modes of a bar are
orthogonal in that product, so that it is 1 for the same mode and 0 for two different ones, whatever the supports.
Source: R. J. Allemang, The modal assurance criterion - twenty years of use and abuse, Sound and Vibration 37 (2003)
14-23 (weighted MAC); S. P. Timoshenko, J. M. Gere, Theory of Elastic Stability, 2nd ed., 5.4 (work of an axial force).
"""

from dataclasses import dataclass

import numpy as np

from meshes.solid import Floats, Ints, SolidMesh

# Of slabs along a bar whose nodes do not stand in sections, as those of tetrahedra do not.
SLABS = 32
# A section needs so many nodes for its twist to be told from its shift.
FEWEST_NODES = 4


@dataclass(frozen=True)
class AxisShape:
    """`x` (n,) stations in rising order, mm; `motion` (n, 3): shift along y and z, mm, and twist times r₀, mm."""

    x: Floats
    motion: Floats

    def at(self, x: Floats) -> "AxisShape":
        """The shape at other stations (m,), linear in between."""
        columns = [np.interp(x, self.x, column) for column in self.motion.T]
        return AxisShape(x, np.stack(columns, axis=1))

    def product(self, other: "AxisShape") -> float:
        """(a, b) of two shapes at the same stations, mm."""
        steps = np.diff(self.x)[:, None]
        return float(np.sum(np.diff(self.motion, axis=0) * np.diff(other.motion, axis=0) / steps))

    @property
    def plane(self) -> str:
        """What the shape is most: "xy", "xz" or "torsion"."""
        parts = np.sum(np.diff(self.motion, axis=0) ** 2 / np.diff(self.x)[:, None], axis=0)
        return ("xy", "xz", "torsion")[int(np.argmax(parts))]


def mac(a: AxisShape, b: AxisShape) -> float:
    """0 to 1; of shapes at different stations the ones with fewer of them are used."""
    x = a.x if len(a.x) <= len(b.x) else b.x
    a, b = (s if s.x is x else s.at(x) for s in (a, b))
    own = a.product(a) * b.product(b)
    return a.product(b) ** 2 / own if own > 0.0 else 0.0


def axis_shape(mesh: SolidMesh, displacements: Floats, polar_radius: float) -> AxisShape:
    """Shape of a bar along x from node displacements (dofs,) mm; `polar_radius` r₀ in mm.

    Every section, or slab of nodes where the mesh has no sections, is fitted by a shift and a turn about x in the
    least-squares sense.
    """
    u, points = displacements.reshape(-1, 3), mesh.points
    station = stations(points[:, 0])
    count = np.bincount(station).astype(float)

    def mean(values: Floats) -> Floats:
        return np.asarray(np.bincount(station, values) / count)

    x, y, z, uy, uz = (mean(v) for v in (*points.T, u[:, 1], u[:, 2]))
    dy, dz = points[:, 1] - y[station], points[:, 2] - z[station]
    arms = np.bincount(station, dy**2 + dz**2)
    turning = np.bincount(station, dy * (u[:, 2] - uz[station]) - dz * (u[:, 1] - uy[station]))
    twist = turning / np.where(arms > 0.0, arms, 1.0)
    return AxisShape(x, np.stack((uy + twist * z, uz - twist * y, polar_radius * twist), axis=1))


def stations(x: Floats) -> Ints:
    """Number of the section or slab that each node (n,) belongs to, in rising x, all of them filled."""
    length = float(np.ptp(x))
    _, index, counts = np.unique(np.round(x / length, 6), return_inverse=True, return_counts=True)
    if counts.min() < FEWEST_NODES:
        slab = np.minimum((SLABS * (x - x.min()) / length).astype(np.int64), SLABS - 1)
        _, index = np.unique(slab, return_inverse=True)
    return np.asarray(index, dtype=np.int64).ravel()


def section_sizes(mesh: SolidMesh) -> Floats:
    """Number of nodes (n,) at each station of `axis_shape`."""
    return np.bincount(stations(mesh.points[:, 0])).astype(float)
