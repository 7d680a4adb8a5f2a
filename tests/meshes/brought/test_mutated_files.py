"""Files of every format with mistakes by chance: a bar or a sentence, no crash of this process, no hang."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import gmsh
import numpy as np
import pytest

from fem.factor import SolveError
from meshes.brought import abaqus, nastran
from meshes.brought.formats import readers
from meshes.brought.found import Brought
from meshes.gmsh_session import session
from pipeline.bar.of_file import checked_quality, placed
from pipeline.bar.tables import FileCase
from tests.meshes.brought import parts, written
from tests.meshes.brought.made import box, brought, cad, plane

ENDS = (plane(0, 0, 0), plane(60, 0, 0))
CAD = (".step", ".iges", ".brep")
SAME = {".stp": ".step", ".igs": ".iges", ".nas": ".bdf", ".dat": ".bdf"}
"""Endings that are read as another one is."""
EACH = 25
"""Files of each format in the long test: 225."""
SECONDS = 30.0
CASE = {"schema": 1, "name": "m", "material": {"E_MPa": 7e4, "nu": 0.3}, "bar": {"file": "m"}}


@dataclass(frozen=True)
class Source:
    """A good file and the unit that has to be said of it."""

    path: Path
    unit: str | None


@pytest.fixture(scope="module")
def sources(tmp_path_factory: pytest.TempPathFactory) -> list[Source]:
    """The box in every format."""
    folder = tmp_path_factory.mktemp("good")
    raw = parts.block("hexahedron")
    found = [
        Source(cad(folder / "s.step", box), None),
        Source(cad(folder / "s.iges", box), None),
        Source(cad(folder / "s.brep", box), "mm"),
        Source(written.inp(raw, folder / "s.inp"), "mm"),
        Source(written.bdf(raw, folder / "s.bdf"), "mm"),
        # As text, for of a compressed one nearly every change is seen by VTK itself.
        Source(written.vtu(raw, folder / "s.vtu", text=True), "mm"),
    ]
    with session("made"):
        gmsh.option.setNumber("General.Verbosity", 0)
        box()
        gmsh.model.occ.synchronize()
        gmsh.option.setNumber("Mesh.MeshSizeMax", 8)
        gmsh.model.mesh.generate(3)
        for ending in ("msh", "unv", "med"):
            gmsh.write(str(folder / f"s.{ending}"))
            found.append(Source(folder / f"s.{ending}", "mm"))
    return found


def mutated(text: bytes, generator: np.random.Generator) -> bytes:
    """A file with one byte in the place of another, or with several changed, cut out, doubled, written over, or its end
    lost."""
    data = bytearray(text)
    if generator.random() < 0.5:
        # Of the file's own, so that a number becomes another number.
        there, other = generator.integers(0, len(data), 2)
        data[there] = data[other]
        return bytes(data)
    for _ in range(int(generator.integers(1, 6))):
        at = int(generator.integers(0, max(len(data), 1)))
        size = int(generator.integers(1, 200))
        what = int(generator.integers(0, 5))
        if what == 0 and data:
            data[at % len(data)] = int(generator.integers(0, 256))
        elif what == 1:
            del data[at : at + size]
        elif what == 2:
            data[at:at] = data[at : at + size]
        elif what == 3:
            data = data[: max(at, 1)]
        else:
            data[at : at + 1] = str(10.0 ** generator.integers(-300, 300)).encode()
    return bytes(data)


def outcome(source: Source, content: bytes, folder: Path) -> str:
    """ "bar" with a finite K_b, or the sentence; every other exception goes through."""
    path = folder / f"m{source.path.suffix}"
    path.write_bytes(content)
    size = 8.0 if path.suffix in CAD else None
    try:
        return solved(brought(path, *ENDS, unit=source.unit, size=size, seconds=SECONDS))
    except (ValueError, SolveError, RuntimeError) as error:
        said = str(error)
        # No exception of Python's own has reached the reader: one of its sentences, or how another library ended it.
        assert said and "Traceback" not in said and "Error:" not in said, said
        return said


def solved(it: Brought) -> str:
    """What `bar` does with a file that could be read: its frame, the quality of its cells, K_b of the coarse mesh."""
    part = placed(FileCase.model_validate(CASE), it)
    checked_quality(part)
    for tie in part.bars[0].ties:
        assert np.isfinite(part.bars[0].stiffness(tie)).all()
    return "bar"


def tried(sources: list[Source], folder: Path, each: int, seed: int) -> Iterator[tuple[str, str]]:
    """Ending and outcome of `each` mutated files of every format."""
    generator = np.random.default_rng(seed)
    for source in sources:
        content = source.path.read_bytes()
        for _ in range(each):
            yield source.path.suffix, outcome(source, mutated(content, generator), folder)


def test_every_format_is_tried(sources: list[Source], tmp_path: Path) -> None:
    """A reader of a new format comes in here, or this fails; the files are good as they are."""
    assert {it.path.suffix for it in sources} == {SAME.get(ending, ending) for ending in readers()}
    good = [it for it in sources if it.path.suffix not in CAD]
    assert [outcome(it, it.path.read_bytes(), tmp_path) for it in good] == ["bar"] * 6


def test_a_few_mutated_files_of_every_format_are_a_bar_or_a_sentence(
    sources: list[Source], tmp_path: Path
) -> None:
    """A look at what the long test does."""
    found = Counter(ending for ending, _ in tried(sources, tmp_path, 1, seed=5))
    assert len(found) == 9 and set(found.values()) == {1}


@pytest.mark.parametrize(("work", "write"), [(abaqus.work, written.inp), (nastran.work, written.bdf)])
def test_mutated_text_is_a_mesh_or_a_sentence(
    work: Callable[[dict[str, Any]], Any], write: Callable[..., Path], tmp_path: Path
) -> None:
    """What this project reads itself raises no other exception."""
    path = write(parts.block("hexahedron"), tmp_path / "m")
    good, generator, meshes = path.read_bytes(), np.random.default_rng(41), 0
    for _ in range(150):
        path.write_bytes(mutated(good, generator))
        try:
            work({"path": str(path), "unit": "mm", "size": None, "base": ENDS[0], "tip": ENDS[1]})
            meshes += 1
        except ValueError as error:
            assert str(error)
    assert 10 < meshes < 140


@pytest.mark.long
def test_two_hundred_mutated_files_are_a_bar_or_a_sentence(sources: list[Source], tmp_path: Path) -> None:
    found = list(tried(sources, tmp_path, EACH, seed=40))
    assert Counter(ending for ending, _ in found) == dict.fromkeys({e for e, _ in found}, EACH)
    assert len(found) == 9 * EACH >= 200
    bars = sum(said == "bar" for _, said in found)
    assert bars > 20 and len(found) - bars > 50
