"""The stiffness of the links of a machine's file, as one number."""

from __future__ import annotations

from typing import ClassVar

from vjm.effects.link_compliance import LinkCompliance
from vjm.tolerances.base import Tolerance


class Links(LinkCompliance, Tolerance):
    """Stiffness of all elastic links beside the bars of parallelograms, known to a share of itself."""

    name = "links"
    title = "stiffness of all links as given"
    keys: ClassVar = {"scale": "links"}
    deviations: ClassVar = {"links": 0.03}
