"""A finished sweep as fields on its grid, read from sweep.json and sweep.npy; a large file is never read whole."""

import json
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from reports.errors import ReportError

Floats = npt.NDArray[np.float64]

QUANTITIES: dict[str, tuple[str, str]] = {
    "K_tran_min": ("lowest K_tran", "N/mm"),
    "K_rot_min": ("lowest K_rot", "N·mm/rad"),
    "critical_N": ("least force that makes a leg buckle", "N"),
    "critical_factor": ("the wrench over the one that makes a leg buckle", "%"),
    "shift_mm": ("displacement under the wrench", "mm"),
    "K_tran_loaded_min": ("lowest K_tran under the wrench", "N/mm"),
    "K_rot_loaded_min": ("lowest K_rot under the wrench", "N·mm/rad"),
    "K_tran_error": ("change of the lowest K_tran by the effect", "%"),
    "K_rot_error": ("change of the lowest K_rot by the effect", "%"),
    "offset_mm": ("unloaded platform moved by the effect", "mm"),
    "displacement_error": ("change of the displacement along the wrench by the effect", "%"),
}
"""What is drawn, with title and unit; relative columns in percent."""
AT_REST = ("K_tran_min", "K_rot_min", "critical_N")
_LOST = 3
ROUNDING = 1e-9
"""Below it, in mm, N, N/mm or percent, is no more than rounding."""
LARGEST = 64
"""Points along an axis that an isosurface is made of."""


@dataclass(frozen=True, eq=False)
class Workspace:
    """axes: coordinates along x, y, z, mm. values: (nx, ny, nz, columns), mapped. head: what was asked."""

    axes: tuple[Floats, Floats, Floats]
    values: Floats
    columns: Sequence[str]
    head: dict[str, Any]

    @property
    def quantities(self) -> list[str]:
        """Names of the columns that are drawn."""
        return [name for name in QUANTITIES if name in self.columns]

    @property
    def long(self) -> list[int]:
        """Axes with more than one point."""
        return [k for k, axis in enumerate(self.axes) if len(axis) > 1]

    def field(self, name: str, where: tuple[slice | int, ...] = (slice(None),) * 3) -> Floats:
        """A quantity in its unit on a part of the grid, NaN where there is none."""
        part = self.values[where]
        state = part[..., self.columns.index("state")]
        found = state == 0 if name not in AT_REST else (state == 0) | (state == _LOST)
        values = np.asarray(part[..., self.columns.index(name)], dtype=float)
        if name == "critical_factor":
            # Nothing buckles where it is infinite: its inverse can be drawn everywhere.
            with np.errstate(divide="ignore"):
                values = 1.0 / values
        values = 100.0 * values if QUANTITIES[name][1] == "%" else values
        values = np.where(np.abs(values) < ROUNDING, 0.0, values)
        return np.where(found & np.isfinite(values), values, np.nan)

    @property
    def title(self) -> str:
        """The manipulator, and what was asked of it."""
        said = [self.head["manipulator"]]
        if "wrench" in self.head:
            said.append("under " + " ".join(f"{x:g}" for x in self.head["wrench"]) + " (N, N·mm)")
        for name, sizes in self.head.get("effects", {}).items():
            numbers = ", ".join(f"{key} {value:g}" for key, value in sizes.items())
            said.append(f"{name} {numbers}".rstrip())
        return ", ".join(said)


def read(folder: Path) -> Workspace:
    """The sweep in a folder; ReportError if it is not finished or damaged."""
    try:
        head = json.loads((folder / "sweep.json").read_text(encoding="utf-8"))
        values = np.load(folder / "sweep.npy", mmap_mode="r")
        grid, columns = head["grid"], list(head["columns"])
        counts = tuple(grid["counts"])
        ends = zip(grid["low"], grid["high"], counts, strict=True)
        x, y, z = (np.linspace(low, high, count) for low, high, count in ends)
        return Workspace((x, y, z), values.reshape(*counts, len(columns)), columns, head)
    except OSError as error:
        raise ReportError(f"{folder} holds no finished sweep: {error}") from None
    except (ValueError, KeyError, TypeError) as error:
        raise ReportError(f"{folder} holds no readable sweep: {type(error).__name__}: {error}") from None
