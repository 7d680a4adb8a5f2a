"""The catalogue of effects as a result."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

from rich.console import RenderableType

from pipeline.effects_page import headline, page, table
from pipeline.errors import InputError
from pipeline.face.shown import Shown, rendered
from pipeline.toml.spelling import unknown_name
from vjm.effects import catalogue as shipped_effects
from vjm.effects.base import Effect

if TYPE_CHECKING:
    from pandas import DataFrame


@dataclass(frozen=True, eq=False, repr=False)
class Catalogue(Shown, Mapping[str, Effect]):
    """Effects by name. effects: each says its equation, its parameters with units, what it looks like, its source."""

    effects: Mapping[str, Effect]

    def __getitem__(self, name: str) -> Effect:
        return self.effects[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self.effects)

    def __len__(self) -> int:
        return len(self.effects)

    @property
    def headline(self) -> str:
        return headline(self.effects)

    def tables(self) -> tuple[RenderableType, ...]:
        return (table(self.effects),)

    def page(self, name: str) -> str:
        """Everything that an effect declares, in 80 columns. InputError for a name that is unknown."""
        if name not in self.effects:
            raise InputError(f"effect {name!r} is unknown, {unknown_name(name, self.effects)}")
        return rendered(page(self.effects[name]))

    def to_frame(self) -> DataFrame:
        """One row a parameter: effect, title, parameter, unit, absent, typical, low, high, meaning, equation,
        source."""
        from pandas import DataFrame

        columns = ["effect", "title", "parameter", "unit", "absent", "typical", "low", "high", "meaning"]
        return DataFrame(list(self._rows()), columns=[*columns, "equation", "source"])

    def json(self) -> str:
        return str(self.to_frame().to_json(orient="records", indent=1, force_ascii=False)) + "\n"

    def _rows(self) -> Iterator[tuple[object, ...]]:
        for name, it in self.items():
            for p in it.parameters:
                numbers = (p.null, p.null + p.typical, p.low, p.high)
                yield name, it.title, p.name, p.unit, *numbers, p.meaning, it.equation, it.source
            if not it.parameters:
                yield name, it.title, "", "", None, None, None, None, "there or not", it.equation, it.source


def catalogue() -> Catalogue:
    """All effects that ship, by name: equation, parameters with units, what each looks like in data, source."""
    return Catalogue(shipped_effects())
