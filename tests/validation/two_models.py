"""One bench programme through both models of a rig: virtual springs with an effect, and a frame with the error."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from fem.frame import bench
from fem.frame.errors import Errors
from fem.frame.rig import Gauge, Rig
from meshes.solid import Floats
from tests.vjm.load_paths import load_path
from vjm.effects import base as effects_base
from vjm.effects import catalogue
from vjm.effects.thermal_expansion import DRIVE
from vjm.mechanisms.assembly import GaugeAt
from vjm.mechanisms.bar import Bar
from vjm.mechanisms.parallelogram import Parallelogram
from vjm.sensors import TrueMoment

NAMES = ("x", "y", "z", "rx", "ry", "rz")
GAUGES = {
    "mid": (1, 0.5, (0.0, 1.0, 0.0), None),
    "dial": (1, 0.0, (0.0, 0.0, 1.0), (-45.0, 20.0, 15.0)),
}
"""Bar, station, direction and offset of the gauges: one across a bar, one that sees the platform move and turn."""
AT = {"mid": 1, "dial": 2}
"""The coordinate whose place each of them takes, where it is controlled."""

Values = Mapping[str, Mapping[str, float]]
"""Values of the parameters of effects, by the catalogue's names."""


@dataclass(frozen=True, eq=False)
class Trial:
    """One test of the programme.

    control: six of "displacement", "force" and a gauge's name. values (S, 6) of what they prescribe.
    rise: (S,) temperature above the reference, K.
    """

    name: str
    degrees: float
    control: tuple[str, ...]
    values: Floats
    rise: Floats

    @property
    def channels(self) -> np.ndarray:
        """(6,) channel numbers of `vjm.sensors`."""
        kinds, gauges = {"displacement": 0, "force": 6}, list(GAUGES)
        return np.array(
            [12 + gauges.index(c) if c in gauges else i + kinds[c] for i, c in enumerate(self.control)]
        )


@dataclass(frozen=True, eq=False)
class Drawing:
    """What both models are told: lengths in mm, 6x6 of the bar, outermost fibres in mm, supports of a single bar."""

    length: float
    width: float
    stiffness: Floats
    fibre_y: float
    fibre_z: float
    kind: Literal["parallelogram", "bar"] = "parallelogram"
    base: Literal["clamped", "pinned"] = "clamped"
    tip: Literal["free", "pinned", "guided"] = "free"

    def springs(self) -> effects_base.Rig:
        """Lumped virtual springs."""
        more = {"sensors": (TrueMoment(),), "gauge_at": tuple(GaugeAt(*place) for place in GAUGES.values())}
        more |= {"fibre_y": self.fibre_y, "fibre_z": self.fibre_z}
        if self.kind == "bar":
            return Bar(self.length, self.stiffness, base=self.base, tip=self.tip, **more)  # type: ignore[arg-type]
        return Parallelogram(self.length, self.width, self.stiffness, **more)  # type: ignore[arg-type]

    def frame(self) -> Rig:
        """The frame's rig."""
        return Rig(
            self.kind,
            self.length,
            self.stiffness,
            self.width,
            self.base,
            self.tip,
            fibre_y=self.fibre_y,
            fibre_z=self.fibre_z,
        )


def trial(name: str, degrees: float, free: str = "", warm: float = 0.0, **columns: Sequence[float]) -> Trial:
    """A trial whose coordinates named in `free` are controlled by force; those not named in `columns` stay zero.

    A column called as a gauge makes it the control of its coordinate. warm: temperature that rises linearly to it, K.
    """
    steps = max(len(c) for c in columns.values())
    control = ["force" if n in free.split() else "displacement" for n in NAMES]
    values = np.zeros((steps, 6))
    for key, column in columns.items():
        at = AT[key] if key in AT else NAMES.index(key)
        values[:, at] = column
        if key in AT:
            control[at] = key
    return Trial(name, degrees, tuple(control), values, np.linspace(0.0, warm, steps))


def by_springs(
    drawing: Drawing, effects: Values, trials: Sequence[Trial], segments: int | None = 6
) -> tuple[Floats, np.ndarray]:
    """(T, S, 14) displacement, wrench and gauges by virtual springs, and (T, S) whether they were found.

    trials: all of as many steps. segments: of each bar, None for lumped bars.
    """
    rig = drawing.springs() if segments is None else drawing.springs().refined(segments)
    found = catalogue()
    for name, values in effects.items():
        rig = found[name].apply(rig, {**found[name].nulls, **values})
    q = np.radians([t.degrees for t in trials])
    origin = np.zeros((len(trials), 12 + len(GAUGES)))
    origin[:, 0], origin[:, 2] = drawing.length * np.cos(q), -drawing.length * np.sin(q)
    channels = np.array([t.channels for t in trials])
    targets = np.stack([t.values for t in trials], axis=1)
    targets = targets + np.take_along_axis(origin, channels, axis=-1)
    drives = {"q": np.broadcast_to(q, targets.shape[:-1])} if drawing.kind == "parallelogram" else {}
    if "thermal_expansion" in effects:
        drives[DRIVE] = np.stack([t.rise for t in trials], axis=1)
    path = load_path(rig, targets, channels, drives=drives)
    return np.moveaxis(path.readings - origin, 0, 1), path.converged.T


def by_frame(
    drawing: Drawing, effects: Values, trials: Sequence[Trial], elements: int = 16
) -> tuple[Floats, np.ndarray]:
    """(T, S, 14) displacement, wrench and gauges by the frame, and (T, S) whether they were found."""
    errors = {f"{e}.{p}": v for e, part in effects.items() for p, v in part.items()}
    errors = {_FRAME.get(path, path): v for path, v in errors.items()}
    if (line := errors.pop("self_weight.line_N_per_mm", None)) is not None:
        errors["self_weight.line_z_N_per_mm"] = -line
    rig = drawing.frame()
    warm = rig.reference_temperature
    programme = [bench.Trial(np.radians(t.degrees), t.control, t.values, warm + t.rise) for t in trials]
    found = bench.run(
        rig, Errors.of(errors), programme, [Gauge(name, *place) for name, place in GAUGES.items()], elements
    )
    readings = np.array([np.hstack([r.displacement, r.wrench, r.gauges]) for r in found])
    return readings, np.array([r.converged for r in found])


_FRAME = {f"self_weight.platform_{a}_N": f"self_weight.f{a}_N" for a in "xyz"}
