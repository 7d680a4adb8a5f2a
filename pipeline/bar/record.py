"""What is known of one bar: K_b and K_g with their bands, critical loads, and what they were made from."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Literal

from pydantic import Field

from meshes.solid import Floats
from pipeline.bar.stress_record import Stresses
from pipeline.record import Record
from pipeline.validation.result import Buckling, Matrix
from reports.formats import named_entries


class MeshRecord(Record):
    """The mesh that `stiffness` was made on, and those of its study, coarse to fine."""

    kind: str
    """Cells by meshio's names, joined by + where there are several."""
    cells: int
    dofs: int
    study_dofs: list[int]
    quality: dict[str, float]
    """What was measured of its cells."""


class BarRecord(Record):
    """One bar. Units N, mm, rad, MPa; frame: x from the base point to the tip point; loads positive in compression."""

    schema_version: Literal[1] = 1
    kind: Literal["bar"] = "bar"
    name: str
    title: str
    length_mm: float
    """Between base point and tip point."""
    width_mm: float | None = None
    """Of the parallelogram that the case describes."""
    ends: dict[str, str]
    """What is the base, what is the tip, in words."""
    tie: str
    """How an end moves the solid: rigid, half or distributed."""
    material: dict[str, float | str]
    stiffness: Matrix
    """K_b, (6, 6) at the tip point, base held; of a section that of the working mesh, of a file extrapolated."""
    extrapolated: Matrix
    """K_b of the mesh study's limit."""
    numerical_band: dict[str, float]
    """Relative error of the entries of `stiffness` by its mesh; empty where it is not known: of one mesh as it came."""
    modelling_band: dict[str, float] = Field(default_factory=dict)
    """Relative spread of the entries of `stiffness` over ways to tie its ends; empty where only one was computed."""
    modelling: dict[str, Matrix] = Field(default_factory=dict)
    """K_b of each other way to tie the ends."""
    geometric: Matrix | None = None
    """K_g: derivative of the (6, 6) by the axial force at no load, tension positive, per N; None: not computed."""
    geometric_numerical_band: dict[str, float] = Field(default_factory=dict)
    geometric_modelling_band: dict[str, float] = Field(default_factory=dict)
    buckling: list[Buckling] = Field(default_factory=list)
    stress: Stresses | None = None
    """Under unit loads; None of a bar whose materials are all orthotropic, or where it is not computed."""
    mesh: MeshRecord
    said: list[str]
    """What a reader has to know, a sentence each."""
    seconds: dict[str, float]
    versions: dict[str, str]
    commit: str
    command: str
    data: dict[str, str] = Field(default_factory=dict)
    """sha256 of each file that it was made from."""


def relative_spread(matrix: Floats, others: Mapping[str, Floats]) -> dict[str, float]:
    """Largest relative difference of each entry of (6, 6) to that of the others; empty where there are none."""
    return {
        name: max(abs(float(other[ij] / matrix[ij] - 1.0)) for other in others.values())
        for name, ij in named_entries(matrix).items()
        if others
    }
