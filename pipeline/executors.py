"""Where independent calls are computed: in this process, in several, or on a dask cluster."""

import os
from collections.abc import Callable, Iterator
from concurrent.futures import Executor, Future, ProcessPoolExecutor
from contextlib import contextmanager
from importlib import import_module
from multiprocessing import get_context
from signal import SIG_IGN, SIGINT, signal
from typing import Any, TypeVar

from pipeline.errors import InputError
from pipeline.system import require
from pipeline.threads import EVERY

Out = TypeVar("Out")


class Serial(Executor):
    """Runs each call where it is submitted."""

    def submit(self, fn: Callable[..., Out], /, *args: Any, **kwargs: Any) -> "Future[Out]":
        future: Future[Out] = Future()
        try:
            future.set_result(fn(*args, **kwargs))
        except Exception as error:
            future.set_exception(error)
        return future


@contextmanager
def executor(workers: int = 1, dask: str | None = None) -> Iterator[tuple[Executor, int]]:
    """An executor and how many calls it runs at once; dask: address of a scheduler, "local" for one started here.

    Processes compute with one thread each. InputError for fewer than one worker, without dask.distributed, or
    where no scheduler answers.
    """
    if workers < 1:
        raise InputError(f"workers is {workers}, allowed are 1 or more")
    if dask is not None:
        with _dask(workers, dask) as client:
            yield client.get_executor(), max(1, len(client.scheduler_info(n_workers=-1)["workers"]))
    elif workers == 1:
        yield Serial(), 1
    else:
        before = {name: os.environ.get(name) for name in EVERY}
        os.environ.update(dict.fromkeys(EVERY, "1"))
        try:
            pool = ProcessPoolExecutor(workers, mp_context=get_context("spawn"), initializer=_deaf)
            try:
                yield pool, workers
            finally:
                # What has not begun is not waited for when something went wrong.
                pool.shutdown(wait=True, cancel_futures=True)
        finally:
            for name, value in before.items():
                if value is None:
                    os.environ.pop(name, None)
                else:
                    os.environ[name] = value


def _deaf() -> None:
    """An interrupt from the keyboard reaches all processes; the one that started the others ends them."""
    signal(SIGINT, SIG_IGN)


@contextmanager
def _dask(workers: int, address: str) -> Iterator[Any]:
    require("distributed")
    distributed = import_module("dask.distributed")
    if address == "local":
        cluster = distributed.LocalCluster(n_workers=workers, threads_per_worker=1, dashboard_address=None)
        with cluster, distributed.Client(cluster) as client:
            yield client
        return
    try:
        client = distributed.Client(address, timeout="10s")
    except (OSError, TimeoutError, ValueError) as error:
        raise InputError(f"no dask scheduler answers at {address}: {error}") from None
    with client:
        yield client
