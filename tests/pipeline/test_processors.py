"""Calls at once: same answers in the same order wherever they are computed, and nothing is lost with a process."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from functools import partial

import pytest

from pipeline import processors
from pipeline.pools import pool
from pipeline.processors import at_once, available, may_use
from vjm import work

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="forks are made on Linux alone")


@pytest.fixture(autouse=True)
def three() -> Iterator[None]:
    may_use(3)
    yield
    may_use(1)


def where(number: int, seconds: float = 0.1) -> tuple[int, int]:
    time.sleep(seconds)
    return number, os.getpid()


def test_answers_are_in_order_and_the_first_is_computed_here() -> None:
    found = at_once([partial(where, k) for k in range(7)])
    assert [number for number, _ in found] == list(range(7))
    processes = [process for _, process in found]
    assert processes[0] == os.getpid() and 1 < len(set(processes)) <= 3


def test_alone_unless_it_was_said() -> None:
    may_use(1)
    assert {process for _, process in at_once([partial(where, k, 0.0) for k in range(4)])} == {os.getpid()}
    assert at_once([]) == []
    with pytest.raises(ValueError, match="processors are 0, allowed are 1 or more"):
        may_use(0)
    assert 1 <= available() <= (os.cpu_count() or 1)


def test_forks_have_forks_of_their_own() -> None:
    def inner() -> set[int]:
        return {process for _, process in at_once([partial(where, k) for k in range(2)])}

    first, second = at_once([inner, inner])
    assert len(first) == len(second) == 2 and not first & second


def test_what_cannot_be_sent_is_computed_here() -> None:
    def closure(number: int) -> Callable[[], int]:
        time.sleep(0.1)
        return lambda: number

    assert [found() for found in at_once([partial(closure, k) for k in range(4)])] == [0, 1, 2, 3]


def test_what_is_lost_with_a_fork_is_computed_here() -> None:
    here = os.getpid()

    def killed() -> str:
        if os.getpid() != here:
            os.kill(os.getpid(), signal.SIGKILL)
        return "here"

    assert at_once([partial(where, 0, 0.3), killed, killed])[1:] == ["here", "here"]


def fails() -> tuple[int, int]:
    raise RuntimeError("no equilibrium")


def test_an_error_here_waits_for_nobody() -> None:
    begin = time.perf_counter()
    with pytest.raises(RuntimeError, match="no equilibrium"):
        at_once([fails, partial(where, 1, 20.0), partial(where, 2, 20.0)])
    assert time.perf_counter() - begin < 10.0


def test_a_fork_that_is_not_waited_for_says_nothing(
    capfd: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """It is ended late, while it writes what it found: more than a pipe holds."""
    end = processors.ForkProcess.terminate

    def slowly(process: processors.ForkProcess) -> None:
        time.sleep(0.3)
        end(process)

    def late() -> bytes:
        time.sleep(0.5)
        raise RuntimeError("no equilibrium")

    monkeypatch.setattr(processors.ForkProcess, "terminate", slowly)
    with pytest.raises(RuntimeError, match="no equilibrium"):
        at_once([late, partial(bytes, 10**7), partial(bytes, 10**7)])
    assert not capfd.readouterr().err


def test_one_worker_is_one_process() -> None:
    with pool(1) as computed:
        calls = [partial(where, k, 0.0) for k in range(3)]
        assert [process for _, process in next(computed([partial(at_once, calls)]))] == [os.getpid()] * 3
    assert len({process for _, process in at_once([partial(where, k, 0.2) for k in range(3)])}) > 1


def test_an_error_in_a_fork_is_raised_here() -> None:
    with pytest.raises(RuntimeError, match="no equilibrium"):
        at_once([partial(where, 0, 0.3), fails, partial(where, 2)])


def test_no_room_for_forks_is_no_end(monkeypatch: pytest.MonkeyPatch) -> None:
    def full(*_: object) -> None:
        raise BlockingIOError("no room")

    monkeypatch.setattr(processors, "_fork", full)
    assert {process for _, process in at_once([partial(where, k, 0.0) for k in range(3)])} == {os.getpid()}


def test_forks_end_with_the_process_that_made_them() -> None:
    """Even if that one is killed and cannot end them itself."""
    code = (
        "import os, time\n"
        "from pipeline.processors import at_once, may_use\n"
        "may_use(2)\n"
        "def sleep():\n"
        "    os.write(1, b'%d\\n' % os.getpid())\n"
        "    time.sleep(60)\n"
        "at_once([sleep, sleep])\n"
    )
    process = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True)
    assert process.stdout is not None
    numbers = {int(process.stdout.readline()) for _ in range(2)}
    (fork,) = numbers - {process.pid}
    process.kill()
    process.wait()
    for _ in range(100):
        if not alive(fork):
            return
        time.sleep(0.05)
    pytest.fail("the fork goes on")


def alive(number: int) -> bool:
    try:
        with open(f"/proc/{number}/stat", encoding="ascii") as file:
            return file.read().rpartition(")")[2].split()[0] != "Z"
    except FileNotFoundError:
        return False


def test_work_counts_wherever_it_was_done() -> None:
    def busy(steps: float) -> float:
        work.elsewhere(steps)
        # As long as the other call, so that each process has one.
        time.sleep(0.2)
        return steps

    before = work.spent()
    assert at_once([partial(busy, 3.0), partial(busy, 4.0)]) == [3.0, 4.0]
    assert work.spent() == before + 7.0
    with work.at_most(5.0), pytest.raises(work.TooMuch):
        at_once([partial(busy, 3.0), partial(busy, 4.0)])
