"""What was discovered, as a record: for JSON, terminal, pages and effect files. Units N, mm, rad."""

from __future__ import annotations

import json
from pathlib import Path

from meshes.files import replacing
from pipeline.answer import ModelError, SetAside, Value
from pipeline.errors import InputError
from pipeline.record import Record


class Tie(Record):
    """A form that explains as much. cost: chi-square and k ln n less those of the chosen form; beyond: sigmas by which
    it foretells otherwise at 1.5 times the loads."""

    form: str
    equation: str
    parameters: dict[str, float]
    cost: float
    beyond: float


class Grouped(Record):
    """A site that the tests do not tell from the one that is named. evidence: less that of the named one."""

    site: str
    evidence: float


class Curve(Record):
    """A law over its coordinate. x, y: points of the chosen form, in the units of the law. free: points of the curve
    without a form, low and high: its 95 % band. own_x, own_y: what single load steps say, each by itself, beside all
    the others."""

    x_unit: str
    y_unit: str
    x: tuple[float, ...]
    y: tuple[float, ...]
    free_x: tuple[float, ...]
    free: tuple[float, ...]
    low: tuple[float, ...]
    high: tuple[float, ...]
    own_x: tuple[float, ...]
    own_y: tuple[float, ...]


class LawFound(Record):
    """A law. site: best site, kind@tags. where: in words. group: sites that are not told from it. form, equation: None
    for a column of the table. evidence: ln of how much more probable the residuals are with a function there. margin:
    above what is outside the group, None where there is nothing. left_out: chi-square that left-out tests gain. ties:
    forms as good. range: of the coordinate that was met. fit, holdout: whitened RMS with this law and those before it.
    shape: what the free curve is like, in words."""

    site: str
    where: str
    group: tuple[Grouped, ...]
    form: str | None
    equation: str | None
    parameters: dict[str, Value]
    evidence: float
    margin: float | None
    left_out: float
    ties: tuple[Tie, ...]
    range: tuple[float, float]
    fit: float | None
    holdout: float | None
    shape: str
    mirrored: bool = False
    curve: Curve | None = None


class Entered(Record):
    """What is no law of a site by nature, and explains as much as one: an effect that entered the model, with its
    evidence."""

    effect: str
    evidence: float
    parameters: dict[str, float]


class Discovered(Record):
    """laws, entered: in the order in which they were found. error: of the model as it is, with the geometric
    nonlinearity of the bars where that entered (`geometry`), and with all that was found. whole: whether nothing more
    is found; next_site, next_evidence: what would come next. set_aside: single bad readings that were left out.
    """

    campaign: str
    laws: tuple[LawFound, ...]
    geometry: bool
    entered: tuple[Entered, ...]
    error: tuple[ModelError, ...]
    whole: bool
    next_site: str | None
    next_evidence: float
    set_aside: tuple[SetAside, ...] = ()
    sentences: tuple[str, ...] = ()
    not_done: tuple[str, ...] = ()
    seconds: float = 0.0
    seed: int | None = None
    commit: str = ""
    versions: dict[str, str] = {}  # noqa: RUF012 (pydantic copies it)
    data: dict[str, str] = {}  # noqa: RUF012

    def text(self) -> str:
        """JSON; what is not finite is null."""
        return json.dumps(self.model_dump(mode="json"), indent=1, ensure_ascii=False, allow_nan=False) + "\n"

    def write(self, path: Path) -> None:
        """Write the JSON whole or not at all. InputError where nothing can be written."""
        try:
            with replacing(path) as part:
                part.write_text(self.text(), encoding="utf-8")
        except OSError as error:
            raise InputError(f"{path} cannot be written: {error.strerror}") from error
