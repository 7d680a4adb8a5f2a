"""One threshold by which a diagnosis chooses: its unit, what it decides, where its value is from."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

OWN = "own"
EVIDENCE = "evidence"
CHI2, SIGMA, SHARE, COUNT, FACTOR, CHANCE = "chi-square", "sigma", "part", "count", "times", "probability"


@dataclass(frozen=True)
class Criterion:
    """One threshold. unit: of its value. group: of what it decides. source: a publication, a derivation, or own."""

    name: str
    value: float
    unit: str
    group: str
    meaning: str
    source: str


def criterion(
    value: float, unit: str, group: str, meaning: str, source: str = OWN, fits: bool = False
) -> Any:
    """A field of a record. fits: whether fits themselves depend on it, not only what is chosen of them."""
    told = {"unit": unit, "group": group, "meaning": meaning, "source": source}
    return field(default=value, metadata={"told": told, "fits": fits})
