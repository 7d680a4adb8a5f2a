"""Functions that numba compiles: at their first use, and kept on disk where there is a place for it."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar, cast

from numba import njit

Function = TypeVar("Function", bound=Callable[..., Any])


def compiled(function: Function) -> Function:
    """The function compiled at its first use, for arrays as they come there; division by zero is as in arrays.

    What is kept on disk is made anew where the file of the function changes: not where another file does that it reads.
    """
    try:
        return cast(Function, njit(cache=True, error_model="numpy")(function))
    except RuntimeError:
        # Neither the folder of the program nor that of the user can be written to.
        return cast(Function, njit(error_model="numpy")(function))
