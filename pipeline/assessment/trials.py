"""Many trials in processes of their own, each kept as soon as it is done, so that a study can be stopped."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterator, Mapping
from functools import partial
from pathlib import Path
from typing import Any, TypeVar

from pydantic import BaseModel, ValidationError

from pipeline.pools import pool

Trial = TypeVar("Trial", bound=BaseModel)


def run(
    wanted: Mapping[Hashable, tuple[Any, ...]],
    one: Callable[..., Trial],
    kind: type[Trial],
    key: Callable[[Trial], Hashable],
    store: Path,
    workers: int,
) -> Iterator[Trial]:
    """The trials that are wanted, those in the store first; the others are added to it as they are done.

    wanted: arguments of a trial by its key. one: makes a trial of them; a function of a module.
    """
    known = {key(each): each for each in kept(store, kind)}
    yield from (known[name] for name in wanted if name in known)
    missing = [task for name, task in wanted.items() if name not in known]
    if not missing:
        return
    store.parent.mkdir(parents=True, exist_ok=True)
    with store.open("a", encoding="utf-8") as file, pool(workers) as computed:
        for found in computed(partial(one, *task) for task in missing):
            file.write(found.model_dump_json() + "\n")
            file.flush()
            yield found


def kept(store: Path, kind: type[Trial]) -> list[Trial]:
    """The trials in a store; a line that was cut off in writing is passed over."""
    if not store.exists():
        return []
    found = []
    for line in store.read_text(encoding="utf-8").splitlines():
        try:
            found.append(kind.model_validate_json(line))
        except ValidationError:
            continue
    return found
