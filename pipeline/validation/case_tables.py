"""The tables of a validation case: their keys, and the values that each of them allows."""

from math import isfinite
from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict, Field, ValidationInfo, field_validator, model_validator

Number = Annotated[float, Field(strict=True, allow_inf_nan=False)]
Length = Annotated[Number, Field(gt=0.0)]
Angle = Annotated[Number, Field(ge=-60.0, le=60.0)]
Matrix = tuple[tuple[Number, ...], ...]


class Part(BaseModel):
    """A table of the case file; unknown keys are refused."""

    model_config = ConfigDict(extra="forbid", frozen=True)


class Material(Part):
    """Isotropic material; without a yield stress no load is marked as beyond it."""

    E_MPa: Annotated[Number, Field(gt=0.0)]
    """Young's modulus."""
    nu: Annotated[Number, Field(gt=-1.0, lt=0.5)]
    """Poisson's ratio."""
    yield_MPa: Annotated[Number, Field(gt=0.0)] | None = None
    """Yield stress; loads beyond it are marked."""
    source: str = ""
    """Where these values are from."""

    @field_validator("yield_MPa")
    @classmethod
    def in_the_same_unit(cls, value: float | None, info: ValidationInfo) -> float | None:
        modulus = info.data.get("E_MPa")
        if value is not None and modulus is not None and value >= modulus:
            raise ValueError(
                f"{value:g} was found, allowed is less than E_MPa = {modulus:g}; both are in MPa"
            )
        return value


class LinkageSize(Part):
    """Length between the pins, distance of the bars, and the angles to look at."""

    length_mm: Length
    """Length of a bar between its pins."""
    width_mm: Length
    """Distance of the two bars."""
    angles_deg: tuple[Angle, ...] = (0.0,)
    """Angles q of the bars that are computed, each once."""

    @field_validator("angles_deg")
    @classmethod
    def each_once(cls, value: tuple[float, ...]) -> tuple[float, ...]:
        if not value or len(set(value)) != len(value):
            raise ValueError("allowed is a list of one or more angles, each once")
        return value


class ISectionSize(Part):
    """I-section: flanges along y, height along z."""

    kind: Literal["i_section"]
    """Flanges along y, height along z."""
    flange_width_mm: Length
    """Width of a flange, along y."""
    flange_thickness_mm: Length
    """Thickness of a flange, along z."""
    height_mm: Length
    """Height of the whole section, along z."""
    web_mm: Length
    """Thickness of the web, along y."""


class RectangleSize(Part):
    """Solid rectangle: width along y, height along z."""

    kind: Literal["rectangle"]
    """A solid rectangle."""
    width_mm: Length
    """Width, along y."""
    height_mm: Length
    """Height, along z."""


class RoundSize(Part):
    """Solid round."""

    kind: Literal["round"]
    """A solid round."""
    diameter_mm: Length
    """Diameter."""


class TubeSize(Part):
    """Round tube."""

    kind: Literal["tube"]
    """A round tube."""
    outer_diameter_mm: Length
    """Outer diameter."""
    wall_mm: Length
    """Thickness of the wall."""


class LugSize(Part):
    """Block in place of the section at both ends."""

    length_mm: Length
    """Length of the block at each end, along x."""
    width_mm: Length
    """Its width, along y."""
    height_mm: Length
    """Its height, along z."""


SectionSize = Annotated[ISectionSize | RectangleSize | RoundSize | TubeSize, Field(discriminator="kind")]


class BarChoice(Part):
    """Either dimensions, or the family of which the one that meets the paper's matrix is to be found."""

    section: SectionSize | None = None
    """Section between the ends."""
    lug: LugSize | None = None
    """Block at both ends in place of the section."""
    family: Literal["i_section"] | None = None
    """Instead of a section: the kind of section whose dimensions are to be found."""
    lug_length_mm: Length | None = None
    """Length of the lugs of a family."""
    meets: Literal["paper"] | None = None
    """What a family has to meet: the bar_stiffness of [paper]."""

    @model_validator(mode="after")
    def one_way(self) -> "BarChoice":
        if (self.section is None) == (self.family is None):
            raise ValueError("allowed is one of the two: section (dimensions), or family with meets")
        if self.family is not None and (
            self.meets is None or self.lug_length_mm is None or self.lug is not None
        ):
            raise ValueError(
                'a family needs meets = "paper" and lug_length_mm, and takes no lug: its size is found'
            )
        if self.family is None and (self.meets is not None or self.lug_length_mm is not None):
            raise ValueError("meets and lug_length_mm belong to a family, not to a section")
        return self


class Paper(Part):
    """Published matrices to stand beside the computed ones."""

    source: str
    """Where the matrices were published."""
    bar_stiffness: Matrix
    """6x6 of one bar at its tip, base clamped; N, mm, rad."""
    half_linkage_stiffness: Matrix | None = None
    """Half of the 6x6 of the parallelogram, bar frame; N, mm, rad."""
    linkage_angle_deg: Number | None = None
    """Angle q at which it was published."""

    @field_validator("bar_stiffness", "half_linkage_stiffness")
    @classmethod
    def six_by_six(cls, value: Matrix | None) -> Matrix | None:
        if value is None:
            return None
        if len(value) != 6 or any(len(row) != 6 for row in value):
            raise ValueError("allowed is a matrix of 6 rows with 6 numbers")
        if not all(isfinite(x) for row in value for x in row):
            raise ValueError("allowed are finite numbers")
        if any(value[i][j] != value[j][i] for i in range(6) for j in range(i)):
            raise ValueError("allowed is a symmetric matrix")
        return value


class MeshSize(Part):
    """Coarse element size; the levels of detail refine it."""

    size_mm: Length = 8.0
    """Size of an element of the coarse mesh; the levels of detail refine it."""


class Case(Part):
    """Everything a validation run needs to know."""

    schema_version: Annotated[int, Field(alias="schema", strict=True, ge=1, le=1)]
    """Version of this format; it is 1."""
    name: Annotated[str, Field(pattern=r"^[A-Za-z0-9][A-Za-z0-9_-]*$")]
    """Name of the case and of the folder of its result: letters, digits, _ and -."""
    title: str
    """Title of the report."""
    source: str = ""
    """Where the dimensions are from."""
    material: Material
    """Material of the bars."""
    linkage: LinkageSize
    """The parallelogram."""
    bar: BarChoice
    """One bar."""
    paper: Paper | None = None
    """Published matrices that are shown beside the computed ones."""
    mesh: MeshSize = MeshSize()
    """Mesh of the bar."""

    @model_validator(mode="after")
    def matrix_to_meet(self) -> "Case":
        if self.bar.meets == "paper" and self.paper is None:
            raise ValueError("bar.meets is 'paper', but there is no [paper] table with bar_stiffness")
        return self
