"""A process of its own that does one task after the other, so that the page stays alive and a task can be stopped."""

from __future__ import annotations

from dataclasses import dataclass
from multiprocessing import get_context
from multiprocessing.connection import Connection
from multiprocessing.process import BaseProcess
from weakref import finalize

from pipeline.errors import InputError
from pipeline.memory import keep_freed
from pipeline.processors import may_use, used
from pipeline.studio.work import Done, Task, do

FAILED = "the numerics failed: "


@dataclass(frozen=True)
class Said:
    """What a task is at."""

    text: str


@dataclass(frozen=True)
class Refused:
    """Why a task could not be done, in the words of the command line."""

    text: str


Event = Said | Refused | Done


class Worker:
    """Starts at once; a task that is cancelled ends with its process, and a new one takes its place."""

    def __init__(self) -> None:
        self._start()

    def submit(self, task: Task) -> None:
        """Begin a task; one at a time."""
        if not self._process.is_alive():
            self._start()
        self._ours.send(task)

    def poll(self) -> Event | None:
        """What has happened since, oldest first; None for nothing."""
        try:
            if self._ours.poll():
                event: Event = self._ours.recv()
                return event
        except (EOFError, OSError):
            self._start()
            return Refused("the process that computes has ended; nothing of the campaign was changed")
        return None

    def cancel(self) -> None:
        """Stop what is being done."""
        self.close()
        self._start()

    def close(self) -> None:
        """End the process."""
        self._end()
        self._ours.close()

    def _start(self) -> None:
        context = get_context("spawn")
        self._ours, theirs = context.Pipe()
        # No daemon: one may have no processes beside it, and a diagnosis uses all processors. So it is ended here.
        self._process: BaseProcess = context.Process(target=serve, args=(theirs, used()), daemon=False)
        self._process.start()
        self._end = finalize(self, _ended, self._process)
        theirs.close()


def _ended(process: BaseProcess) -> None:
    process.terminate()
    process.join(5.0)
    if process.is_alive():
        process.kill()


def serve(pipe: Connection, processors: int) -> None:
    """Do tasks until the other side is gone, on so many processors."""
    keep_freed()
    may_use(processors)
    try:
        while True:
            task = pipe.recv()
            pipe.send(_done(task, pipe))
    except (EOFError, BrokenPipeError, KeyboardInterrupt):
        return


def _done(task: Task, pipe: Connection) -> Event:
    try:
        return do(task, lambda text: pipe.send(Said(text)))
    except InputError as error:
        return Refused(str(error))
    except BrokenPipeError:
        raise
    except (RuntimeError, ArithmeticError, ValueError, OSError, MemoryError) as error:
        return Refused(f"{FAILED}{error or type(error).__name__}")
