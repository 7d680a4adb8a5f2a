"""Numbers and names as a reader sees them."""

from collections.abc import Sequence
from decimal import Decimal
from math import floor, isfinite, log10
from typing import Any

NEGLIGIBLE = 1e-3
"""Of the root of K_ii K_jj: an entry below that has no relative band of its own."""
MINUS = "\u2212"
NARROW_SPACE = "\u202f"
DASH = "\u2014"
SUBSCRIPTS = str.maketrans("0123456789", "₀₁₂₃₄₅₆₇₈₉")
SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")

ENTRIES = ("K11", "K22", "K26", "K33", "K35", "K44", "K55", "K66")
"""The entries that a bar symmetric about two planes has; by its symmetry the others are zero."""

UNITS = {"mm": "mm", "mm2": "mm²", "mm4": "mm⁴", "mm6": "mm⁶", "MPa": "MPa", "N": "N", "s": "s", "deg": "°"}
CELLS = {
    "hexahedron20": "20-node hexahedra",
    "hexahedron27": "27-node hexahedra",
    "tetra10": "10-node tetrahedra",
}
"""Cell types by meshio's names."""

SECTION_UNITS = {"area": "mm²", "Iy": "mm⁴", "Iz": "mm⁴", "J": "mm⁴", "Iw": "mm⁶"}


def number(value: float | None, digits: int = 5) -> str:
    """`digits` significant digits, groups of three from 10 000 on, a power of ten outside 1e-3 .. 1e9."""
    if value is None or not isfinite(value):
        return DASH
    if value == 0:
        return "0"
    rounded = float(f"{value:.{digits - 1}e}")
    exponent = floor(log10(abs(rounded)))
    sign = MINUS if rounded < 0 else ""
    if not -3 <= exponent < 9:
        mantissa = f"{abs(rounded) / 10.0**exponent:.{digits - 1}f}"
        return f"{sign}{mantissa}×10{str(exponent).translate(SUPERSCRIPTS)}"
    return sign + grouped(f"{Decimal(repr(abs(rounded))):.{max(0, digits - 1 - exponent)}f}")


def count(value: int) -> str:
    """A whole number, grouped."""
    return grouped(str(value))


def grouped(text: str) -> str:
    """Groups of three in the whole part, from five digits on."""
    whole, point, fraction = text.partition(".")
    if len(whole) > 4:
        whole = f"{int(whole):,}".replace(",", NARROW_SPACE)
    return whole + point + fraction


def trimmed(text: str) -> str:
    """A number without the zeros that end its decimals: what was given, not what was measured."""
    return text.rstrip("0").rstrip(".") if "." in text and "×" not in text else text


def fixed(value: float | None, decimals: int) -> str:
    """A fixed number of decimals."""
    if value is None or not isfinite(value):
        return DASH
    text = grouped(f"{abs(value):.{decimals}f}")
    return (MINUS if value < 0 and any(c in "123456789" for c in text) else "") + text


def percent(ratio: float | None, decimals: int = 2) -> str:
    """A relative deviation in percent, always signed unless it rounds to zero; the % stands in the header."""
    if ratio is None or not isfinite(ratio):
        return DASH
    text = fixed(100 * ratio, decimals)
    return f"+{text}" if ratio > 0 and any(c in "123456789" for c in text) else text


def symbol(entry: str) -> str:
    """K26 as K₂₆."""
    return entry[0] + entry[1:].translate(SUBSCRIPTS)


def named_entries(matrix: Any) -> dict[str, tuple[int, int]]:
    """Places of the entries of a (6, 6) on and above the diagonal that are not negligible, by name (K11, K26)."""
    scale = [abs(matrix[i][i]) ** 0.5 for i in range(6)]
    return {
        f"K{i + 1}{j + 1}": (i, j)
        for i in range(6)
        for j in range(i, 6)
        if abs(matrix[i][j]) > NEGLIGIBLE * scale[i] * scale[j]
    }


def entry_of(matrix: Sequence[Sequence[float]], entry: str) -> float:
    """The entry K26 of a 6x6, counted from 1 as the paper does."""
    return matrix[int(entry[1]) - 1][int(entry[2]) - 1]


def entry_unit(entry: str) -> str:
    """N/mm, N (per rad: a force per rotation, equally a moment per displacement) or N·mm/rad."""
    rotations = sum(index > "3" for index in entry[1:])
    return ("N/mm", "N", "N·mm")[rotations]


def held_label(held: Sequence[str]) -> str:
    """The held platform coordinates as one phrase."""
    return ", ".join(held) if held else "none"


def plain(key: str) -> str:
    """A key of result.json as words: underscores are spaces."""
    return key.replace("_", " ")


def name_and_unit(key: str) -> tuple[str, str]:
    """`flange_width_mm` as ("flange width", "mm"); a section constant has the unit its symbol implies."""
    stem, _, last = key.rpartition("_")
    if stem and last in UNITS:
        return plain(stem), UNITS[last]
    if key.startswith("shear_area"):
        return plain(key), "mm²"
    return plain(key), SECTION_UNITS.get(key, "")
