"""From the numbers of a case file to the bar as geometry."""

from collections.abc import Sequence
from dataclasses import asdict
from math import cos, radians

from meshes.bar import Bar, Lug
from meshes.section import ISection, Rectangle, Round, Section, Tube
from pipeline.errors import InputError
from pipeline.validation.case_tables import BarChoice, ISectionSize, RectangleSize, RoundSize, TubeSize

KINDS = {ISection: "i_section", Rectangle: "rectangle", Round: "round", Tube: "tube"}


SectionChoice = ISectionSize | RectangleSize | RoundSize | TubeSize


def section_of(size: SectionChoice) -> Section:
    """The section that a case describes; ValueError if its dimensions contradict each other."""
    match size:
        case ISectionSize():
            return ISection(size.flange_width_mm, size.flange_thickness_mm, size.height_mm, size.web_mm)
        case RectangleSize():
            return Rectangle(size.width_mm, size.height_mm)
        case RoundSize():
            return Round(size.diameter_mm)
        case TubeSize():
            return Tube(size.outer_diameter_mm, size.wall_mm)


def height_of(choice: BarChoice) -> float:
    """Extent along z of the bar of a case that gives its dimensions, lugs included, mm."""
    match choice.section:
        case ISectionSize() | RectangleSize():
            body = choice.section.height_mm
        case RoundSize():
            body = choice.section.diameter_mm
        case TubeSize():
            body = choice.section.outer_diameter_mm
        case None:
            body = 0.0
    return max(body, 0.0 if choice.lug is None else choice.lug.height_mm)


def overlapping(width: float, angles: Sequence[float], height: float) -> str:
    """What is wrong where two bars of this height (mm), `width` mm apart, overlap at one of the angles (deg), or "".

    Bars turned by q are width cos q apart.
    """
    steepest = max(angles, key=abs)
    apart = width * cos(radians(steepest))
    if width <= height:
        return f"linkage.width_mm is {width:g}, allowed is above the bars' height, {height:g} mm"
    if apart <= height:
        return (
            f"linkage.width_mm is {width:g}: at {steepest:g} degrees the middles of the bars are {apart:.4g} mm apart, "
            f"allowed is above their height, {height:g} mm"
        )
    return ""


def bar_of(choice: BarChoice, length: float) -> Bar:
    """The bar of a case that gives its dimensions; InputError if they contradict each other."""
    assert choice.section is not None
    try:
        return Bar(section_of(choice.section), length, lug_of(choice))
    except ValueError as error:
        raise InputError(f"bar: {error}") from error


def lug_of(choice: BarChoice) -> Lug | None:
    """The lug of a case, if it has one."""
    size = choice.lug
    return None if size is None else Lug(size.length_mm, size.width_mm, size.height_mm)


def contradictions(choice: BarChoice, length: float) -> list[tuple[str, str]]:
    """What does not go together in a bar of `length` mm that gives its dimensions: key of the bar and sentence."""
    assert choice.section is not None
    found: list[tuple[str, str]] = []
    section: Section = Rectangle(length, length)
    try:
        section = section_of(choice.section)
    except ValueError as error:
        found.append(("section", f"bar: {error}"))
    try:
        Bar(section, length, lug_of(choice))
    except ValueError as error:
        found.append(("lug", f"bar: {error}"))
    return found


def described(section: Section) -> dict[str, float | str]:
    """A section as the numbers of a result file."""
    return {"kind": KINDS[type(section)], **{f"{k}_mm": float(v) for k, v in asdict(section).items()}}  # type: ignore[call-overload]
