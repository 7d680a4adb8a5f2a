"""Effects on the parts of a machine's legs that no rig of bars alone has: drives, links."""

from __future__ import annotations

from abc import abstractmethod
from typing import ClassVar

from vjm.effects.base import Changing, Effect, OfLegs, Rig, Values
from vjm.parts import Part


class OfParts(Effect):
    """An effect on single parts of the legs of a machine; site: the name of one leg, "" for all."""

    kinds: ClassVar = ("manipulator",)

    @abstractmethod
    def changed_part(self, part: Part, values: Values) -> Part:
        """A part with the effect; itself where it is none that has it."""

    def change(self, rig: Rig, values: Values) -> Rig:
        """ValueError: a rig of bars has no such part."""
        raise ValueError(f"{self.name} needs a rig of kind manipulator")

    def apply(self, mechanism: Changing, values: Values, site: str = "") -> Changing:
        """The mechanism with the effect; itself where all values are null. ValueError where it has no such part."""
        if not isinstance(mechanism, OfLegs):
            raise ValueError(f"{self.name} needs a rig of kind manipulator")
        if self.absent(values):
            return mechanism
        changed = mechanism.with_parts(lambda part: self.changed_part(part, values), site or self.tags)
        if changed is mechanism:
            raise ValueError(f"{self.name} changes nothing: the machine has no {self.parts} that it acts on")
        return changed
