"""From the numbers of a case file to the bar as geometry."""

from dataclasses import asdict

from meshes.bar import Bar, Lug
from meshes.section import ISection, Rectangle, Round, Section, Tube
from pipeline.errors import InputError
from pipeline.validation.case import BarChoice, ISectionSize, RectangleSize, RoundSize, TubeSize

KINDS = {ISection: "i_section", Rectangle: "rectangle", Round: "round", Tube: "tube"}


def section_of(size: ISectionSize | RectangleSize | RoundSize | TubeSize) -> Section:
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


def bar_of(choice: BarChoice, length: float) -> Bar:
    """The bar of a case that gives its dimensions; InputError if they contradict each other."""
    assert choice.section is not None
    try:
        lug = None
        if choice.lug is not None:
            lug = Lug(choice.lug.length_mm, choice.lug.width_mm, choice.lug.height_mm)
        return Bar(section_of(choice.section), length, lug)
    except ValueError as error:
        raise InputError(f"bar: {error}") from error


def described(section: Section) -> dict[str, float | str]:
    """A section as the numbers of a result file."""
    return {"kind": KINDS[type(section)], **{f"{k}_mm": float(v) for k, v in asdict(section).items()}}  # type: ignore[call-overload]
