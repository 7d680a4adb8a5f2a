"""What every record in a result file is."""

from pydantic import BaseModel, ConfigDict


class Record(BaseModel):
    """A part of a result; unknown keys and numbers that are not finite are refused."""

    model_config = ConfigDict(extra="forbid", frozen=True, allow_inf_nan=False)
