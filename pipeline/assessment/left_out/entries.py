"""What is hidden and left out of the catalogue, and which places are right for it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

_BASE = ("base_x", "base_y", "base_z", "base_rx", "base_ry", "base_rz")
_CELL = ("column fx_N", "column fy_N", "column fz_N", "column mx_Nmm", "column my_Nmm", "column mz_Nmm")


@dataclass(frozen=True)
class Entry:
    """An effect, or a part of one. parameters: of its size; all where none is given. kinds: of sites at which it is a
    law or a constant, none for what is no law of a place. why: in words. held_out: error that a law in its place keeps
    in tests held out."""

    effect: str
    kinds: tuple[str, ...]
    why: str
    parameters: tuple[str, ...] = ()
    held_out: float = 1.1

    @property
    def a_law(self) -> bool:
        """Whether there is a place at all."""
        return bool(self.kinds)


ENTRIES: Mapping[str, Entry] = {
    "axis, radial": Entry(
        "axis_flexibility", ("along", "across"), "the pins give in the plane", ("radial_mm_per_N",)
    ),
    "axis, tilt": Entry(
        "axis_flexibility", ("tilt_x", "tilt_z"), "the pins tilt at the ends of a bar", ("tilt_rad_per_Nmm",)
    ),
    "base": Entry("base_compliance", _BASE, "the base gives in six directions, any of which is one of it"),
    "contact": Entry("contact_stiffening", ("along", "across"), "a power of the load of a pin"),
    "clearance": Entry("joint_clearance", ("along", "across"), "a gap of a pin", held_out=1.2),
    "friction": Entry("joint_friction", ("hinge_torque",), "a torque of the hinges with memory"),
    "hinge spring": Entry("joint_torsional_stiffness", ("hinge_torque",), "a torque of the hinges"),
    "yield": Entry(
        "material_yield",
        ("along", "across", "out_of_plane", "tilt_x", "tilt_z"),
        "a bar that stays bent: at its ends, which is where it is seen",
        held_out=1.2,
    ),
    "mismatch": Entry("bar_length_mismatch", ("along",), "a constant along one bar"),
    "weight": Entry(
        "self_weight", (*_CELL, *_BASE), "constants of the load: of the cell, or through the base"
    ),
    "mounting": Entry(
        "mounting_tilt", ("base_rx", "base_ry", "base_rz", "tilt_x", "tilt_z"), "a constant turn of the base"
    ),
    "dimension": Entry(
        "dimension_error", ("along", "across", "base_x", "base_z"), "constants along the bars and across them"
    ),
    "modulus": Entry("modulus_error", (), "a factor of the bars"),
    "asymmetry": Entry("bar_stiffness_asymmetry", (), "a factor of one bar"),
    "bow": Entry("bar_initial_bow", (), "a shape of the bars"),
    "turned cell": Entry("load_misalignment", (), "the cell's own frame"),
    "offset of the load": Entry("load_offset", (), "the cell's own point"),
    "temperature": Entry("thermal_expansion", (), "follows the thermometer"),
}
"""Twelve that are laws or constants of a place, and six that are none by nature."""
