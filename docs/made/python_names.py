"""The public names of the package, for autodoc."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterator

import parastiff

_OPTIONS = {
    "class": ("autoclass", (":members:", ":inherited-members: BaseException, object")),
    "module": ("automodule", (":members:",)),
    "function": ("autofunction", ()),
}


def names() -> str:
    """A heading for each name of `parastiff.__all__` with what its docstring says."""
    return "\n".join("\n".join(_entry(name)) for name in parastiff.__all__)


def _entry(name: str) -> Iterator[str]:
    found = getattr(parastiff, name)
    kind = "module" if inspect.ismodule(found) else "class" if inspect.isclass(found) else "function"
    directive, options = _OPTIONS[kind]
    target = found.__name__ if kind == "module" else f"parastiff.{name}"
    yield f"## {name}\n\n```{{eval-rst}}\n.. {directive}:: {target}"
    yield from (f"   {option}" for option in options)
    yield "```\n"


PIECES: dict[str, Callable[[], str]] = {"public names": names}
