"""How many threads linear algebra takes: one, where its many small matrices would only wait for each other."""

import os
from collections.abc import Iterable

BLAS = "OPENBLAS_NUM_THREADS"
"""For numpy and scipy alone; the sparse solver of the finite elements keeps its own threads."""
EVERY = ("OMP_NUM_THREADS", "MKL_NUM_THREADS", BLAS)


def one_thread(names: Iterable[str] = EVERY) -> None:
    """One thread for these libraries, unless the environment says otherwise. Has to come before numpy is imported."""
    if BLAS in names and BLAS not in os.environ and "OMP_NUM_THREADS" in os.environ:
        # OpenBLAS follows OpenMP's number where it has none of its own.
        names = [name for name in names if name != BLAS]
    for name in names:
        os.environ.setdefault(name, "1")
