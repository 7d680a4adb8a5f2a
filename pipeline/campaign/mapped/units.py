"""Units that a table may have: a closed list, each with what it is in the units of the contract.

A word that means two things in the field is in no list: it is refused with the question that it raises. A pound, a
kilogram or a gram is a mass, and F is a farad to one library and a degree to another.
Factors: BIPM, The International System of Units, 9th edition, 2019; NIST Special Publication 811, 2008, appendix B.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import pi

GRAVITY = 9.80665
"""m/s², the standard value by which kgf, gf, lbf and ozf are defined."""
POUND = 0.45359237
"""kg."""
INCH = 25.4
"""mm."""
LBF = POUND * GRAVITY
"""N."""

QUANTITIES = {
    "length": "mm",
    "angle": "rad",
    "force": "N",
    "moment": "N·mm",
    "temperature": "°C",
    "time": "s",
}
"""What is measured, and the unit of the contract."""


@dataclass(frozen=True)
class Unit:
    """A reading r in this unit is factor * r + offset in that of the contract. spelling: as it is shown."""

    spelling: str
    quantity: str
    factor: float
    offset: float = 0.0

    @property
    def words(self) -> str:
        """The conversion as it is shown with a result."""
        into = QUANTITIES[self.quantity]
        if self.offset:
            return f"{into} = {self.factor:.10g} {self.spelling} {self.offset:+.10g}"
        once = "" if self.spelling[0].isdigit() else "1 "
        return f"{once}{self.spelling} = {self.factor:.10g} {into}"


_FACTORS: dict[str, dict[str, float]] = {
    "length": {
        "mm": 1.0,
        "m": 1e3,
        "cm": 10.0,
        "µm": 1e-3,
        "nm": 1e-6,
        "1/100 mm": 0.01,
        "in": INCH,
        "ft": 12.0 * INCH,
        "thou": 1e-3 * INCH,
    },
    "angle": {
        "rad": 1.0,
        "mrad": 1e-3,
        "µrad": 1e-6,
        "°": pi / 180.0,
        "arcmin": pi / 10800.0,
        "arcsec": pi / 648000.0,
        "gon": pi / 200.0,
    },
    "force": {
        "N": 1.0,
        "mN": 1e-3,
        "µN": 1e-6,
        "daN": 10.0,
        "kN": 1e3,
        "kgf": GRAVITY,
        "gf": 1e-3 * GRAVITY,
        "lbf": LBF,
        "ozf": LBF / 16.0,
        "kip": 1e3 * LBF,
    },
    "moment": {
        "N·mm": 1.0,
        "N·cm": 10.0,
        "N·m": 1e3,
        "mN·m": 1.0,
        "kN·m": 1e6,
        "kgf·m": 1e3 * GRAVITY,
        "kgf·cm": 10.0 * GRAVITY,
        "kgf·mm": GRAVITY,
        "lbf·in": LBF * INCH,
        "lbf·ft": LBF * 12.0 * INCH,
        "ozf·in": LBF / 16.0 * INCH,
    },
    "time": {"s": 1.0, "ms": 1e-3, "min": 60.0, "h": 3600.0},
}
UNITS: dict[str, Unit] = {
    **{name: Unit(name, what, factor) for what, every in _FACTORS.items() for name, factor in every.items()},
    "°C": Unit("°C", "temperature", 1.0),
    "K": Unit("K", "temperature", 1.0, -273.15),
    "°F": Unit("°F", "temperature", 5.0 / 9.0, -160.0 / 9.0),
}
"""By the spelling that is shown."""

_ALSO = {
    "um": "µm",
    "μm": "µm",
    "1/1000·mm": "µm",
    "1/1000mm": "µm",
    "micron": "µm",
    "microns": "µm",
    "1/100·mm": "1/100 mm",
    "1/100mm": "1/100 mm",
    "mm/100": "1/100 mm",
    "0·01·mm": "1/100 mm",
    "0·01mm": "1/100 mm",
    "0,01·mm": "1/100 mm",
    "0,01mm": "1/100 mm",
    "inch": "in",
    "inches": "in",
    "μrad": "µrad",
    "urad": "µrad",
    "deg": "°",
    "degree": "°",
    "degrees": "°",
    "'": "arcmin",
    "′": "arcmin",
    "″": "arcsec",
    "μN": "µN",
    "uN": "µN",
    "kp": "kgf",
    "kip": "kip",
    "Nmm": "N·mm",
    "Ncm": "N·cm",
    "Nm": "N·m",
    "mNm": "mN·m",
    "kNm": "kN·m",
    "kpm": "kgf·m",
    "kgfm": "kgf·m",
    "kgfcm": "kgf·cm",
    "kgfmm": "kgf·mm",
    "in·lbf": "lbf·in",
    "in·lb": "lbf·in",
    "lb·in": "lbf·in",
    "ft·lbf": "lbf·ft",
    "ft·lb": "lbf·ft",
    "lb·ft": "lbf·ft",
    "in·ozf": "ozf·in",
    "oz·in": "ozf·in",
    "in·oz": "ozf·in",
    "degC": "°C",
    "degF": "°F",
    "sec": "s",
    "seconds": "s",
    "msec": "ms",
    "hours": "h",
}

QUESTIONS: dict[str, tuple[str, tuple[str, ...]]] = {
    "grad": ("a degree (write deg) or a gon (write gon)?", ("°", "gon")),
    "Grad": ("a degree (write deg) or a gon (write gon)?", ("°", "gon")),
    '"': ("an inch (write in) or a second of arc (write arcsec)?", ("in", "arcsec")),
    "F": ("a degree Fahrenheit? Then write degF", ("°F",)),
    "C": ("a degree Celsius? Then write degC", ("°C",)),
    "M": ("a metre? Then write m", ("m",)),
    "kg": ("a mass; is the force meant that it weighs? Then write kgf", ("kgf",)),
    "g": ("a mass; is the force meant that it weighs? Then write gf", ("gf",)),
    "lb": ("a mass; is the force meant that it weighs? Then write lbf", ("lbf",)),
    "lbs": ("a mass; is the force meant that it weighs? Then write lbf", ("lbf",)),
    "oz": ("a mass; is the force meant that it weighs? Then write ozf", ("ozf",)),
    "mil": ("a thousandth of an inch (write thou) or a millimetre (write mm)?", ("thou", "mm")),
    "MN": ("a meganewton, which no bench has; is a millinewton meant? Then write mN", ("mN",)),
    "Mm": ("a megametre; is a millimetre meant? Then write mm", ("mm",)),
    "NM": ("a newton metre? Then write Nm", ("N·m",)),
    "KN": ("a kilonewton? Then write kN", ("kN",)),
    "MM": ("a millimetre? Then write mm", ("mm",)),
}
"""Spellings that mean more than one thing, or nothing: what to ask, and the units that may be meant."""


def meant(spelling: str) -> tuple[str, ...] | None:
    """Units that a spelling may mean; None for one that is no unit at all."""
    name = spelled(spelling)
    if name in UNITS:
        return (name,)
    return QUESTIONS[name][1] if name in QUESTIONS else None


class NoUnit(ValueError):
    """A spelling that is in no list; the message says why, and what to write."""


def unit(spelling: str, quantity: str | None = None) -> Unit:
    """The unit of this spelling. NoUnit for one that is unknown, means two things, or is of another quantity."""
    name = spelled(spelling)
    found = UNITS.get(name)
    if found is None:
        if name in QUESTIONS:
            raise NoUnit(f"{spelling.strip()} is {QUESTIONS[name][0]}")
        allowed = [u for u, it in UNITS.items() if quantity in (None, it.quantity)]
        raise NoUnit(f"{spelling.strip()!r} is no unit that is known, allowed are {', '.join(allowed)}")
    if quantity is not None and found.quantity != quantity:
        article = "an" if found.quantity == "angle" else "a"
        allowed = [u for u, it in UNITS.items() if it.quantity == quantity]
        raise NoUnit(
            f"{spelling.strip()} is {article} {found.quantity}, this is "
            f"{'an' if quantity == 'angle' else 'a'} {quantity}; allowed are {', '.join(allowed)}"
        )
    return found


def spelled(spelling: str) -> str:
    """The spelling that is shown of one that may be another way to write it; itself where there is none."""
    text = spelling.strip().strip("()[]").strip()
    text = "".join("·" if c in "*.⋅-– " else c for c in " ".join(text.split())) if len(text) > 2 else text
    while "··" in text:
        text = text.replace("··", "·")
    return text if text in UNITS else _ALSO.get(text, text)
