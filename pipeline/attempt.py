"""Work that may fail without taking the result with it: pictures, the next test, words."""

from __future__ import annotations

import logging
import traceback
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, TypeVar, cast

from numpy.linalg import LinAlgError

Out = TypeVar("Out")
LOG = logging.getLogger(__name__)


@dataclass
class Attempts:
    """Runs optional work; `failed` has a sentence for each part that failed, in order."""

    failed: list[str] = field(default_factory=list)

    def get(self, what: str, work: Callable[[], Out], otherwise: Any) -> Out:
        """What the work returns, or `otherwise` where it fails. what: begins the sentence, such as "the next test"."""
        try:
            return work()
        # Whatever goes wrong in an optional part, a user's own effect included, the verdict stays.
        except Exception as error:
            LOG.info("%s failed", what, exc_info=True)
            self.failed.append(f"{what} could not be worked out: {plain(error)}")
            return cast(Out, otherwise)


def plain(error: Exception) -> str:
    """An error in words of the field; what a library of linear algebra says of itself says nothing to a user."""
    if isinstance(error, LinAlgError):
        return "its equations have no single solution"
    if isinstance(error, ArithmeticError):
        return "its numbers leave the range of arithmetic"
    if _of_a_library(error):
        return f"an error that was not foreseen ({type(error).__name__}); --log FILE before the command says where"
    return str(error) or type(error).__name__


def _of_a_library(error: Exception) -> bool:
    """Whether it was raised outside the project: its words are about arrays and types."""
    frames = traceback.extract_tb(error.__traceback__)
    return bool(frames) and "site-packages" in Path(frames[-1].filename).parts
