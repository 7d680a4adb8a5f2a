"""What every result can do: say itself in a few lines, show itself in a notebook, be drawn, tabled, saved, compared."""

from __future__ import annotations

from abc import ABC, abstractmethod
from base64 import b64encode
from io import StringIO
from pathlib import Path
from typing import TYPE_CHECKING

from rich.console import Console, RenderableType
from rich.text import Text

from meshes.files import replacing
from pipeline.command import usable
from pipeline.errors import InputError
from pipeline.face.equality import same
from pipeline.terminal import WIDTH

if TYPE_CHECKING:
    # Tables and pictures are loaded where one is asked for.
    from pandas import DataFrame

    from reports.first_screen.drawn import Picture

LARGEST = 600
"""Characters that `repr` stays below."""
MORE = "... print(it.text()) for all"


class Shown(ABC):
    """A result: `print` says it in a few lines, a notebook shows its first screen.

    Two are equal where they hold the same. Each can be pickled.
    """

    @property
    @abstractmethod
    def headline(self) -> str:
        """The result in one line of at most 80 characters."""

    @abstractmethod
    def tables(self) -> tuple[RenderableType, ...]:
        """What the terminal shows of it below the headline, the most important first."""

    @property
    def sentences(self) -> tuple[str, ...]:
        """All of it in words, the most important first."""
        return ()

    @property
    def verdict(self) -> str:
        """The verdict in one word, "" where there is none to give."""
        return ""

    @property
    def sure(self) -> tuple[str, ...]:
        """What is certain, a sentence each."""
        return ()

    @property
    def beyond(self) -> tuple[str, ...]:
        """What was found beyond the catalogue of effects, a sentence each."""
        return ()

    @property
    def following(self) -> tuple[str, ...]:
        """What is worth doing next, a sentence each."""
        return ()

    @abstractmethod
    def to_frame(self) -> DataFrame:
        """Its numbers as a pandas table, units in the names of columns or in a column."""

    @abstractmethod
    def json(self) -> str:
        """Its record as JSON text."""

    def save(self, path: str | Path) -> Path:
        """Write it whole or not at all; returns the path.

        The ending says what: .json the record, .csv the table of `to_frame`, .html the first screen, .png, .svg or .pdf
        the picture of `plot`. InputError for another ending, and where nothing can be written.
        """
        place = Path(path)
        write = _WRITERS.get(place.suffix.lower())
        if write is None:
            found = f"ends with {place.suffix!r}" if place.suffix else "has no ending"
            raise InputError(f"{place} {found}, allowed are {', '.join(_WRITERS)}")
        usable(place.parent, f"the folder of {place}")
        with replacing(place) as part:
            part.write_bytes(write(self, place.suffix.lower()))
        return place

    def text(self) -> str:
        """All that the terminal shows, in 80 columns."""
        return rendered(self.headline, *self.tables(), *self.sentences)

    def __repr__(self) -> str:
        first = self.tables()[:1]
        lines = [line.rstrip() for line in rendered(*first).splitlines()]
        out = self.headline
        for k, line in enumerate(lines):
            rest = len(MORE) + 1 if k + 1 < len(lines) else 0
            if len(out) + len(line) + 1 + rest >= LARGEST:
                return f"{out}\n{MORE}"
            out += f"\n{line}"
        return out

    __str__ = __repr__

    def _repr_html_(self) -> str:
        from reports.first_screen.page import Screen, screen

        frame = _labelled(self.to_frame())
        return screen(
            Screen(
                headline=self.sentences[0] if self.sentences else self.headline,
                verdict=self.verdict,
                sure=self.sure,
                beyond=self.beyond,
                following=self.following,
                columns=tuple(map(str, frame.columns)),
                rows=tuple(tuple(row) for row in frame.itertuples(index=False)),
                picture=self._picture(),
                picture_says=self.headline,
            )
        )

    def _picture(self) -> str:
        """A PNG in base64, "" for none."""
        return ""

    def __eq__(self, other: object) -> bool:
        return same(self, other)

    __hash__ = None  # type: ignore[assignment]


class Drawn(Shown):
    """A result that has a picture."""

    @abstractmethod
    def plot(self) -> Picture:
        """A matplotlib figure; nothing is shown and nothing written. A notebook draws it where it ends a cell."""

    def _picture(self) -> str:
        return b64encode(self.plot().png()).decode()


def rendered(*parts: RenderableType) -> str:
    """As a terminal of 80 columns shows it."""
    out = StringIO()
    console = Console(file=out, width=WIDTH, highlight=False, color_system=None)
    for part in parts:
        console.print(Text(part) if isinstance(part, str) else part)
    return out.getvalue()


def _json(it: Shown, _: str) -> bytes:
    return it.json().encode()


def _csv(it: Shown, _: str) -> bytes:
    return str(_labelled(it.to_frame()).to_csv(index=False)).encode()


def _labelled(frame: DataFrame) -> DataFrame:
    """With its index as a column, where that says something."""
    return frame if frame.index.name is None else frame.reset_index()


def _html(it: Shown, _: str) -> bytes:
    from reports.first_screen.page import document

    return document(it.headline, it._repr_html_()).encode()


def _picture(it: Shown, suffix: str) -> bytes:
    if not isinstance(it, Drawn):
        raise InputError(f"{type(it).__name__} has no picture, allowed are .json, .csv, .html")
    return it.plot().saved(suffix[1:])


_WRITERS = {
    ".json": _json,
    ".csv": _csv,
    ".html": _html,
    ".png": _picture,
    ".svg": _picture,
    ".pdf": _picture,
}
