"""What was discovered, as a record: for JSON, terminal, pages and effect files. Units N, mm, rad."""

from __future__ import annotations

from pipeline.answer.law import LawFound
from pipeline.answer.record import FoundNoise, ModelError, SetAside
from pipeline.record import Record


class Entered(Record):
    """What is no law of a site by nature and explains as much as one: an effect that entered the model."""

    effect: str
    """Its name."""
    evidence: float
    """ln evidence, as of a site."""
    sites: tuple[str, ...]
    """Sites at which a law explains as much, the best first: these tests do not tell."""
    parameters: dict[str, float]
    """Its numbers in the last fit, each in its unit."""


class Discovered(Record):
    """What `discover` finds."""

    campaign: str
    """Name of the campaign."""
    laws: tuple[LawFound, ...]
    """In the order in which they were found."""
    geometry: bool
    """Whether the geometric nonlinearity of the bars entered the model first."""
    entered: tuple[Entered, ...]
    """Effects that entered the model as they explain as much as a law at any place."""
    error: tuple[ModelError, ...]
    """Of the model as it is, with the geometric nonlinearity where that entered, and with all that was found."""
    whole: bool
    """Whether nothing more is found in what is left."""
    left: tuple[str, ...] = ()
    """What of the rest is no noise, beside laws that were found, in the fitted tests and in those held out: then place
    or form may be another, or what is missing is no law of a single place. Empty where noise is left."""
    next_site: str | None
    """Site that would come next."""
    next_evidence: float
    """Its ln evidence."""
    set_aside: tuple[SetAside, ...] = ()
    """Single bad readings that were left out."""
    noise: tuple[FoundNoise, ...] = ()
    """Sensors whose noise is not as it was declared."""
    sentences: tuple[str, ...] = ()
    """All of it in words."""
    not_done: tuple[str, ...] = ()
    """Optional parts that failed, and why."""
    seconds: float = 0.0
    """Time that it took, s."""
    seed: int | None = None
    """As it was given; nothing here is random."""
    commit: str = ""
    """Commit of the program, empty outside a checkout."""
    versions: dict[str, str] = {}  # noqa: RUF012 (pydantic copies it)
    """Of the program and its libraries."""
    data: dict[str, str] = {}  # noqa: RUF012
    """SHA-256 of each file of the campaign."""
