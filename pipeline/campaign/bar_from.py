"""A bar from the record of `bar` or the result of `run`: K_b, K_g and both bands as nominal values and tolerances."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from math import hypot, isfinite, sqrt
from pathlib import Path
from typing import Any

from pipeline.campaign.tolerance import SHARE
from pipeline.errors import InputError, unread
from pipeline.toml.stiffness import Array, not_a_stiffness, symmetric

OF = {"EA": ("K11",), "EIy": ("K33", "K35", "K55"), "EIz": ("K22", "K26", "K66"), "GJ": ("K44",)}
"""Entries of K_b that each stiffness of a section makes."""
ALLOWED = "allowed is bar.json of the command bar or result.json of run"


@dataclass(frozen=True, eq=False)
class BarFrom:
    """A bar that was computed.

    stiffness: (6, 6) K_b, exactly symmetric. geometric: (6, 6) K_g per N, or None. length, width: mm; width None where
    nobody said it. numerical, modelling: relative bands by EA, EIy, EIz, GJ, the largest of their entries, where they
    were computed.
    """

    path: Path
    stiffness: Array
    geometric: Array | None
    length: float
    width: float | None
    numerical: Mapping[str, float]
    modelling: Mapping[str, float]

    @property
    def name(self) -> str:
        """Of its file."""
        return self.path.name

    @property
    def polar_radius(self) -> float:
        """Radius of gyration of the section by which an axial force stiffens the twist, mm: the root of K_g44 L."""
        return 0.0 if self.geometric is None else sqrt(max(float(self.geometric[3, 3]) * self.length, 0.0))

    def tolerance(self, usual: Mapping[str, float]) -> dict[str, float]:
        """The usual standard deviations (of the material and the drawing) with both bands, as roots of sums of squares.

        At most `SHARE`: a bar that is known no better is not known.
        """
        own = {
            key: min(hypot(value, self.numerical.get(key, 0.0), self.modelling.get(key, 0.0)), SHARE)
            for key, value in usual.items()
            if key in OF
        }
        return {**usual, **own}

    @property
    def bands(self) -> dict[str, float]:
        """Both bands of EA, EIy, EIz, GJ together, as the root of the sum of their squares."""
        return {key: hypot(self.numerical.get(key, 0.0), self.modelling.get(key, 0.0)) for key in OF}

    @property
    def said(self) -> str:
        """The bands in words."""
        parts = [
            f"{key} {_told(self.numerical, key)} by mesh and {_told(self.modelling, key)} by tie of the ends"
            for key in OF
        ]
        return f"{self.name} adds its bands to the usual tolerance: {', '.join(parts)}"


def _told(bands: Mapping[str, float], key: str) -> str:
    return f"{100 * bands[key]:.2g} %" if key in bands else "nothing known"


def bar_from(path: Path) -> BarFrom:
    """The bar in a file; InputError where it cannot be read or holds none."""
    try:
        raw = json.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise InputError(f"{path}: {unread(error)}") from error
    except ValueError as error:
        raise InputError(f"{path}: is no JSON, {ALLOWED}") from error
    try:
        # A run of a bar that came as a file has the record of that bar inside.
        own = raw["bar"] if raw.get("kind") == "part" else raw
        found = _of_bar(path, own) if own.get("kind") == "bar" else _of_run(path, own)
    except (KeyError, TypeError, ValueError, AttributeError, IndexError) as error:
        raise InputError(f"{path}: is no result of run or bar, {ALLOWED}") from error
    if why := not_a_stiffness(found.stiffness.tolist()):
        raise InputError(f"{path}: its stiffness {why}")
    if not (isfinite(found.length) and found.length > 0.0):
        raise InputError(f"{path}: its length is {found.length:g} mm, allowed is above 0")
    return found


def _of_bar(path: Path, raw: Mapping[str, Any]) -> BarFrom:
    width = raw["width_mm"]
    return BarFrom(
        path,
        symmetric(raw["stiffness"]),
        None if raw["geometric"] is None else symmetric(raw["geometric"]),
        float(raw["length_mm"]),
        None if width is None else float(width),
        _by_stiffness(raw["numerical_band"]),
        _by_stiffness(raw["modelling_band"]),
    )


def _of_run(path: Path, raw: Mapping[str, Any]) -> BarFrom:
    bar = raw["bar"]
    axial = bar.get("axial")
    other = {entry["entry"]: abs(float(entry["deviation"])) for entry in bar["second_route"]["entries"]}
    return BarFrom(
        path,
        symmetric(bar["stiffness"]),
        None if axial is None else symmetric(axial["solid"]),
        float(raw["length_mm"]),
        float(raw["width_mm"]),
        _by_stiffness(bar["convergence"]["band"]),
        _by_stiffness(other),
    )


def _by_stiffness(band: Mapping[str, float]) -> dict[str, float]:
    """Of each stiffness of a section the largest band of its entries."""
    found = {key: [abs(float(band[e])) for e in entries if e in band] for key, entries in OF.items()}
    return {key: max(each) for key, each in found.items() if each}
