"""A rig with other values than the campaign's, as a test or a table of load cases asks for them."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from types import UnionType
from typing import Annotated, Any, Union, get_args, get_origin

from pydantic import ValidationError

from pipeline.campaign.rig import Rig
from pipeline.campaign.rigs import KINDS
from pipeline.toml.fields import sentences


def value_keys(rig: Rig) -> tuple[str, ...]:
    """Keys of the rig's table in campaign.toml that are single numbers, with their units in their names."""
    there = rig.keys()
    return tuple(
        key
        for key, field in KINDS[rig.kind].model_fields.items()
        if key in there and _may_be_number(field.annotation)
    )


def _may_be_number(annotation: Any) -> bool:
    """Whether one of the types that a key allows is a number."""
    if get_origin(annotation) is Annotated:
        return _may_be_number(get_args(annotation)[0])
    if isinstance(annotation, UnionType) or get_origin(annotation) is Union:
        return any(map(_may_be_number, get_args(annotation)))
    return annotation is float


def varied(rig: Rig, values: Mapping[str, float], folder: Path | None) -> Rig:
    """The rig of a campaign with these values of its table. folder: of files that it names.

    ValueError, in one sentence, for values that it cannot have.
    """
    if not values:
        return rig
    table = KINDS[rig.kind]
    base = {"kind": rig.kind} | {key: value for key, value in rig.keys().items() if value is not None}
    try:
        made = table.model_validate(table.merged(base, dict(values))).rig(folder)
    except ValidationError as error:
        said = "; ".join(text for _, text in sentences(error, table))
        raise ValueError(said) from error
    # Numbers alone are varied, so that the bars are the same and what was computed of them holds: K_g and the bands.
    return made.of_the_bars(rig)
