"""Freed memory stays with the process: the same arrays again take no new pages."""

import subprocess
import sys

import pytest

_FAULTS = """
import resource
import numpy as np
from pipeline.memory import keep_freed
{begin}
def arrays():
    for n in (300_000, 700_000, 1_500_000):
        np.ones(n)
    return [np.ones(n) for n in (2_000, 900_000)]
arrays()
before = resource.getrusage(resource.RUSAGE_SELF).ru_minflt
for _ in range(20):
    arrays()
print(resource.getrusage(resource.RUSAGE_SELF).ru_minflt - before)
"""


def _faults(begin: str) -> int:
    code = _FAULTS.format(begin=begin)
    return int(
        subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout
    )


@pytest.mark.skipif(sys.platform != "linux", reason="a setting of the GNU C library")
def test_the_same_arrays_again_take_no_new_pages() -> None:
    assert _faults("keep_freed()") < 20 < _faults("")
