"""Work for a child process that does what a hostile file makes a reader do."""

from __future__ import annotations

import ctypes
import time
from typing import Any

import numpy as np


def work(asked: dict[str, Any]) -> tuple[dict[str, Any], dict[str, Any]]:
    if asked["do"] == "hang":
        time.sleep(60)
    if asked["do"] == "crash":
        ctypes.string_at(0)
    if asked["do"] == "fill":
        np.zeros((2**20, 2**20))
    return {"said": asked["do"]}, {"a": np.array([1, 2])}
