"""Units of length that a file may be in, as millimetres."""

UNITS = {"mm": 1.0, "cm": 10.0, "m": 1000.0, "um": 1e-3, "inch": 25.4}


def scale_of(unit: str) -> float:
    """Millimetres of one unit; ValueError for an unknown one."""
    if unit not in UNITS:
        raise ValueError(f"unit is {unit!r}, allowed are {', '.join(UNITS)}")
    return UNITS[unit]
