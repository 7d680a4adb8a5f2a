"""The process that computes beside the page: on all processors, and gone with the program."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Iterator
from multiprocessing import Pipe

import pytest

from pipeline.processors import may_use, used
from pipeline.studio.worker import Worker, serve

PROGRAM = """
from pipeline.processors import may_use
from pipeline.studio.worker import Worker
if __name__ == "__main__":
    may_use(2)
    worker = Worker()
"""


@pytest.fixture
def alone() -> Iterator[None]:
    yield
    may_use(1)


def test_a_task_is_done_on_the_processors_that_the_program_may_use(alone: None) -> None:
    ours, theirs = Pipe()
    ours.close()
    serve(theirs, 2)
    assert used() == 2


def test_the_process_may_have_others_beside_it(alone: None) -> None:
    """A daemon may not: a diagnosis in it would end in an AssertionError, or compute on one processor."""
    worker = Worker()
    try:
        assert not worker._process.daemon
    finally:
        worker.close()


def test_it_ends_with_the_program() -> None:
    ended = subprocess.run(
        [sys.executable, "-c", PROGRAM],
        timeout=60,
        capture_output=True,
        text=True,
        check=False,
    )
    assert ended.returncode == 0, ended.stderr
