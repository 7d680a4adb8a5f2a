"""The bars' section as it was given."""

from __future__ import annotations

from typing import ClassVar

from vjm.effects.bar_section_error import BarSectionError
from vjm.tolerances.base import Tolerance


class Section(BarSectionError, Tolerance):
    """EA, EI_y, EI_z and GJ of all bars, each known to a share of itself."""

    name = "section"
    title = "stiffnesses of the bars' section as given"
    keys: ClassVar = {"ea": "EA", "eiy": "EIy", "eiz": "EIz", "gj": "GJ"}
    deviations: ClassVar = {"EA": 0.02, "EIy": 0.02, "EIz": 0.02, "GJ": 0.02}
