"""A manipulator file: TOML in, a frozen manipulator and its home out; every complaint names file, line and key."""

from dataclasses import dataclass
from pathlib import Path
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray
from pydantic import BaseModel, ValidationError

from pipeline.errors import InputError
from pipeline.manipulator.tables import PARTS, LegTable, Top
from pipeline.toml.complaints import Complaints, shown
from pipeline.toml.fields import sentences
from pipeline.toml.lines import TomlLines, parsed
from pipeline.toml.spelling import unknown_name
from vjm.manipulator.parts import Manipulator
from vjm.manipulator.posture import postures
from vjm.parts import Leg, Part

SHIPPED = Path(__file__).parent / "shipped"
LARGEST = 1_000_000
"""Characters that a file may have."""

Model = TypeVar("Model", bound=BaseModel)
Place = tuple[str | int, ...]


@dataclass(frozen=True, eq=False)
class Description:
    """A manipulator, its home (6,): the platform pose that inverse kinematics reaches from the joints' homes, and
    the text that says so."""

    manipulator: Manipulator
    home: NDArray[np.float64]
    text: str


def read(path: Path | str) -> Description:
    """The manipulator in a file, or a shipped one by its name; InputError with every complaint about it."""
    file = Path(path)
    shipped = SHIPPED / f"{path}.toml"
    if not file.exists() and shipped.exists():
        file = shipped
    try:
        if file.stat().st_size > LARGEST:
            raise InputError(f"{file}: has more than {LARGEST} bytes, no manipulator needs as many")
        text = file.read_text(encoding="utf-8")
    except OSError as error:
        names = ", ".join(sorted(p.stem for p in SHIPPED.glob("*.toml")))
        raise InputError(f"{file}: {error.strerror or error}; shipped are {names}") from None
    except UnicodeDecodeError as error:
        raise InputError(
            f"{file}: is no UTF-8 text: byte {error.start} is {error.object[error.start]:#x}"
        ) from None
    return describe(text, str(path))


def describe(text: str, file: str) -> Description:
    """The manipulator in a TOML text, named `file` in complaints; InputError with every complaint."""
    reader = _Reader(text, Complaints(file))
    top = reader.checked(Top, reader.raw, (), "")
    reader.complaints.check()
    assert top is not None
    if top.schema_version != 1:
        reader.say(("schema",), "schema", f"is {top.schema_version}, allowed is 1")
    chains = {name: reader.chain(name, entries) for name, entries in top.chains.items()}
    legs = reader.legs(top.legs, chains)
    reader.complaints.check()
    manipulator = Manipulator(top.name, legs, top.length_mm, gravity=top.down)
    home = np.concatenate([top.home_mm, np.zeros(3)])
    reader.reaches(manipulator, home)
    reader.complaints.check()
    return Description(manipulator, home, text)


class _Reader:
    """Checks table after table, so that a mistake in one hides none in another."""

    def __init__(self, text: str, complaints: Complaints) -> None:
        self.complaints = complaints
        self.lines = TomlLines(text.replace("\r\n", "\n"))
        try:
            self.raw: dict[str, Any] = parsed(text)
        except ValueError as error:
            complaints.add("", f"is no TOML: {error}")
            complaints.check()

    def say(self, path: Place, place: str, said: str) -> None:
        self.complaints.add(place, said, self.lines.of(*path))

    def checked(self, model: type[Model], raw: dict[str, Any], path: Place, place: str) -> Model | None:
        try:
            return model.model_validate(raw)
        except ValidationError as error:
            for loc, said in sentences(error, model):
                key = ".".join(str(step) for step in loc)
                self.say((*path, *loc), ", ".join(filter(None, [place, key])), said)
        return None

    def chain(self, name: str, entries: list[dict[str, Any]]) -> tuple[Part, ...]:
        """The parts of a chain that can be used."""
        parts = []
        for number, entry in enumerate(entries):
            path: Place = (f"chains.{name}", number)
            place = f"chain {shown(name)}, part {number + 1}"
            kind = entry.get("part")
            if not isinstance(kind, str) or kind not in PARTS:
                known = list(PARTS)
                said = "is missing" if kind is None else f"is {shown(kind)}, {unknown_name(str(kind), known)}"
                self.say((*path, "part"), f"{place}, part", said)
                continue
            table = self.checked(PARTS[kind], entry, path, place)
            if table is not None:
                parts.append(table.made())
        if not entries:
            self.say(("chains", name), f"chain {shown(name)}", "has no part, allowed are one or more")
        return tuple(parts)

    def legs(self, entries: list[dict[str, Any]], chains: dict[str, tuple[Part, ...]]) -> tuple[Leg, ...]:
        legs: list[Leg] = []
        names: set[str] = set()
        for number, entry in enumerate(entries):
            path: Place = ("legs", number)
            name = entry.get("name")
            place = f"leg {shown(name)}" if isinstance(name, str) else f"legs.{number}"
            table = self.checked(LegTable, entry, path, place)
            if table is None:
                continue
            if table.name in names:
                self.say((*path, "name"), place, "is there twice, allowed is each name once")
            elif table.chain not in chains:
                said = f"is {shown(table.chain)}, {unknown_name(table.chain, list(chains))}"
                self.say((*path, "chain"), f"{place}, chain", said)
            else:
                try:
                    legs.append(Leg(table.name, (table.begin(), *chains[table.chain], table.end())))
                except ValueError as error:
                    self.say(path, place, str(error).partition(": ")[2])
            names.add(table.name)
        return tuple(legs)

    def reaches(self, manipulator: Manipulator, home: NDArray[np.float64]) -> None:
        """Complains of a leg that cannot be put together at home."""
        for number, leg in enumerate(manipulator.legs):
            alone = postures(Manipulator(leg.name, (leg,), manipulator.length), home)
            if not alone.reached:
                said = f"cannot be put together with the platform at home_mm = {home[:3].tolist()}: {alone.reason}"
                self.say(("legs", number), f"leg {shown(leg.name)}", said)
