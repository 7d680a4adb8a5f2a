"""The report of a validation run: reads a result folder, solves nothing."""

from pathlib import Path

from reports import (
    agreement,
    bar_drawing,
    charts,
    linkage_drawing,
    linkage_shapes,
    markdown,
    page,
    shapes,
    turntable,
)
from reports.errors import ReportError
from reports.files import write_bytes
from reports.load import Json, load
from reports.sections import Drawing, build

__all__ = ["ReportError", "draw"]


def draw(folder: Path) -> list[Path]:
    """Write index.html, report.md and pictures/*.png beside result.json; returns the files written.

    The shapes of the buckling modes come from modes/<supports>.vtu; where such a file is missing, an existing
    picture of its modes is kept. Raises ReportError if result.json is missing, is not JSON or lacks a key.
    """
    folder = Path(folder)
    result = load(folder)
    try:
        return write(folder, result)
    except (KeyError, IndexError, TypeError, ValueError, AttributeError) as error:
        found = f"{type(error).__name__}: {error}"
        raise ReportError(f"{folder / 'result.json'} is not laid out as a result: {found}") from error


def write(folder: Path, result: Json) -> list[Path]:
    """Read everything first, then draw, then write: what cannot be drawn is said before time is spent."""
    found = [s for name in shapes.supports_of(result) if (s := shapes.read(folder, result, name)) is not None]
    linkages = linkage_shapes.read(folder, result)
    if found or linkages:
        shapes.require_egl()
    drawings: dict[str, Drawing] = {
        "linkage": linkage_drawing.draw(result),
        "bar": bar_drawing.draw(result),
        "convergence": ("", charts.convergence(result)),
        "force_deflection": ("", charts.force_deflection(result)),
    }
    if result.get("agreement"):
        drawings["agreement"] = ("", agreement.draw(result))
    drawings |= {f"modes_{item.supports}": ("", shapes.picture(item)) for item in found}
    if linkages:
        drawings["stress"] = ("", linkage_shapes.picture(linkages))
    fresh = list(drawings)
    drawings |= kept(folder, result, fresh)
    turned = (turntable.figure(found), {item.supports for item in found}) if found else None
    sections = build(result, drawings, turned, linkage_shapes.figure(linkages) if linkages else None)
    pictures = folder / "pictures"
    written = [write_bytes(pictures / f"{name}.png", drawings[name][1]) for name in fresh]
    html, text = page.render(result["title"], sections), markdown.render(result["title"], sections)
    written.append(write_bytes(folder / "report.md", text.encode()))
    written.append(write_bytes(folder / "index.html", html.encode()))
    return written


def kept(folder: Path, result: Json, fresh: list[str]) -> dict[str, Drawing]:
    """Pictures of modes from an earlier drawing whose shapes are no longer stored."""
    names = [f"modes_{supports}" for supports in shapes.supports_of(result)]
    paths = {name: folder / "pictures" / f"{name}.png" for name in names if name not in fresh}
    return {name: ("", path.read_bytes()) for name, path in paths.items() if path.is_file()}
