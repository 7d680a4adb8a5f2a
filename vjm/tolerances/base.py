"""A value that somebody wrote down about a rig, and by how much it may be off where nobody says it."""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

from vjm.effects.base import Effect


class Tolerance(Effect):
    """An effect of either sign on all parts alike, of numbers that are known but for a standard deviation.

    keys: of each parameter, its name where standard deviations are written. deviations: of each key, the standard
    deviation where nothing is said, in the unit of its parameters.
    """

    keys: ClassVar[Mapping[str, str]]
    deviations: ClassVar[Mapping[str, float]]

    @property
    def width(self) -> dict[str, float]:
        """Of each parameter, its standard deviation where nothing is said."""
        return {parameter: self.deviations[key] for parameter, key in self.keys.items()}
