"""Manipulators without a parallelogram: elastic links between hinges, and a machine that gives in its drives alone."""

from __future__ import annotations

_BEAM = (
    "beam = { EA_N = 1.2370021e9, EIy_Nmm2 = 1.7395342e12, EIz_Nmm2 = 1.7395342e12, GJ_Nmm2 = 1.2673749e12 }"
)
_TRIPTERON_ARM = f"""
[[chains.arm]]
part = "actuator"
kind = "translation"
axis = "z"
stiffness_N_per_mm = 1000.0
limits_mm = [-500.0, 500.0]
[[chains.arm]]
part = "passive"
kind = "rotation"
axis = "z"
home_deg = 45.0
[[chains.arm]]
part = "link"
length_mm = 1000.0
{_BEAM}
[[chains.arm]]
part = "passive"
kind = "rotation"
axis = "z"
home_deg = -80.0
[[chains.arm]]
part = "link"
length_mm = 1000.0
{_BEAM}
[[chains.arm]]
part = "passive"
kind = "rotation"
axis = "z"
home_deg = 40.0
"""
_PRS_ARM = """
[[chains.arm]]
part = "actuator"
kind = "translation"
axis = "z"
stiffness_N_per_mm = 1000.0
[[chains.arm]]
part = "passive"
kind = "rotation"
axis = "y"
home_deg = -50.0
[[chains.arm]]
part = "rigid"
to_mm = [300.0, 0.0, 0.0]
[[chains.arm]]
part = "passive"
kind = "rotation"
axis = "x"
[[chains.arm]]
part = "passive"
kind = "rotation"
axis = "y"
home_deg = 50.0
[[chains.arm]]
part = "passive"
kind = "rotation"
axis = "z"
"""


def _leg(name: str, at: str, x_axis: str, y_axis: str, ends: str = "[0.0, 0.0, 0.0]") -> str:
    placed = f"at_mm = {at}\nx_axis = {x_axis}\ny_axis = {y_axis}\nends_at_mm = {ends}\n"
    return f'[[legs]]\nname = "{name}"\nchain = "arm"\n{placed}'


def _head(name: str, length: float, home: str) -> str:
    return f'schema = 1\nname = "{name}"\nlength_mm = {length}\nhome_mm = {home}\n'


_FAR = -1414.2135623731
TRIPTERON = "".join(
    [
        _head("Tripteron", 1000.0, "[0.0, 0.0, 0.0]"),
        _TRIPTERON_ARM,
        _leg("z", f"[{_FAR}, 0.0, 0.0]", "[1.0, 0.0, 0.0]", "[0.0, 1.0, 0.0]"),
        _leg("x", f"[0.0, {_FAR}, 0.0]", "[0.0, 1.0, 0.0]", "[0.0, 0.0, 1.0]"),
        _leg("y", f"[0.0, 0.0, {_FAR}]", "[0.0, 0.0, 1.0]", "[1.0, 0.0, 0.0]"),
    ]
)
"""Three legs, each a drive along its own axis and two links between three hinges about that axis."""

_C, _S = -0.5, 0.8660254037844386
PRS = "".join(
    [
        _head("3-PRS", 500.0, "[0.0, 0.0, 400.0]"),
        _PRS_ARM,
        _leg("a", "[-300.0, 0.0, 0.0]", "[1.0, 0.0, 0.0]", "[0.0, 1.0, 0.0]", "[-100.0, 0.0, 0.0]"),
        _leg(
            "b",
            f"[150.0, {-300 * _S}, 0.0]",
            f"[{_C}, {_S}, 0.0]",
            f"[{-_S}, {_C}, 0.0]",
            f"[50.0, {-100 * _S}, 0.0]",
        ),
        _leg(
            "c",
            f"[150.0, {300 * _S}, 0.0]",
            f"[{_C}, {-_S}, 0.0]",
            f"[{_S}, {_C}, 0.0]",
            f"[50.0, {100 * _S}, 0.0]",
        ),
    ]
)
"""Three legs of a vertical drive, a hinge, a rigid link and a ball: 1000 N/mm along each drive, and nothing else."""
