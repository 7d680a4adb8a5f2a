"""Numbers with what is known of them as text: the same digits and the same words on every page, table and terminal.

A fitted value is written to the second digit of its standard error, its interval to the same place. Where the data set
no end there is no number: "not determined". All writers take a value and a count of significant digits.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from math import floor, isfinite, log10
from typing import Any, NamedTuple

Write = Callable[[float, int], str]

NONE = "–"
NOT_DETERMINED, FIXED, AT_BOUND = "not determined", "not fitted", "at its bound"
PLACES = 2
"""Digits of a standard error that count."""
UNKNOWN, MOST = 4, 8
"""Significant digits where no uncertainty is known, and at most."""
Z = 1.959964
"""Standard errors from a value to the end of its 95 % interval."""
WHOLE = 99_999.5
"""Up to here no digit before the point is rounded away."""
MANY = 10.0
"""Times from which a share is told as a factor."""
LEAST_SIGMA, LEAST_P, LEAST_PERCENT = 1e-3, 1e-6, 0.1
"""Below these only that it is below is said."""


class Estimate(NamedTuple):
    """A parameter as an answer has it: standard error and ends are None where the data set none.

    interval: "wald", "profile", "undetermined" or "fixed". at_bound: the fit ended at the parameter's bound.
    """

    value: float
    std: float | None = None
    low95: float | None = None
    high95: float | None = None
    interval: str = "wald"
    at_bound: bool = False


def estimate(record: Mapping[str, Any]) -> Estimate:
    """The parameter of a record `pipeline.answer.record.Value`, as JSON has it."""
    return Estimate(**{key: record[key] for key in Estimate._fields if key in record})


def plain(value: float, digits: int) -> str:
    """So many significant digits; 4.0e-6 below 1e-4 and from 1e6 on."""
    if not isfinite(value):
        return NONE
    mantissa, _, power = f"{value:.{digits - 1}e}".partition("e")
    exponent = int(power)
    if float(mantissa) == 0.0:
        return "0"
    if -4 <= exponent < 6:
        return f"{float(f'{mantissa}e{power}'):.{max(digits - 1 - exponent, 0)}f}"
    return f"{mantissa}e{exponent}"


def short(value: float | None, digits: int = 3) -> str:
    """A number of which no uncertainty is known: so many digits, all that stand before the point up to 1e5."""
    if value is None or not isfinite(value):
        return NONE
    return _trimmed(plain(value, _whole(value, digits)))


def number(value: float | None) -> str:
    """A size in three digits for a column of such, zeros at its end included."""
    return NONE if value is None else plain(value, _whole(value, 3))


def _whole(value: float, digits: int) -> int:
    """So many digits, or more where more stand before the point."""
    return max(digits, floor(log10(abs(value))) + 1) if 1.0 <= abs(value) < WHOLE else digits


def signed(value: float, std: float | None, most: int = 3) -> str:
    """To what the standard error allows, at most so many digits, always with its sign."""
    text = _to_place(value, _place(std), most, plain)
    return text if text.startswith("-") or text in ("0", NONE) else f"+{text}"


def sigma(value: float | None) -> str:
    """An error in sigmas: 0.978, 12.3, 289, 4533, 1.2e5."""
    if value is None or not isfinite(value):
        return NONE
    if 0.0 < abs(value) < LEAST_SIGMA:
        return f"< {LEAST_SIGMA:g}"
    size = abs(value)
    if size >= WHOLE:
        return f"{value:.1e}".replace("e+0", "e").replace("e+", "e")
    return plain(value, _whole(value, 3))


def percent(ratio: float | None) -> str:
    """A share in percent, without its sign: 18 %, 3.2 %, under 0.1 %."""
    if ratio is None or not isfinite(ratio):
        return f"{NONE} %"
    share = abs(100.0 * ratio)
    if 0.0 < share < LEAST_PERCENT:
        return f"under {LEAST_PERCENT:g} %"
    return f"{short(share, 2)} %"


def proportion(share: float) -> str:
    """By what share measurements exceed a model: 18 % more than the model says, 12.3 times what the model says."""
    if share < -1.0 or share > MANY:
        return f"{short(1.0 + share)} times what the model says"
    return f"{percent(share)} {'more' if share > 0.0 else 'less'} than the model says"


def p_value(p: float | None) -> str:
    """A probability: 0.23, 2e-5, < 1e-6."""
    if p is None or not isfinite(p):
        return NONE
    return "< 1e-6" if p < LEAST_P else _trimmed(plain(p, 2)) if p >= 1e-3 else plain(p, 1)


def p_is(p: float) -> str:
    """p with its sign of relation: p = 0.002, p < 1e-6."""
    return f"p {p_value(p)}" if p < LEAST_P else f"p = {p_value(p)}"


def value_text(it: Estimate, write: Write = plain) -> str:
    """The value to the digits that its uncertainty allows; a dash where the data say nothing of it."""
    if it.interval == "undetermined" and not it.at_bound:
        return NONE
    return _to_place(it.value, _place(_spread(it)), UNKNOWN, write)


def std_text(it: Estimate, write: Write = plain) -> str:
    """The standard error, two digits; a dash where there is none."""
    return NONE if _undone(it) or it.std is None or not isfinite(it.std) else write(it.std, PLACES)


def ends_text(it: Estimate, write: Write = plain) -> tuple[str, str]:
    """Both ends of the interval to the place of the value; a dash where the data set none."""
    if _undone(it):
        return NONE, NONE
    place = _place(_spread(it))
    low, high = (
        NONE if end is None or not isfinite(end) else _to_place(end, place, UNKNOWN, write)
        for end in (it.low95, it.high95)
    )
    return low, high


def interval_text(it: Estimate, write: Write = plain) -> str:
    """793.5 .. 815.3, above 793.5, below 815.3, "not fitted" or "not determined"."""
    if it.interval == "fixed":
        return FIXED
    low, high = ends_text(it, write)
    if low == high == NONE:
        return NOT_DETERMINED
    if NONE in (low, high):
        return f"below {high}" if low == NONE else f"above {low}"
    return f"{low} .. {high}"


def marks(it: Estimate) -> tuple[str, ...]:
    """What is to be said beside a value: at its bound, not determined, not fitted."""
    said = interval_text(it)
    return (*((AT_BOUND,) if it.at_bound else ()), *((said,) if said in (NOT_DETERMINED, FIXED) else ()))


def phrase(name: str, it: Estimate, unit: str, write: Write = plain) -> str:
    """torque_Nmm = 804.4 N·mm (95 %: 793.5 .. 815.3), or what is not known of it."""
    value, notes = value_text(it, write), list(marks(it))
    if value == NONE:
        return f"{name} {', '.join(notes)}"
    if (said := interval_text(it, write)) not in notes:
        notes.append(f"95 %: {said}")
    return f"{name} = {value}{'' if unit == '1' else f' {unit}'} ({', '.join(notes)})"


def _undone(it: Estimate) -> bool:
    return it.interval in ("undetermined", "fixed")


def _spread(it: Estimate) -> float | None:
    """A standard error: as given, else from what ends there are."""
    if _undone(it):
        return None
    if it.std is not None and isfinite(it.std) and it.std > 0.0:
        return it.std
    ways = [abs(end - it.value) for end in (it.low95, it.high95) if end is not None and isfinite(end)]
    return max(ways, default=0.0) / Z or None


def _place(std: float | None) -> int | None:
    """Power of ten of the last digit that counts."""
    return None if std is None or not isfinite(std) or std <= 0.0 else floor(log10(std)) - PLACES + 1


def _to_place(value: float, place: int | None, most: int, write: Write) -> str:
    """A number up to a place; where none is known, so many digits without zeros at its end."""
    if value == 0.0 or not isfinite(value):
        return "0" if value == 0.0 else NONE
    if place is None:
        return _trimmed(write(value, most))
    digits = floor(log10(abs(value))) - place + 1
    # Far below its own uncertainty: a digit would be one of noise.
    return "0" if digits < 0 else write(value, min(max(digits, 1), MOST if most == UNKNOWN else most))


def _trimmed(text: str) -> str:
    """Without zeros at the end of the decimals, before a power of ten too."""
    mantissa, power = text, ""
    for mark in ("e", "×"):
        if mark in text:
            mantissa, _, power = text.partition(mark)
            power = mark + power
    return (mantissa.rstrip("0").rstrip(".") if "." in mantissa else mantissa) + power
