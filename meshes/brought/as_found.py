"""A mesh that came as it is: its unit, its ends, nothing refined."""

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from meshes.brought.child import Arrays
from meshes.brought.found import packed
from meshes.brought.raw import Raw
from meshes.brought.units import scale_of


def found_on_one_mesh(raw: Raw, asked: Mapping[str, Any]) -> tuple[dict[str, Any], Arrays]:
    """What the child returns; ValueError where the unit is not declared or a mesh size is."""
    if asked["unit"] is None:
        raise ValueError('has no unit of its own; write unit = "mm" (or cm, m, um, inch)')
    if asked["size"] is not None:
        raise ValueError("is a mesh already and is taken as it is; leave the mesh size out")
    told, arrays = packed([replace(raw, points=raw.points * scale_of(asked["unit"]))], asked)
    return {**told, "meshed": "as it came"}, arrays
