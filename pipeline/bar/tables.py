"""The tables of a case whose bar is a file: their keys, and the values that each of them allows."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import Field, ValidationInfo, field_validator, model_validator

from meshes.brought.units import UNITS
from pipeline.validation.case_tables import Angle, Length, LinkageSize, Material, Number, Part

Vector = tuple[Number, Number, Number]
Modulus = Annotated[Number, Field(gt=0.0)]


class PlaneEnd(Part):
    """All of the surface in one plane."""

    plane: Vector
    """A point of it, mm, in the file's frame."""
    normal: Vector
    """Its normal, of any length."""


class CylinderEnd(Part):
    """All of the surface on one cylinder: a bore, or the bores of a fork; its axis is the hinge."""

    cylinder: Vector
    """A point of its axis, mm, in the file's frame."""
    axis: Vector
    """Along its axis, of any length."""
    radius: Length
    """Its radius, mm."""


class NamedEnd(Part):
    """A face or a set by its name in the file."""

    name: str
    """Of a face, a group or a set."""


EndTable = PlaneEnd | CylinderEnd | NamedEnd


class OrthotropicMaterial(Part):
    """Nine constants along three axes."""

    E1_MPa: Modulus
    """Young's modulus along the first axis."""
    E2_MPa: Modulus
    """Along the second."""
    E3_MPa: Modulus
    """Along the third."""
    nu12: Number
    """Contraction along 2 under a pull along 1."""
    nu13: Number
    """Contraction along 3 under a pull along 1."""
    nu23: Number
    """Contraction along 3 under a pull along 2."""
    G12_MPa: Modulus
    """Shear modulus in the plane of 1 and 2."""
    G13_MPa: Modulus
    """In the plane of 1 and 3."""
    G23_MPa: Modulus
    """In the plane of 2 and 3."""
    axes: tuple[Vector, Vector, Vector] = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
    """The three axes in the file's frame, unit vectors at right angles."""
    source: str = ""
    """Where these values are from."""


class FileBar(Part):
    """The bar as a file: CAD or mesh."""

    file: str
    """Name of the file, from the folder of the case: .step .iges .brep, or a mesh .msh .unv .med .inp .bdf .vtu."""
    unit: str | None = None
    """Unit of length of a file that has none of its own, all but STEP and IGES: mm, cm, m, um, inch."""
    base: EndTable | None = None
    """The end that is held. Left out, with tip: the faces are listed."""
    tip: EndTable | None = None
    """The end that is moved."""
    y: Vector | None = None
    """Direction of the bar's y axis in the file's frame. Left out: along the bores, else along an axis of the file."""
    tie: Literal["rigid", "half", "distributed"] = "rigid"
    """How an end moves the solid: rigid, the half of a bore that a pull presses, or loads distributed over it."""

    @property
    def rigid_tie(self) -> Literal["rigid", "half"]:
        """How ends are tied where they have to be rigid: for K_g, critical loads, stress and the linkage."""
        return "half" if self.tie == "half" else "rigid"

    @field_validator("unit")
    @classmethod
    def known_unit(cls, value: str | None) -> str | None:
        if value is not None and value not in UNITS:
            raise ValueError(f"unit is {value!r}, allowed are {', '.join(UNITS)}")
        return value

    @field_validator("base", "tip", mode="before")
    @classmethod
    def one_kind(cls, value: Any, info: ValidationInfo) -> Any:
        """The table of the kind that its keys name, so that a mistake is told of that kind alone."""
        if not isinstance(value, dict):
            return value
        kinds: dict[str, type[Part]] = {"plane": PlaneEnd, "cylinder": CylinderEnd, "name": NamedEnd}
        for key, kind in kinds.items():
            if key in value:
                return kind.model_validate(value)
        raise ValueError(
            f"{info.field_name} is a table without plane, cylinder or name, allowed is one of the three"
        )


class FileLinkage(Part):
    """The parallelogram of two such bars."""

    width_mm: Length
    """Distance of the two bars."""
    angles_deg: tuple[Angle, ...] = Field((0.0,), min_length=1)
    """Angles q of the bars that `run` computes, each once."""

    @field_validator("angles_deg")
    @classmethod
    def each_once(cls, value: tuple[float, ...]) -> tuple[float, ...]:
        return LinkageSize.each_once(value)


class FileMesh(Part):
    """Mesh of the bar."""

    size_mm: Length | None = None
    """Size of a cell of the coarser of two nested meshes. Left out: by how thick the part is."""
    tetrahedra: bool = False
    """Whether a prism is meshed with tetrahedra too, and not swept with hexahedra."""
    seconds: Annotated[Number, Field(gt=0.0, le=7200.0)] = 300.0
    """How long reading and meshing may take."""


class FileCase(Part):
    """A bar that comes as a file."""

    schema_version: Annotated[int, Field(alias="schema", strict=True, ge=1, le=1)]
    """Version of this format; it is 1."""
    name: Annotated[str, Field(pattern=r"^[A-Za-z0-9][A-Za-z0-9_-]*$")]
    """Name of the case and of the folder of its result: letters, digits, _ and -."""
    title: str = ""
    """Title of the page; left out, the name."""
    source: str = ""
    """Where the part is from."""
    material: Material | OrthotropicMaterial | None = None
    """Material of all of it."""
    materials: dict[str, Material | OrthotropicMaterial] = Field(default_factory=dict)
    """Materials by region of the file, instead of one."""
    bar: FileBar
    """The file and its ends."""
    linkage: FileLinkage | None = None
    """The parallelogram, where there is one."""
    mesh: FileMesh = FileMesh()
    """How it is meshed."""

    @field_validator("material", mode="before")
    @classmethod
    def one_material(cls, value: Any) -> Any:
        return _material(value)

    @field_validator("materials", mode="before")
    @classmethod
    def each_material(cls, value: Any) -> Any:
        return {k: _material(v) for k, v in value.items()} if isinstance(value, dict) else value

    @model_validator(mode="after")
    def some_material(self) -> FileCase:
        if (self.material is None) == (not self.materials):
            raise ValueError("material or materials is needed: one for all of it, or one for each region")
        return self

    def path(self, folder: Path) -> Path:
        """The file of the bar."""
        return folder / self.bar.file


def _material(value: Any) -> Any:
    """The table of the kind that its keys name."""
    if not isinstance(value, dict):
        return value
    return (OrthotropicMaterial if "E1_MPa" in value else Material).model_validate(value)
