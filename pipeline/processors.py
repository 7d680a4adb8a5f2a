"""Independent calls at once, on the processors of this machine.

Forks of the process take the calls one after the other beside it: they find everything where it is, and only what is
returned is sent back. A process computes alone unless it was said that it `may_use` more, as one of many workers must
not; and where there is no fork, or no safe one.
"""

from __future__ import annotations

import ctypes
import os
import signal
import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from multiprocessing import get_context
from multiprocessing.connection import Connection
from multiprocessing.context import ForkProcess
from multiprocessing.reduction import ForkingPickler
from multiprocessing.sharedctypes import Synchronized
from pickle import PicklingError
from typing import Any, TypeVar

from vjm import work

Out = TypeVar("Out")
Found = dict[int, Any]
_DEATH_OF_PARENT = 1
"""Number of the setting in <sys/prctl.h> of Linux."""

_used = 1


def available() -> int:
    """Processors that this process may run on, where it can be forked."""
    return len(os.sched_getaffinity(0)) if sys.platform == "linux" else 1


def may_use(processors: int) -> None:
    """So many, from now on, for all calls of this process. ValueError for fewer than one."""
    global _used
    if processors < 1:
        raise ValueError(f"processors are {processors}, allowed are 1 or more")
    _used = processors


@contextmanager
def alone() -> Iterator[None]:
    """This process uses no other within it; for all its threads."""
    before = used()
    may_use(1)
    try:
        yield
    finally:
        may_use(before)


def used() -> int:
    """So many this process may use: a process that is begun for its work may use them in its place."""
    return _used


def at_once(calls: Sequence[Callable[[], Out]]) -> list[Out]:
    """What the calls return, in their order; the first is computed here.

    A call must leave nothing behind that another one needs: what it changes in a fork is gone. What cannot be sent,
    or is lost with a fork that was killed, is computed here. An exception of a call is raised here.
    """
    others = min(_used, len(calls)) - 1
    if others < 1:
        return [call() for call in calls]
    forks: list[tuple[ForkProcess, Connection]] = []
    found: Found = {}
    try:
        # A machine that has no room for a fork, or for fewer than wanted, computes with what it has.
        with suppress(OSError):
            taken = get_context("fork").Value("i", 1)
            for _ in range(others):
                forks.append(_fork(calls, taken))
        found[0] = calls[0]()
        if forks:
            found |= _work(calls, taken)
        for _, answer in forks:
            there, steps = _received(answer)
            found |= there
            work.elsewhere(steps)
        return [found[k] if k in found else call() for k, call in enumerate(calls)]
    finally:
        for process, answer in forks:
            # Ended before its pipe is closed: one that is just writing would tell of a broken pipe.
            process.terminate()
            process.join()
            answer.close()


def _fork(calls: Sequence[Callable[[], Any]], taken: Synchronized[int]) -> tuple[ForkProcess, Connection]:
    context = get_context("fork")
    ours, theirs = context.Pipe(duplex=False)
    with theirs:
        process = context.Process(target=_serve, args=(calls, taken, ours, theirs, os.getpid()))
        process.start()
    return process, ours


def _work(calls: Sequence[Callable[[], Any]], taken: Synchronized[int]) -> Found:
    """What the calls return that are taken here, each by its number."""
    found: Found = {}
    while True:
        with taken.get_lock():
            number = taken.value
            taken.value += 1
        if number >= len(calls):
            return found
        found[number] = calls[number]()


def _serve(
    calls: Sequence[Callable[[], Any]],
    taken: Synchronized[int],
    ours: Connection,
    theirs: Connection,
    parent: int,
) -> None:
    # An interrupt from the keyboard reaches all processes; the one that started the others ends them.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    signal.signal(signal.SIGTERM, signal.SIG_DFL)
    ctypes.CDLL(None).prctl(_DEATH_OF_PARENT, signal.SIGTERM)
    if os.getppid() != parent:
        return
    ours.close()
    begun = work.spent()
    answer: tuple[Found, Exception | None]
    try:
        answer = (_work(calls, taken), None)
    except Exception as error:
        answer = ({}, error)
    try:
        theirs.send_bytes(ForkingPickler.dumps((*answer, work.spent() - begun)))
    except (PicklingError, AttributeError, TypeError):
        theirs.send(({}, None, 0.0))


def _received(answer: Connection) -> tuple[Found, float]:
    """What a fork found, and the work that it took; nothing of one that was killed: that is done again here."""
    try:
        found, error, steps = answer.recv()
    except EOFError:
        return {}, 0.0
    if error is not None:
        raise error
    return dict(found), steps
