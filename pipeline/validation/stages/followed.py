"""The solid's load paths, each in a process of its own: none needs another."""

from collections.abc import Sequence
from functools import partial
from os import cpu_count
from pathlib import Path
from typing import Any

from fem.material import Isotropic
from meshes.bar import Bar
from pipeline.pools import pool
from pipeline.progress import Progress, Stage
from pipeline.validation.case import Case
from pipeline.validation.detail import Detail
from pipeline.validation.result import Refinement
from pipeline.validation.stages.linkage import HELD_SETS, SolidPath, solid_path
from pipeline.validation.stages.refinement import solid_end, solid_steps
from pipeline.validation.stages.specimen import Specimen
from pipeline.validation.stages.subject import Sized, SolidBar
from pipeline.validation.workshop import Workshop

MOST = 6
"""More processes than paths would wait."""

Parts = tuple[Bar, Isotropic, float, Detail, Path]


def solid_paths(case: Case, s: Specimen, stage: Stage) -> list[SolidPath]:
    """Every path that the detail asks for, in the order of angles and ways of holding."""
    s.mesh(s.detail.path)
    return _each(stage, _path, [(case, _parts(s), *pair) for pair in _pairs(case, s.detail)])


def each_path(case: Sized, s: SolidBar, stage: Stage) -> list[SolidPath]:
    """The same of a bar that goes to another process as it is."""
    return _each(stage, solid_path, [(case, s, *pair) for pair in _pairs(case, s.detail)])


def _pairs(case: Sized, detail: Detail) -> list[tuple[float, tuple[str, ...]]]:
    """Angles and ways of holding that the detail asks for."""
    angles = case.linkage.angles_deg[: detail.path_angles]
    return [(q, held) for q in angles for held in HELD_SETS[: detail.path_sets]]


def solid_study(case: Case, s: Specimen, stage: Stage) -> Refinement:
    """The solid's load past the critical one in more and more steps; RuntimeError if one does not arrive."""
    ends = _each(stage, _end, [(case, _parts(s), steps) for steps in s.detail.steps])
    return solid_steps(case, s.detail.steps, ends)


def _each(stage: Stage, call: Any, arguments: Sequence[tuple[Any, ...]]) -> list[Any]:
    calls = (partial(_numbered, k, call, each) for k, each in enumerate(arguments))
    found: dict[int, Any] = {}
    with pool(min(cpu_count() or 1, len(arguments), MOST)) as computed:
        for number, result in computed(calls):
            found[number] = result
            stage.say(f"{len(found)} of {len(arguments)}")
    return [found[k] for k in range(len(arguments))]


def _numbered(number: int, call: Any, arguments: tuple[Any, ...]) -> tuple[int, Any]:
    return number, call(*arguments)


def _parts(s: Specimen) -> Parts:
    """What goes to another process: without a terminal and without what is worked out on the way."""
    return s.bar, s.material, s.size, s.detail, s.workshop.folder


def _whole(parts: Parts) -> Specimen:
    return Specimen(*parts[:4], Workshop(parts[4], Progress(quiet=True)))


def _path(case: Case, parts: Parts, q: float, held: tuple[str, ...]) -> SolidPath:
    return solid_path(case, _whole(parts), q, held)


def _end(case: Case, parts: Parts, steps: int) -> float:
    return solid_end(case, _whole(parts), steps)
