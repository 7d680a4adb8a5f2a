"""What else a hidden law is called: the form that is the same law, and the effects of the catalogue that are it."""

from __future__ import annotations

from collections.abc import Mapping

FORMS: Mapping[str, tuple[str, ...]] = {
    "Cubic": ("cubic", "linear+cubic"),
    "OddPolynomial": ("linear+cubic", "cubic"),
    "EvenPart": ("linear+square", "square+cubic", "square"),
    "Tanh": ("tanh", "linear+tanh"),
    "Atan": ("atan", "linear+atan"),
    "DeadZone": ("dead_zone", "gap", "linear+dead_zone", "two_zones", "linear+two_zones"),
    "TwoSlopes": ("two_slopes",),
    "Power": ("power", "linear+power"),
    "Exponential": ("exponential",),
    "Progressive": ("progressive",),
    "Coulomb": ("coulomb",),
    "CoulombTwoLevels": ("two_level",),
    "CoulombByLoad": ("friction_by_load", "slip_by_load"),
    "Iwan": ("iwan",),
    "LinearAndCoulomb": ("linear+coulomb", "slip"),
    "LinearAndCubic": ("linear+cubic",),
    "Creep": ("creep", "creep_in_series"),
    "Periodic": ("periodic", "linear+periodic"),
    "PreloadedLinear": ("linear+constant", "two_slopes"),
    "Linear": ("linear",),
}
"""Forms that are a law of the frame, or hold it as a special case, by its class; none of a law outside the grammar."""

_EFFECTS: Mapping[tuple[str, str], tuple[str, ...]] = {
    ("Linear", "hinge_torque"): ("joint_torsional_stiffness",),
    ("Coulomb", "hinge_torque"): ("joint_friction",),
    ("LinearAndCoulomb", "hinge_torque"): ("joint_friction", "joint_torsional_stiffness"),
    ("Linear", "along"): ("axis_flexibility",),
    ("Linear", "tilt_x"): ("axis_flexibility",),
    ("Linear", "tilt_z"): ("axis_flexibility",),
    ("Power", "along"): ("contact_stiffening",),
    ("DeadZone", "along"): ("joint_clearance",),
    ("Linear", "base"): ("base_compliance",),
    ("PreloadedLinear", "base"): ("base_compliance",),
}


def same_physics(law: str, site: str) -> tuple[str, ...]:
    """Effects of the catalogue that say of a law at a site what it is, all its parts alike or not."""
    kind = site.partition("@")[0]
    kind = "base" if kind.startswith("base_") else kind
    return _EFFECTS.get((law, kind), ())
