"""All pictures of a sweep, written beside it."""

from pathlib import Path

from reports.files import write_bytes
from reports.workspace import isosurface, slices
from reports.workspace.read import AT_REST, Workspace, read


def draw(folder: Path) -> list[Path]:
    """Write slices.png and isosurface_<quantity>.png into the folder of a finished sweep; returns what was written.

    ReportError for a folder without one, and where nothing can be drawn off screen.
    """
    space = read(folder)
    pictures = {"slices.png": slices.draw(space)}
    for name in surfaces(space):
        pictures[f"isosurface_{name}.png"] = isosurface.draw(space, name)
    return [write_bytes(folder / name, content) for name, content in pictures.items() if content]


def surfaces(space: Workspace) -> list[str]:
    """What has an isosurface: lowest K_tran, and the first quantity of what else was asked."""
    others = [name for name in space.quantities if name not in AT_REST]
    errors = [name for name in others if name.endswith("_error")]
    return [AT_REST[0], *(errors[-1:] or others[:1])]
