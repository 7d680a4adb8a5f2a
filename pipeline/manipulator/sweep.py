"""Sweep over a grid of platform points: in chunks, by any pool, interrupted and resumed without a trace.

Every chunk is one file, written whole or not at all. What is there is not computed again; when all are there they are
joined to `sweep.npy`, (points, columns) in the order of the grid. Only the chunks under way are in memory.
"""

import hashlib
import json
import os
from collections.abc import Callable
from dataclasses import asdict, dataclass
from functools import partial
from pathlib import Path

import numpy as np

from pipeline.errors import InputError
from pipeline.manipulator.description import Description
from pipeline.manipulator.grid import Grid
from pipeline.manipulator.mapping import CriticalMap, chunk_of, coarse, critical_map, nodes_of
from pipeline.manipulator.question import Array, Question
from pipeline.manipulator.reasons import reasons_of
from pipeline.pools import Pool, one_after_another

CHUNK = 2000
"""Points of a chunk: about 20 MB of work space."""
HEAD, RESULT, CHUNKS, CRITICAL = "sweep.json", "sweep.npy", "chunks", "critical.npy"
_NODES = 5


@dataclass(frozen=True, eq=False)
class Sweep:
    """A finished sweep: its folder, grid and columns, how many chunks were computed now and how many there, how many
    postures were computed now, and the sentences that its column `reason` has the numbers of."""

    folder: Path
    grid: Grid
    columns: tuple[str, ...]
    computed: int
    found: int
    postures: int
    reasons: tuple[str, ...]

    @property
    def values(self) -> Array:
        """(points, columns), mapped from the file."""
        return np.asarray(np.load(self.folder / RESULT, mmap_mode="r"))


def sweep(
    description: Description,
    grid: Grid,
    folder: Path,
    pool: Pool = one_after_another,
    chunk: int = CHUNK,
    progress: Callable[[int, int], None] = lambda done, all: None,
    question: Question | None = None,
) -> Sweep:
    """Sweep into a folder, or go on with what is there; progress is told the finished chunks and all of them.

    question: what is asked beside the stiffness at rest. InputError
    for a folder that holds another sweep.
    """
    asked = question or Question()
    folder.mkdir(parents=True, exist_ok=True)
    _claim(folder, description, grid, chunk, asked)
    total = -(-grid.size // chunk)
    if not (folder / RESULT).exists():
        (folder / CHUNKS).mkdir(exist_ok=True)
    missing = [] if (folder / RESULT).exists() else [k for k in range(total) if not _file(folder, k).exists()]
    progress(total - len(missing), total)
    if missing:
        critical = _critical(description, grid, folder, pool)
        todo = ((k, k * chunk, min((k + 1) * chunk, grid.size)) for k in missing)
        calls = (partial(chunk_of, description.manipulator, asked, critical, grid, *one) for one in todo)
        for done, (number, values) in enumerate(pool(calls), start=1):
            _write(_file(folder, number), values)
            progress(total - len(missing) + done, total)
    _join(folder, grid, total, len(asked.columns))
    postures = sum(min(chunk, grid.size - k * chunk) for k in missing)
    reasons = reasons_of(description.manipulator)
    return Sweep(folder, grid, asked.columns, len(missing), total - len(missing), postures, reasons)


def _claim(folder: Path, description: Description, grid: Grid, chunk: int, question: Question) -> None:
    """Writes what the folder is for, or checks that it is for this."""
    head = {
        "manipulator": description.manipulator.name,
        "digest": hashlib.sha256(description.text.encode()).hexdigest(),
        "grid": asdict(grid),
        "chunk": chunk,
        "columns": question.columns,
        "reasons": reasons_of(description.manipulator),
        **question.said,
    }
    text = json.dumps(head, indent=1) + "\n"
    file = folder / HEAD
    if not file.exists():
        _replace(file, text.encode())
    elif file.read_text(encoding="utf-8") != text:
        raise InputError(
            f"{file}: is of another sweep (manipulator, grid, chunk, wrench or effect), allowed is a folder of its own"
        )


def _critical(description: Description, grid: Grid, folder: Path, pool: Pool) -> CriticalMap:
    """The legs' critical forces on coarse nodes, with why there is none, kept beside the chunks."""
    nodes, file = coarse(grid), folder / CRITICAL
    if not file.exists():
        calls = (
            partial(nodes_of, description.manipulator, nodes, k, min(k + _NODES, nodes.size))
            for k in range(0, nodes.size, _NODES)
        )
        found = np.zeros((nodes.size, len(description.manipulator.legs), 2))
        for start, part in pool(calls):
            found[start : start + len(part)] = part
        _write(file, found)
    force, reason = np.moveaxis(np.load(file), -1, 0)
    return critical_map(description.manipulator, nodes, force, reason)


def _file(folder: Path, number: int) -> Path:
    return folder / CHUNKS / f"{number:07d}.npy"


def _write(file: Path, values: Array) -> None:
    part = file.with_suffix(f".{os.getpid()}.part")
    with part.open("wb") as out:
        np.save(out, values)
    os.replace(part, file)


def _replace(file: Path, content: bytes) -> None:
    part = file.with_suffix(f".{os.getpid()}.part")
    part.write_bytes(content)
    os.replace(part, file)


def _join(folder: Path, grid: Grid, total: int, columns: int) -> None:
    """One file from all chunks, which are then removed."""
    file = folder / RESULT
    if not file.exists():
        part = file.with_suffix(f".{os.getpid()}.part")
        head = {"descr": "<f8", "fortran_order": False, "shape": (grid.size, columns)}
        with part.open("wb") as out:
            np.lib.format.write_array_header_1_0(out, head)
            for number in range(total):
                out.write(np.load(_file(folder, number)).astype("<f8").tobytes())
        os.replace(part, file)
    for rest in (folder / CHUNKS).glob("*"):
        rest.unlink()
    if (folder / CHUNKS).exists():
        (folder / CHUNKS).rmdir()
