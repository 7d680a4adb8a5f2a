"""Names of parameters: the effect, a dot, the parameter."""

from __future__ import annotations


def path_of(effect: str, parameter: str) -> str:
    """The name of a parameter of an effect, as model files, answers and options write it."""
    return f"{effect}.{parameter}"


def parted(path: str) -> tuple[str, str]:
    """Effect and parameter of a name, the parameter empty where there is none.

    The last dot parts them: an effect may be named with the part that it acts on, which has dots of its own, as in
    `axis_flexibility@y.foot.radial_mm_per_N`.
    """
    effect, dot, parameter = path.rpartition(".")
    return (effect, parameter) if dot else (path, "")
