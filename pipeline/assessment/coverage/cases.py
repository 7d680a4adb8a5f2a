"""What is hidden on the benches of the study: each effect at its typical size, alone and in pairs."""

from __future__ import annotations

from collections.abc import Sequence

from pipeline.parameter_names import path_of
from vjm.effects import catalogue

BASE = "bar_geometric_nonlinearity"
"""Always there on the virtual bench, so always in the model."""
PAIRS = (
    ("joint_friction", "self_weight"),
    ("joint_friction", "joint_torsional_stiffness"),
    ("modulus_error", "joint_torsional_stiffness"),
    ("modulus_error", "bar_stiffness_asymmetry"),
    ("bar_initial_bow", "bar_length_mismatch"),
    ("bar_initial_bow", "mounting_tilt"),
    ("load_misalignment", "load_offset"),
    ("load_misalignment", "mounting_tilt"),
    ("thermal_expansion", "dimension_error"),
    ("thermal_expansion", "bar_length_mismatch"),
    ("axis_flexibility", "load_offset"),
    ("contact_stiffening", "self_weight"),
    ("base_compliance", "joint_torsional_stiffness"),
    ("joint_clearance", "modulus_error"),
    ("joint_clearance", "joint_friction"),
)
"""Two at once: what a bench has together, and what acts on the same readings."""
BESIDE = 1.03
"""Of a typical size is hidden where fits begin on a ladder of such sizes: they shall not begin at the truth."""


def typical(names: Sequence[str]) -> dict[str, float]:
    """Every parameter of the effects, "effect.parameter", about a typical size from null; those that are no size at
    null."""
    values: dict[str, float] = {}
    for name in names:
        effect = catalogue()[name]
        for p in effect.parameters:
            size = is_size(name, p.name)
            share = BESIDE if p.one_sided and not effect.smooth else 1.0
            values[path_of(name, p.name)] = p.null + share * p.typical if size else p.null
    return values


def is_size(effect: str, parameter: str) -> bool:
    """Whether the parameter alone makes the effect present; a presliding angle does not."""
    it = catalogue()[effect]
    return not it.absent(it.nulls | {parameter: it.typicals[parameter]})
