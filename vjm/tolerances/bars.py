"""The stiffness of the bars of a machine's file, as one number."""

from __future__ import annotations

from typing import ClassVar

from vjm.effects.modulus_error import ModulusError
from vjm.tolerances.base import Tolerance


class Bars(ModulusError, Tolerance):
    """K_b of the bars of all parallelograms, known to a share of itself."""

    name = "bars"
    title = "stiffness of the bars of all parallelograms as given"
    keys: ClassVar = {"scale": "bars"}
    deviations: ClassVar = {"bars": 0.03}
