"""A rig with other values than the campaign's, as a test or a table of load cases asks for them."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from pydantic import ValidationError

from pipeline.campaign.rig import Rig
from pipeline.campaign.rigs import KINDS
from pipeline.toml.fields import sentences


def value_keys(rig: Rig) -> tuple[str, ...]:
    """Keys of the rig's table in campaign.toml that are single numbers, with their units in their names."""
    fields = KINDS[rig.kind].model_fields
    there = rig.keys()
    return tuple(
        key for key in fields if key in there and (there[key] is None or isinstance(there[key], float | int))
    )


def varied(rig: Rig, values: Mapping[str, float], folder: Path | None) -> Rig:
    """The rig of a campaign with these values of its table. folder: of files that it names.

    ValueError, in one sentence, for values that it cannot have.
    """
    if not values:
        return rig
    table = KINDS[rig.kind]
    base = {"kind": rig.kind} | {key: value for key, value in rig.keys().items() if value is not None}
    try:
        return table.model_validate(table.merged(base, dict(values))).rig(folder)
    except ValidationError as error:
        said = "; ".join(text for _, text in sentences(error, table))
        raise ValueError(said) from error
