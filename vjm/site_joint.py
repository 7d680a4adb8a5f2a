"""A place of a leg where a law may sit in series: one more axis, which a law holds or an input moves."""

from __future__ import annotations

from dataclasses import dataclass

from vjm.chain import Joint, Role
from vjm.laws import Law

_AXES = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))


@dataclass(frozen=True, eq=False)
class SiteJoint:
    """One axis, along x, y or z (0, 1, 2) or about them (3, 4, 5) of the frame in which it stands.

    law: force, N, or moment, N·mm, as a function of its shift, mm, or turn, rad, which is zero without load. None: it
    is rigid and stands where the input `name` puts it, mm or rad, zero by default: a displacement put in at the site.
    apart: whether the base body is one for all bars on it though no law moves it here, so that unknowns are in the
    order of a linkage in which one does.
    """

    axis: int
    law: Law | None = None
    name: str = ""
    apart: bool = False

    @property
    def joint(self) -> Joint:
        """Its joint in a chain."""
        kind = "translation" if self.axis < 3 else "rotation"
        role = Role.ACTUATED if self.law is None else Role.VIRTUAL
        return Joint(kind, _AXES[self.axis % 3], role)  # type: ignore[arg-type]
