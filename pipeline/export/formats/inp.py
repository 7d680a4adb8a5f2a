"""Input decks: CalculiX in the file that was asked for, Abaqus beside it under the same name with `_abaqus`."""

from __future__ import annotations

from pathlib import Path

from pipeline.export import abaqus, calculix
from pipeline.export.content import UNITS as UNITS
from pipeline.export.content import Export, head, lost_by_springs

ONE = True


def lost(it: Export) -> tuple[str, ...]:
    """What neither of the two decks can hold."""
    turns = "The matrices do not turn with their nodes: a linear analysis alone takes them."
    masses = "Neither of the decks has masses."
    return (*lost_by_springs(it), turns, masses)


def files(it: Export, out: Path) -> dict[Path, bytes]:
    """Two files."""
    lines = head(it, UNITS, lost(it))
    other = out.with_name(f"{out.stem}_abaqus{out.suffix}")
    return {
        out: calculix.deck(it.springs, ("For CalculiX", *lines)).encode(),
        other: abaqus.deck(it.springs, ("For Abaqus", *lines)).encode(),
    }
