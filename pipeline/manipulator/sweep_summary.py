"""What a sweep found, in a few lines; the file is gone through in blocks, so that any size fits."""

from collections import Counter
from collections.abc import Iterator, Sequence

import numpy as np

from pipeline.manipulator.question import FOUND, LOST, SINGULAR, UNREACHED, Array
from pipeline.manipulator.sweep import Sweep

_BLOCK = 100_000
_SAID = 6
TITLES = {
    "K_tran_min": ("lowest K_tran", "N/mm"),
    "K_rot_min": ("lowest K_rot", "N·mm/rad"),
    "K_tran_mean": ("K_tran, mean over all directions", "N/mm"),
    "K_rot_mean": ("K_rot, mean over all directions", "N·mm/rad"),
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
    """Sentences: how many postures, how fast, the range of each quantity, and why numbers are missing."""
    low, high = np.full(len(done.columns), np.inf), np.full(len(done.columns), -np.inf)
    states, missing = np.zeros(4, dtype=int), Counter[int]()
    for block in blocks(done):
        found = block[block[:, 3] == FOUND]
        states += [np.sum(block[:, 3] == code) for code in range(4)]
        missing.update(block[:, done.columns.index("reason")].astype(int).tolist())
        if len(found):
            # Unlike minimum and maximum these pass over a number that is missing.
            low, high = np.fmin(low, np.fmin.reduce(found)), np.fmax(high, np.fmax.reduce(found))
    lines = [_counted(states), *_missing(missing, done.reasons)]
    if states[int(FOUND)]:
        for name, (title, unit) in TITLES.items():
            if name in done.columns:
                k = done.columns.index(name)
                lines.append(f"{title}: {_range(low[k], high[k], unit)}")
    if done.postures:
        lines.append(f"{done.postures} postures in {seconds:.1f} s, {done.postures / seconds:.0f} a second")
    return [*lines, f"sweep: {done.folder}"]


def _range(low: float, high: float, unit: str) -> str:
    """From lowest to highest; one number where they are the same, words where there is none."""
    if high == -np.inf:
        return "at no posture"
    if low == np.inf:
        return "none, however large"
    return f"{low:.4g} to {high:.4g} {unit}".rstrip() if low != high else f"{low:.6g} {unit}".rstrip()


def _missing(missing: Counter[int], reasons: Sequence[str]) -> list[str]:
    """Why numbers are missing, the commonest reason first."""
    said = [(reasons[number], count) for number, count in missing.most_common() if number]
    lines = [f"at {count} of {missing.total()} postures: {reason}" for reason, count in said[:_SAID]]
    return lines if len(said) <= _SAID else [*lines, f"and {len(said) - _SAID} reasons more, each at fewer"]


def blocks(done: Sweep) -> Iterator[Array]:
    """The rows (n, columns), some at a time."""
    values = done.values
    for start in range(0, len(values), _BLOCK):
        yield np.asarray(values[start : start + _BLOCK])


def _counted(states: np.ndarray) -> str:
    said = {UNREACHED: "out of reach", SINGULAR: "without stiffness", LOST: "without a stable equilibrium"}
    parts = [f"{states[int(code)]} {words}" for code, words in said.items() if states[int(code)]]
    return ", ".join([f"{states.sum()} postures", *parts])
