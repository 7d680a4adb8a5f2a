"""What every record in a result file is."""

from pydantic import BaseModel, ConfigDict


class Record(BaseModel):
    """A part of a result; unknown keys are refused."""

    model_config = ConfigDict(extra="forbid", frozen=True)
