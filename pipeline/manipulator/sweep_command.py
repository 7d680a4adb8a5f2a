"""The command sweep: a manipulator and a grid in; a folder with the map out, gone on with if it was interrupted."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from time import perf_counter

from pipeline.command import usable
from pipeline.errors import InputError
from pipeline.manipulator.box import box
from pipeline.manipulator.description import read
from pipeline.manipulator.question_options import question_of
from pipeline.manipulator.sweep import CHUNK, HEAD, RESULT, Sweep, sweep
from pipeline.manipulator.sweep_summary import summary
from pipeline.pools import pool
from pipeline.progress import Progress, Stage


@dataclass(frozen=True)
class Asked:
    """What was typed: corners and points as in `pipeline.manipulator.box`, workers and dask as in `pool`, effects,
    wrench and rise as in `pipeline.manipulator.question_options`."""

    file: str
    out: Path
    low: str | None = None
    high: str | None = None
    points: str = "21"
    workers: int = 1
    dask: str | None = None
    chunk: int = CHUNK
    quiet: bool = False
    effects: Sequence[str] = ()
    effects_from: Sequence[Path] = ()
    wrench: str | None = None
    rise: float | None = None
    pictures: bool = True


def run_sweep(asked: Asked) -> Sweep:
    """Sweep, or go on with what is in the folder, and print what was found. InputError for bad input."""
    description = read(asked.file)
    grid = box(description.manipulator, description.home, asked.low, asked.high, asked.points)
    question = question_of(
        description.manipulator, asked.effects, asked.wrench, asked.rise, asked.effects_from
    )
    _free(asked.out)
    if asked.chunk < 1:
        raise InputError(f"--chunk is {asked.chunk}, allowed are 1 or more points")
    progress = Progress(asked.quiet)
    start = perf_counter()
    with progress.stage("sweep") as stage, pool(asked.workers, asked.dask) as computed:
        teller = _Teller(stage, grid.size, asked.chunk)
        done = sweep(description, grid, asked.out, computed, asked.chunk, teller.tell, question)
        stage.note = f"{done.computed} chunks computed, {done.found} found"
    print("\n".join(summary(done, perf_counter() - start)))
    if asked.pictures:
        with progress.stage("pictures"):
            pictures(done)
    return done


def pictures(done: Sweep) -> None:
    """Draw the finished sweep, or say why not: its numbers are there all the same."""
    from reports.errors import ReportError
    from reports.workspace.draw import draw

    try:
        drawn = draw(done.folder)
    except ReportError as error:
        print(f"no pictures: {error}")
        return
    if drawn:
        print("pictures: " + ", ".join(str(path) for path in drawn))


def _free(out: Path) -> None:
    """InputError for a folder that cannot be written, or holds something else."""
    usable(out, f"--out {out}")
    if out.is_dir() and any(out.iterdir()) and not ((out / HEAD).exists() or (out / RESULT).exists()):
        raise InputError(
            f"--out {out} holds other files, allowed is an empty folder, a new one or that of a sweep"
        )


@dataclass
class _Teller:
    """Says how far a sweep is, and when it will be done."""

    stage: Stage
    points: int
    chunk: int
    began: float | None = None
    first: int = 0

    def tell(self, done: int, all: int) -> None:
        now = perf_counter()
        if self.began is None:
            self.began, self.first = now, done
            self.stage.say(f"{done} of {all} chunks are there, legs that buckle first")
            return
        rate = (done - self.first) / max(now - self.began, 1e-9)
        left = f", {(all - done) / rate:.0f} s left" if rate > 0.0 else ""
        reached = min(done * self.chunk, self.points)
        self.stage.say(f"{reached} of {self.points} postures{left}")
