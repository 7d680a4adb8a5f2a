"""A law that acts on the coordinate of the other sign."""

from __future__ import annotations

from dataclasses import dataclass
from typing import cast

from vjm.frames import Array
from vjm.laws import Around, Law, Response
from vjm.slides import Giving
from vjm.under_load import UnderLoad


@dataclass(frozen=True, eq=False)
class Mirrored(Around):
    """The scalar law seen from the other side."""

    def respond(self, strain: Array, memory: Array) -> Response:
        answer = self.law.respond(-strain, memory)
        return Response(answer.energy, -answer.force, answer.tangent, answer.memory)


@dataclass(frozen=True, eq=False)
class MirroredGiving(Mirrored):
    """One whose strain is known from its force."""

    def give(self, force: Array) -> Array:
        """Strain at a force; both (...)."""
        return -cast(Giving, self.law).give(-force)


def mirrored(law: Law) -> Law:
    """A scalar law seen from the other side."""
    if isinstance(law, UnderLoad):
        # It is odd, and where it stands it is told from others by its kind.
        return law
    return MirroredGiving(law) if isinstance(law, Giving) else Mirrored(law)
