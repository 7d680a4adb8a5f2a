"""A bar of one's own: a section of a material, its 6x6 as a beam and as a solid."""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray
from rich.console import RenderableType
from rich.table import Table

from fem.beam import uniform_stiffness
from fem.material import Isotropic
from fem.stiffness import bar_stiffness
from fem.torsion import torsion_constant
from meshes.bar import Bar, Lug
from meshes.resolution import Resolution
from meshes.section import Section
from meshes.store import mesh_bar
from pipeline.errors import InputError
from pipeline.face.shown import Drawn
from pipeline.provenance import commit, versions
from pipeline.system import require
from pipeline.terminal import lean, one_line
from reports.quantities import percent, short

if TYPE_CHECKING:
    from pandas import DataFrame

    from reports.first_screen.drawn import Picture

Array = NDArray[np.float64]
DISPLACEMENTS = ("x", "y", "z", "rx", "ry", "rz")
LOADS = ("Fx", "Fy", "Fz", "Mx", "My", "Mz")
SHARE = 0.5
"""Of the section's smaller side, the size of an element of the coarse mesh that is taken where none is asked for."""
SEEN = 1e-6
"""Of the largest entry, both scaled by the length, an entry below which is rounding."""


@dataclass(frozen=True, eq=False, repr=False)
class OwnBar(Drawn):
    """A straight bar by its drawing. geometry: section, length and lugs, mm. material: E in MPa, nu."""

    geometry: Bar
    material: Isotropic

    @property
    def length(self) -> float:
        """mm between its ends."""
        return self.geometry.length

    @property
    def stiffness(self) -> Array:
        """(6, 6) of the slender beam of this section, without lugs, in closed form: x y z rx ry rz of the tip to
        Fx Fy Fz Mx My Mz, base clamped, bar frame; N, mm, rad."""
        return np.asarray(uniform_stiffness(self.length, *(value for _, value, _ in self._rigidities())))

    @property
    def headline(self) -> str:
        kind = type(self.geometry.section).__name__
        y, z = self.geometry.section.size
        said = f"bar of {short(self.length)} mm, {kind} {short(y)} x {short(z)} mm"
        return one_line(
            f"{said}{', with lugs' if self.geometry.lug else ''}, E = {short(self.material.E)} MPa", said
        )

    @property
    def following(self) -> tuple[str, ...]:
        return ("parastiff.identify_bar(bar) finds its 6x6 on a solid mesh, lugs included.",)

    def tables(self) -> tuple[RenderableType, ...]:
        table = lean("of the section", "value")
        table.add_column("unit")
        for name, value, unit in self._numbers():
            table.add_row(name, short(value, 4), unit)
        return (table,)

    def plot(self) -> Picture:
        """The section, mm."""
        from reports.first_screen.figures import outline

        return outline(_outlines(self.geometry.section), self.headline)

    def to_frame(self) -> DataFrame:
        """Area, second moments, torsion constant and rigidities of the section: quantity, value, unit."""
        from pandas import DataFrame

        return DataFrame(self._numbers(), columns=["quantity", "value", "unit"])

    def json(self) -> str:
        numbers = {name: {"value": value, "unit": unit} for name, value, unit in self._numbers()}
        return json.dumps({"length_mm": self.length, "section": numbers}, indent=1) + "\n"

    def _rigidities(self) -> list[tuple[str, float, str]]:
        section, E = self.geometry.section, self.material.E
        iy, iz = section.second_moments
        shear = self.material.shear_modulus * torsion_constant(section)
        return [
            ("EA", E * section.area, "N"),
            ("EIy", E * iy, "N·mm²"),
            ("EIz", E * iz, "N·mm²"),
            ("GJ", shear, "N·mm²"),
        ]

    def _numbers(self) -> list[tuple[str, float, str]]:
        section = self.geometry.section
        iy, iz = section.second_moments
        return [("A", section.area, "mm²"), ("Iy", iy, "mm⁴"), ("Iz", iz, "mm⁴"), *self._rigidities()]


@dataclass(frozen=True, eq=False, repr=False)
class BarStiffness(Drawn):
    """K_b of a bar. matrix: (6, 6), x y z rx ry rz of the tip to Fx Fy Fz Mx My Mz, base clamped, bar frame; N, mm,
    rad.

    length: mm. mesh_change: largest relative change of an entry from the mesh before the finest, by which the numbers
    may still be off. beam: the same of the slender beam without lugs.
    """

    matrix: Array
    length: float
    mesh_change: float
    beam: Array
    about: str

    @property
    def headline(self) -> str:
        said = f"K_b on a solid mesh, {percent(self.mesh_change)} from the mesh before"
        return one_line(f"{self.about}: {said}", said)

    @property
    def sentences(self) -> tuple[str, ...]:
        k, b = self.matrix, self.beam
        told = ", ".join(f"K{i + 1}{i + 1} {100.0 * (k[i, i] / b[i, i] - 1.0):+.1f} %" for i in range(6))
        return (f"{self.headline}.", f"Beside the slender beam without lugs: {told}.")

    @property
    def following(self) -> tuple[str, ...]:
        return (
            "rigs.parallelogram(length_mm=..., width_mm=..., bar_stiffness=it.matrix) makes a linkage of it.",
        )

    def tables(self) -> tuple[RenderableType, ...]:
        return (matrix_table(self.matrix, self.length),)

    def plot(self) -> Picture:
        """Size of the entries; rows are loads, columns displacements, as far as rounding does not hide them."""
        from reports.first_screen.figures import matrix

        return matrix(clean(self.matrix, self.length).tolist(), LOADS, DISPLACEMENTS, self.headline)

    def to_frame(self) -> DataFrame:
        """6 x 6: rows the loads at the tip, columns its displacements; N, mm, rad."""
        return matrix_frame(self.matrix)

    def json(self) -> str:
        record = {
            "K_b": self.matrix.tolist(),
            "length_mm": self.length,
            "units": "N, mm, rad",
            "mesh_change": self.mesh_change,
            "about": self.about,
            "versions": versions(),
            "commit": commit(),
        }
        return json.dumps(record, indent=1, ensure_ascii=False) + "\n"


def bar(
    section: Section, length: float, E: float, nu: float, lug: tuple[float, float, float] | None = None
) -> OwnBar:
    """A straight bar by its drawing.

    section: one of `sections`, in the plane of y and z, mm. length: mm between its ends, along x. E: MPa. nu: Poisson's
    ratio. lug: length (x), width (y) and height (z) of a block at each end, mm; default none. InputError for a shape
    that cannot be.
    """
    try:
        return OwnBar(Bar(section, length, None if lug is None else Lug(*lug)), Isotropic(E, nu))
    except ValueError as error:
        raise InputError(str(error)) from error


def identify_bar(it: OwnBar, size: float | None = None, level: int = 2) -> BarStiffness:
    """K_b of a bar on its solid mesh: base clamped, tip face rigid, six unit motions of the tip.

    size: mm of a coarse element, default half of the section's smaller side. level: how often each coarse element is
    divided, at least 2, so that the mesh before tells what is still off. InputError for a mesh that no machine could
    hold; RuntimeError where mesher or solver fail. It needs the extra `solid`.
    """
    require("solid")
    if level < 2:
        raise InputError(
            f"level is {level}, allowed is a whole number from 2: one mesh does not tell its error"
        )
    coarse = size or SHARE * min(it.geometry.section.size)
    try:
        before, finest = (
            bar_stiffness(mesh_bar(it.geometry, Resolution(coarse, number)), it.length, it.material)
            for number in (level - 1, level)
        )
    except ValueError as error:
        raise InputError(str(error)) from error
    scale = np.repeat([1.0, 1.0 / it.length], 3)
    there = np.abs(scale[:, None] * finest * scale) > SEEN * np.abs(scale[:, None] * finest * scale).max()
    change = float(np.max(np.abs(before[there] / finest[there] - 1.0)))
    return BarStiffness(np.asarray(finest), it.length, change, it.stiffness, it.headline)


def clean(matrix: Array, length: float) -> Array:
    """(6, 6) with entries that are rounding, rotations counted as arcs, as zero."""
    scale = np.repeat([1.0, 1.0 / length], 3)
    sizes = np.abs(scale[:, None] * matrix * scale)
    return np.where(sizes > SEEN * sizes.max(), matrix, 0.0)


def matrix_table(matrix: Array, length: float) -> Table:
    """A 6x6 on a terminal: rows loads, columns displacements."""
    table = lean("N, mm, rad", *DISPLACEMENTS)
    for name, row in zip(LOADS, clean(matrix, length), strict=True):
        table.add_row(name, *(short(float(value), 4) if value else "·" for value in row))
    return table


def matrix_frame(matrix: Array) -> DataFrame:
    """A 6x6 as a table."""
    from pandas import DataFrame, Index

    return DataFrame(matrix, index=Index(LOADS, name="load"), columns=list(DISPLACEMENTS))


def _outlines(section: Section) -> list[list[tuple[float, float]]]:
    """Corners of the patches, arcs about the origin as short lines."""
    out = []
    for patch in section.patches():
        points: list[tuple[float, float]] = []
        for k, (corner, arc) in enumerate(zip(patch.corners, patch.arcs, strict=True)):
            points.append(corner)
            if arc:
                points += _arc(corner, patch.corners[(k + 1) % 4])
        out.append(points)
    return out


def _arc(begin: tuple[float, float], end: tuple[float, float]) -> list[tuple[float, float]]:
    first, last = (np.arctan2(z, y) for y, z in (begin, end))
    turn = (last - first + np.pi) % (2.0 * np.pi) - np.pi
    radius = float(np.hypot(*begin))
    angles = first + turn * np.linspace(0.0, 1.0, 12)[1:-1]
    return [(radius * float(np.cos(a)), radius * float(np.sin(a))) for a in angles]
