"""What every record in a result file is."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Self

from pydantic import BaseModel, ConfigDict, ValidationError

from pipeline.errors import InputError, unread
from pipeline.saving import put


class Record(BaseModel):
    """A part of a result; unknown keys and numbers that are not finite are refused."""

    model_config = ConfigDict(extra="forbid", frozen=True, allow_inf_nan=False)

    @classmethod
    def read(cls, path: Path, what: str) -> Self:
        """The record that a file holds. what: as it is called. InputError where it cannot be read or is none."""
        try:
            return cls.model_validate_json(path.read_bytes())
        except OSError as error:
            raise InputError(f"{path}: {unread(error)}") from error
        except ValidationError as error:
            first = error.errors()[0]
            place = ".".join(map(str, first["loc"])) or "the file"
            raise InputError(f"{path} is not a {what}: {place}: {first['msg']}") from error

    def text(self) -> str:
        """JSON; what is not finite is null."""
        return json.dumps(self.model_dump(mode="json"), indent=1, ensure_ascii=False, allow_nan=False) + "\n"

    def write(self, *paths: Path | None) -> None:
        """Write the JSON to those that are given, whole or not at all. InputError where nothing can be written."""
        for path in filter(None, paths):
            put(path, self.text())
