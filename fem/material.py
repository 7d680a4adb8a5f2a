"""Isotropic elastic material."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Isotropic:
    """Young's modulus `E` in MPa and Poisson's ratio `nu`, with the `source` of the figures."""

    E: float
    nu: float
    source: str = ""

    def __post_init__(self) -> None:
        if not self.E > 0.0:
            raise ValueError(f"E is {self.E:g} MPa, allowed is above 0")
        if not -1.0 < self.nu < 0.5:
            raise ValueError(f"nu is {self.nu:g}, allowed is above -1 and below 0.5")

    @property
    def shear_modulus(self) -> float:
        """G = E / (2 (1 + ν)), MPa."""
        return self.E / (2.0 * (1.0 + self.nu))

    @property
    def lame(self) -> float:
        """First Lamé constant λ = E ν / ((1 + ν)(1 - 2ν)), MPa."""
        return self.E * self.nu / ((1.0 + self.nu) * (1.0 - 2.0 * self.nu))
