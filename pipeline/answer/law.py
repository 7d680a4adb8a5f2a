"""A law that was found at a place of the linkage, as a record. Units N, mm, rad."""

from __future__ import annotations

from pipeline.answer.value import Value
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
    effects: tuple[str, ...] = ()
    """Effects of the catalogue that are this law, or hold it."""
