"""Where independent calls are computed: in this process, in several, or on a dask cluster."""

from __future__ import annotations

import signal
import sys
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from importlib import import_module
from typing import Any

import cloudpickle
from joblib import Parallel, delayed, parallel_config

from pipeline.errors import InputError
from pipeline.memory import keep_freed
from pipeline.processors import alone
from pipeline.system import require
from vjm.effects import USERS

Call = Callable[[], Any]
Pool = Callable[[Iterable[Call]], Iterator[Any]]
"""Takes calls as they are needed, and gives what they return as it comes: the order is that of one process only."""
AHEAD = "2 * n_jobs"
"""Calls that are under way or wait: a study of many trials is not drawn up before it begins."""
IDLE = 10
"""Seconds that a process waits for another pool before it ends."""


def one_after_another(calls: Iterable[Call]) -> Iterator[Any]:
    """The pool of this process alone."""
    return (call() for call in calls)


@contextmanager
def pool(workers: int = 1, dask: str | None = None) -> Iterator[Pool]:
    """Processes of one thread each; dask: address of a scheduler, "local" for one started here.

    InputError for fewer than one worker, without dask.distributed, or where no scheduler answers.
    """
    if workers < 1:
        raise InputError(f"workers is {workers}, allowed are 1 or more")
    if dask is not None:
        with _dask(workers, dask), parallel_config("dask"):
            yield _each
    elif workers == 1:
        # One worker is one process: its seconds compare with those of each of many.
        with alone():
            yield one_after_another
    else:
        # Arrays go as copies: a call may write into its own.
        with parallel_config(
            "loky",
            n_jobs=workers,
            inner_max_num_threads=1,
            max_nbytes=None,
            idle_worker_timeout=IDLE,
            initializer=_begin,
        ):
            yield _each


def _each(calls: Iterable[Call]) -> Iterator[Any]:
    _send_users_effects()
    run = Parallel(return_as="generator_unordered", pre_dispatch=AHEAD, batch_size=1)
    results: Iterator[Any] = run(delayed(call)() for call in calls)
    return results


def _send_users_effects() -> None:
    """What is defined in a user's own file goes with the call: another process has not read that file."""
    for module in [module for name, module in sys.modules.items() if name.startswith(USERS)]:
        cloudpickle.register_pickle_by_value(module)


def _begin() -> None:
    """An interrupt from the keyboard reaches all processes; the one that started the others ends them."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    keep_freed()


@contextmanager
def _dask(workers: int, address: str) -> Iterator[None]:
    require("distributed")
    distributed = import_module("dask.distributed")
    if address == "local":
        cluster = distributed.LocalCluster(n_workers=workers, threads_per_worker=1, dashboard_address=None)
        with cluster, distributed.Client(cluster):
            yield
        return
    try:
        client = distributed.Client(address, timeout="10s")
    except (OSError, TimeoutError, ValueError) as error:
        raise InputError(f"no dask scheduler answers at {address}: {error}") from None
    with client:
        yield
