"""Forces and stresses in sentences, in the unit that suits their size."""

# Unit and its size in N, the largest first; below the last one numbers stand in it.
FORCES = (("MN", 1e6), ("kN", 1e3), ("N", 0.0))


def force(load: float | None) -> str:
    """A load in N, kN or MN with three digits; "no load" for None."""
    if load is None:
        return "no load"
    unit, size = next((unit, size) for unit, size in FORCES if abs(load) >= size)
    return f"{load / (size or 1.0):.3g} {unit}"


def stress(value: float | None) -> str:
    """A stress in MPa with three digits, or whole MPa; "no stress" for None."""
    if value is None:
        return "no stress"
    return f"{value:.0f} MPa" if value >= 1e3 else f"{value:.3g} MPa"
