"""Words by which the header of a table says what a column is: the quantity alone, never an axis or a sign."""

from __future__ import annotations

import re

from pipeline.campaign.mapped.layout import header_unit
from pipeline.campaign.mapped.units import NoUnit, meant, unit

WORDS: dict[str, tuple[str, ...]] = {
    "force": (
        *("force", "load", "loadcell", "weight", "thrust", "tension", "compression", "pull"),
        *(
            "kraft",
            "last",
            "prüfkraft",
            "zugkraft",
            "gewicht",
            "effort",
            "charge",
            "fuerza",
            "carga",
            "forza",
            "carico",
        ),
        *("力", "荷重", "载荷", "сила", "нагрузка", "kuvvet"),
    ),
    "length": (
        *(
            "displacement",
            "disp",
            "extension",
            "deflection",
            "travel",
            "stroke",
            "position",
            "dial",
            "gauge",
            "crosshead",
        ),
        *(
            "elongation",
            "lvdt",
            "indicator",
            "height",
            "traverse",
            "weg",
            "verschiebung",
            "dehnweg",
            "messuhr",
            "hub",
        ),
        *(
            "durchbiegung",
            "déplacement",
            "deplacement",
            "flèche",
            "fleche",
            "course",
            "desplazamiento",
            "flecha",
        ),
        *("spostamento", "freccia", "变位", "変位", "位移", "перемещение"),
    ),
    "moment": ("moment", "torque", "drehmoment", "couple", "par", "coppia", "トルク", "扭矩", "момент"),
    "angle": (
        "angle",
        "rotation",
        "tilt",
        "inclination",
        "winkel",
        "drehung",
        "neigung",
        "ángulo",
        "angolo",
        "угол",
    ),
    "temperature": ("temperature", "temp", "temperatur", "température", "temperatura", "温度"),
    "time": (
        "time",
        "timestamp",
        "elapsed",
        "date",
        "datetime",
        "clock",
        "zeit",
        "uhrzeit",
        "datum",
        "temps",
        "zaman",
        "tiempo",
    ),
    "step": ("step", "schritt"),
    "test": ("test", "specimen", "versuch"),
}
"""In small letters; those of several languages. A word of two quantities stands in none."""
OTHERS = (
    *(
        "speed",
        "rate",
        "velocity",
        "acceleration",
        "gradient",
        "pressure",
        "strain",
        "stress",
        "energy",
        "power",
    ),
    *("stiffness", "compliance", "voltage", "current", "frequency", "cycle", "count", "channel"),
    *("geschwindigkeit", "druck", "dehnung", "spannung", "steifigkeit"),
)
"""Words by which a column is something else, whatever stands beside them."""
ENDINGS = {"kraft": "force", "weg": "length", "zeit": "time", "moment": "moment", "winkel": "angle"}
"""Of German words that are written together: Standardkraft, Traversenweg, Prüfzeit."""
_WORD = re.compile(r"[^\W\d_]+")


def quantity_of(name: str, beside: str = "") -> str | None:
    """What a column is by its unit, else by its words; None where these say nothing, or differ.

    name: as it stands in the header. beside: its unit in a row of units.
    """
    stem, inside = header_unit(name)
    by_unit = _by_unit(beside) or _by_unit(inside)
    if (inside and meant(inside) is None) or (beside.strip("- ") and meant(beside) is None):
        # A unit that is none of the list: a stress, a percentage, a rate.
        return None
    parts = _parts(stem)
    if set(parts) & set(OTHERS):
        return None
    by_word = {what for what, words in WORDS.items() if set(parts) & set(words)}
    by_word |= {what for ending, what in ENDINGS.items() for part in parts if part.endswith(ending)}
    if by_unit is not None:
        # A word may be of something else than its unit: a load in mm is a question.
        return by_unit if not by_word or by_unit in by_word or by_word <= {"step", "test"} else None
    return by_word.pop() if len(by_word) == 1 else None


def _by_unit(spelling: str) -> str | None:
    try:
        return unit(spelling).quantity if spelling.strip() else None
    except NoUnit:
        return None


def _parts(name: str) -> list[str]:
    """Words of a name; what is written together is parted at its capitals."""
    parted = re.sub(r"(?<=[a-zß-ÿ])(?=[A-ZÄÖÜ])", " ", name)
    return [word.lower() for word in _WORD.findall(parted)]
