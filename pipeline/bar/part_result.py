"""The result of `run` for a bar that comes as a file: the bar's record, and the parallelogram of two such bars."""

from __future__ import annotations

from typing import Literal

from pipeline.bar.record import BarRecord
from pipeline.record import Record
from pipeline.validation.result import Critical, Curve, Parallelogram, Refinement, Validity


class PartResult(Record):
    """Everything that was found. Units, frames and signs as in `pipeline.validation.result`."""

    schema_version: Literal[1] = 1
    kind: Literal["part"] = "part"
    case: str
    title: str
    detail: str
    """coarse: the linkage on the coarser of the bar's meshes; default: on the finer one, load paths on the coarser."""
    length_mm: float
    width_mm: float
    bar: BarRecord
    parallelogram: list[Parallelogram]
    """K_p; `worst_fea_deviation` is that of the solid to Eq. 11."""
    critical: list[Critical]
    curves: list[Curve]
    validity: list[Validity]
    refinement: list[Refinement]
    agreement: list[str]
    left_out: list[str]
    """What could not be had for this bar, and why."""
    warnings: list[str]
    """Where two models of this run are farther apart than their stated band, a sentence each."""
    yield_MPa: float | None
    story: list[str]
    seconds: dict[str, float]
    versions: dict[str, str]
    commit: str
    command: str
    sources: list[str]
