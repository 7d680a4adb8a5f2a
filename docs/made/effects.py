"""The catalogue of effects as a page, and the picture of each signature beside it."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from html import escape
from pathlib import Path

from docs.made.allowed import short
from docs.made.lists import rows
from docs.made.pictures import drawn
from docs.made.signatures import shown, signature
from pipeline.toml.spelling import unknown_name
from vjm.effects import catalogue
from vjm.effects.base import Effect, Parameter
from vjm.effects.sensor_fault import SensorFault

FOLDER = "signatures"
"""Of the pictures, in the folder of static files."""


def names() -> str:
    """All effects with their titles."""
    lines = [
        (f"[`{name}`](#effect-{name})", it.title, "sensor" if isinstance(it, SensorFault) else "physics")
        for name, it in catalogue().items()
    ]
    return rows(("effect", "what it is", "kind"), lines)


def effects() -> str:
    """Every effect with all that it declares, and its picture."""
    return "\n".join("\n".join(_page(effect)) for effect in catalogue().values())


def _page(effect: Effect) -> Iterator[str]:
    title = effect.title[0].upper() + effect.title[1:]
    yield f"(effect-{effect.name})=\n\n## {title}\n\n`{effect.name}`\n"
    yield f"```text\n{effect.equation}\n```\n"
    yield f"{_sentence(effect.signature)}\n"
    if effect.parameters:
        head = ("parameter", "unit", "absent", "typical", "allowed", "meaning")
        yield rows(head, [_parameter(p) for p in effect.parameters])
    else:
        yield "It has no parameter: it is there or not.\n"
    yield _picture(effect)
    yield f"Limits\n: {_sentence(effect.limits)}\n"
    yield f"Rigs\n: {', '.join(effect.kinds)}\n"
    if effect.includes:
        yield f"With\n: {', '.join(f'[`{name}`](#effect-{name})' for name in effect.includes)}\n"
    yield f"Source\n: {_sentence(effect.source)}\n"


def _parameter(p: Parameter) -> tuple[str, ...]:
    typical, bounds = _number(p.null + p.typical), f"{short(p.low)} to {short(p.high)}"
    return f"`{p.name}`", p.unit, short(p.null), typical, bounds, _escaped(p.meaning)


def _number(value: float) -> str:
    return short(float(f"{value:.4g}"))


def _picture(effect: Effect) -> str:
    it = shown(effect)
    sizes = ", ".join(f"{p.name} = {_number(p.null + p.typical)} {p.unit}" for p in it.parameters)
    said = f"What {it.name} does to the readings{f' at {sizes}' if sizes else ''}"
    source = f"../_static/{FOLDER}/{effect.name}.png"
    return (
        f'<figure class="signature"><img src="{source}" loading="lazy" alt="{escape(said)}">'
        f"<figcaption>{escape(said)}.</figcaption></figure>\n"
    )


def _sentence(text: str) -> str:
    """As a sentence of Markdown."""
    said = _escaped(text[0].upper() + text[1:])
    return said if said.endswith(".") else f"{said}."


def _escaped(text: str) -> str:
    return text.replace("*", r"\*").replace("_", r"\_").replace("<", "&lt;").replace("|", r"\|")


def draw(folder: Path, only: str | None = None) -> None:
    """The pictures of all effects, or of one, into a folder. KeyError for a name that is none."""
    known = catalogue()
    if only is not None and only not in known:
        raise KeyError(unknown_name(only, known))
    folder.mkdir(parents=True, exist_ok=True)
    for name, effect in known.items():
        if only in (None, name):
            (folder / f"{name}.png").write_bytes(drawn(signature(effect)))


PIECES: dict[str, Callable[[], str]] = {"names of effects": names, "effects": effects}
