"""A command computes with one thread of linear algebra, unless the environment says otherwise."""

import os
import subprocess
import sys

import pytest

from pipeline.threads import EVERY

_COMMAND = """
import runpy
import sys
sys.argv = ["pipeline", "effects"]
try:
    runpy.run_module("pipeline", run_name="__main__")
except SystemExit:
    pass
import numpy
import scipy.linalg
from threadpoolctl import threadpool_info
print(max(each["num_threads"] for each in threadpool_info() if each["internal_api"] == "openblas"))
"""


def _threads(**environment: str) -> int:
    others = {name: value for name, value in os.environ.items() if name not in EVERY}
    done = subprocess.run(
        [sys.executable, "-c", _COMMAND], capture_output=True, text=True, check=True, env=others | environment
    )
    return int(done.stdout.split()[-1])


@pytest.mark.skipif((os.cpu_count() or 1) < 2, reason="one core has one thread anyhow")
def test_a_command_takes_one_thread() -> None:
    assert _threads() == 1


@pytest.mark.skipif((os.cpu_count() or 1) < 2, reason="one core has one thread anyhow")
@pytest.mark.parametrize(
    "name", [pytest.param("OMP_NUM_THREADS", marks=pytest.mark.long), "OPENBLAS_NUM_THREADS"]
)
def test_the_environment_decides(name: str) -> None:
    assert _threads(**{name: "2"}) == 2
