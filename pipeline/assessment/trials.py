"""Many trials in processes of their own, each kept as soon as it is done, so that a study can be stopped and leaves the
page of what it has."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable, Iterator, Mapping
from functools import partial
from pathlib import Path
from typing import Any, TypeVar

from pydantic import BaseModel, ValidationError

from meshes.files import replacing
from pipeline.pools import pool
from pipeline.progress import Progress

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


def followed(
    title: str,
    every: Iterable[Trial],
    said: Callable[[list[Trial]], str],
    leave: Callable[[list[Trial]], None],
    quiet: bool = False,
) -> list[Trial]:
    """All trials of a study, with its progress in words of those that are done. leave: writes what these show, also
    where the study is stopped."""
    found: list[Trial] = []
    try:
        with Progress(quiet).stage(title) as stage:
            for it in every:
                found.append(it)
                stage.say(said(found))
    finally:
        if found:
            leave(found)
    return found


def left(out: Path, files: Mapping[str, str | bytes]) -> None:
    """Writes files of a folder by their names, each whole or not at all."""
    for name, content in files.items():
        with replacing(out / name) as part:
            part.write_bytes(content if isinstance(content, bytes) else content.encode())


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
