"""What was discovered, as a record: for JSON, terminal, pages and effect files. Units N, mm, rad."""

from __future__ import annotations

from pipeline.answer import ModelError, SetAside, Value
from pipeline.record import Record


class Tie(Record):
    """A form that explains as much as the chosen one."""

    form: str
    """Its name."""
    equation: str
    """y of x, in the units of its parameters."""
    parameters: dict[str, float]
    """Its numbers, each in its unit."""
    cost: float
    """Chi-square and k ln n, k numbers and n residuals, less those of the chosen form."""
    beyond: float
    """Sigmas by which it foretells otherwise at 1.5 times the loads, at the load step that shows the site best."""


class Grouped(Record):
    """A site that the tests do not tell from the one that is named."""

    site: str
    """Its name."""
    evidence: float
    """ln evidence less that of the named site."""


class Curve(Record):
    """A law over its coordinate. Where it remembers, points go from rest to one end, to the other and back."""

    x_unit: str
    """Unit of the coordinate, empty for a column of the table."""
    y_unit: str
    """Unit of what the law says, empty for a column of the table."""
    x: tuple[float, ...]
    """Coordinates of the chosen form, none where there is no form."""
    y: tuple[float, ...]
    """The chosen form there."""
    free_x: tuple[float, ...]
    """Coordinates of the function without a form."""
    free: tuple[float, ...]
    """That function there."""
    low: tuple[float, ...]
    """Lower end of its 95 % band."""
    high: tuple[float, ...]
    """Upper end of its 95 % band."""
    own_x: tuple[float, ...]
    """Coordinates of single load steps."""
    own_y: tuple[float, ...]
    """What each of these load steps says by itself."""


class LawFound(Record):
    """A law that was found at a site."""

    site: str
    """Kind of place, and after @ the tags of the parts that have it."""
    where: str
    """The site in words."""
    group: tuple[Grouped, ...]
    """Sites that the tests do not tell from it."""
    form: str | None
    """Name of the form; None where none was put in the mechanism."""
    equation: str | None
    """y of x."""
    parameters: dict[str, Value]
    """Numbers of the form by name."""
    evidence: float
    """ln of how much more probable the residuals are with one function at the site than without."""
    margin: float | None
    """Evidence above the best site outside the group; None where there is none."""
    left_out: float
    """Chi-square that tests gain when they are left out one by one, without the best of them."""
    ties: tuple[Tie, ...]
    """Forms that explain as much."""
    range: tuple[float, float]
    """Least and greatest coordinate that was met."""
    fit: float | None
    """Whitened RMS of the fitted tests with this law and those before it."""
    holdout: float | None
    """That of the tests that were held out."""
    shape: str
    """What the function without a form is like, in words."""
    mirrored: bool = False
    """Whether it acts on the coordinate of the other sign at the tips of the bars."""
    curve: Curve | None = None
    """The law over its coordinate."""


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
    next_site: str | None
    """Site that would come next."""
    next_evidence: float
    """Its ln evidence."""
    set_aside: tuple[SetAside, ...] = ()
    """Single bad readings that were left out."""
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
