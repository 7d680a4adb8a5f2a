"""The page of a run of a brought bar: reads result.json and the shapes beside it, solves nothing."""

from dataclasses import replace
from pathlib import Path
from typing import Any

from reports import (
    agreement,
    bar_page,
    linkage_drawing,
    linkage_shapes,
    sections,
    tables_linkage,
    tables_record,
)
from reports.blocks import Block, Bullets, Code, Details, Section, Tables, Text
from reports.load import Json
from reports.record_page import drawn
from reports.sections import Drawing

RESULT = "result.json"
OF_RESULT = "Every number is from result.json beside this page."


def draw(folder: Path) -> Path:
    """Write index.html beside result.json; ReportError if that is missing or not laid out as such a result."""
    return drawn(Path(folder) / RESULT, "the result of a brought bar", built)


def built(folder: Path, result: Json) -> list[Section]:
    """All of the page: what was found, the bar, the linkage, how it was made."""
    bar = result["bar"]
    drawings: dict[str, Drawing] = {"linkage": linkage_drawing.draw(result)}
    if result["agreement"]:
        drawings["agreement"] = ("", agreement.draw(result))
    bent = linkage_shapes.read(folder, result)
    turned: Any = None
    if bent:
        drawings["stress"], turned = ("", linkage_shapes.picture(bent)), linkage_shapes.figure(bent)
    parts = [
        *sections.warnings(result),
        findings(result, drawings),
        *bar_page.sections(folder, bar)[:-1],
        sections.linkage(result, drawings),
        sections.parallelogram(result),
        critical(result, drawings, turned),
        *curves(result, drawings),
        reading(result),
    ]
    return [sections.without_paper(part) for part in parts]


def findings(result: Json, drawings: dict[str, Drawing]) -> Section:
    """What is to be seen without scrolling."""
    blocks: list[Block] = [Bullets(result["story"][: sections.FIRST])]
    if "agreement" in drawings:
        blocks.append(sections.drawn("agreement", sections.AGREEMENT, drawings))
    if more := result["story"][sections.FIRST :]:
        blocks.append(Details("All findings", [Bullets(more)]))
    return Section("findings", "Findings", blocks)


def critical(result: Json, drawings: dict[str, Drawing], turned: Any) -> Section:
    """Critical loads of the linkage; what could not be had for this bar first."""
    found = sections.critical(result, drawings, turned)
    if not result["left_out"]:
        return found
    return replace(found, blocks=[Bullets(result["left_out"]), *found.blocks])


def curves(result: Json, drawings: dict[str, Drawing]) -> list[Section]:
    """Force and deflection; nothing where there are no paths."""
    if not result["curves"]:
        return []
    found = sections.force_deflection(result, drawings)
    if not result["refinement"]:
        return [found]
    more = Details("Refinement of the paths", [tables_linkage.refinement(result)])
    return [replace(found, blocks=[*found.blocks, more])]


def reading(result: Json) -> Section:
    """How to read the page, and how to make it again."""
    bar = result["bar"]
    versions = {**result["versions"], "commit": result["commit"]}
    return Section(
        "reading",
        "How to read this page",
        [
            Bullets([*bar_page.READING[:-1], *sections.READING[1:-1], OF_RESULT]),
            Text("Sources:"),
            Bullets(result["sources"]),
            Tables(
                [
                    tables_record.seconds(result),
                    tables_record.pairs("Versions", "package", "version", versions),
                ]
            ),
            tables_record.pairs("Files it was made from", "file", "sha256", bar["data"]),
            Text("To make it again:"),
            Code(str(result["command"])),
        ],
    )
