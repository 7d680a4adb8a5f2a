"""What a sweep found, in a few lines; the file is gone through in blocks, so that any size fits."""

from collections.abc import Iterator

import numpy as np

from pipeline.manipulator.question import FOUND, LOST, SINGULAR, UNREACHED, Array
from pipeline.manipulator.sweep import Sweep

_BLOCK = 100_000
TITLES = {
    "K_tran_min": ("lowest K_tran", "N/mm"),
    "K_rot_min": ("lowest K_rot", "N·mm/rad"),
    "critical_N": ("force that makes a leg buckle", "N"),
    "critical_factor": ("factor of the wrench that makes a leg buckle", ""),
    "shift_mm": ("displacement under the wrench", "mm"),
    "K_tran_loaded_min": ("lowest K_tran under the wrench", "N/mm"),
    "K_tran_error": ("error of the lowest K_tran by the effect, relative", ""),
    "K_rot_error": ("error of the lowest K_rot by the effect, relative", ""),
    "offset_mm": ("unloaded platform moved by the effect", "mm"),
    "displacement_error": ("error of the displacement along the wrench by the effect, relative", ""),
}


def summary(done: Sweep, seconds: float) -> list[str]:
    """Sentences: how many postures, how fast, and the range of each quantity."""
    low, high = np.full(len(done.columns), np.inf), np.full(len(done.columns), -np.inf)
    states = np.zeros(4, dtype=int)
    for block in blocks(done):
        found = block[block[:, 3] == FOUND]
        states += [np.sum(block[:, 3] == code) for code in range(4)]
        if len(found):
            low, high = np.minimum(low, found.min(0)), np.maximum(high, found.max(0))
    lines = [_counted(states)]
    if states[int(FOUND)]:
        for name, (title, unit) in TITLES.items():
            if name in done.columns:
                k = done.columns.index(name)
                lines.append(f"{title}: {low[k]:.4g} to {high[k]:.4g} {unit}".rstrip())
    if done.postures:
        lines.append(f"{done.postures} postures in {seconds:.1f} s, {done.postures / seconds:.0f} a second")
    return [*lines, f"sweep: {done.folder}"]


def blocks(done: Sweep) -> Iterator[Array]:
    """The rows, some at a time."""
    values = done.values
    for start in range(0, len(values), _BLOCK):
        yield np.asarray(values[start : start + _BLOCK])


def _counted(states: np.ndarray) -> str:
    said = {UNREACHED: "out of reach", SINGULAR: "without stiffness", LOST: "without a stable equilibrium"}
    parts = [f"{states[int(code)]} {words}" for code, words in said.items() if states[int(code)]]
    return ", ".join([f"{states.sum()} postures", *parts])
