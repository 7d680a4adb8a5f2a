"""A study of many trials as a command: it goes on where it was stopped, and leaves a page of what it has."""

from collections.abc import Callable, Hashable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any, Generic, TypeVar

import typer

from pipeline.assessment import trials
from pipeline.provenance import code_digest, commit
from pipeline.record import Record

Task = tuple[Any, ...]


class Tried(Record):
    """A trial. commit, code: with which it was made."""

    commit: str
    code: str


Trial = TypeVar("Trial", bound=Tried)


@dataclass(frozen=True)
class Study(Generic[Trial]):
    """name: of its page. title: in words. of: what its trials are. count: by default, of what `counted` says. tasks: of
    a count, what each trial is asked for, in the order of the page. trial: makes one of a task, the commit and the
    digest of the code; a function of a module. kind: of trials. task: of a trial. right: whether one is as it should
    be. page: of trials in their order. beside: files of the page's folder by their names, of the same trials. folder:
    in reports, the name where it says none. store: file there in which trials are kept."""

    name: str
    title: str
    of: str
    count: int
    counted: str
    tasks: Callable[[int], Sequence[Task]]
    trial: Callable[..., Trial]
    kind: type[Trial]
    task: Callable[[Trial], Task]
    right: Callable[[Trial], bool]
    page: Callable[[Sequence[Trial]], str]
    beside: Callable[[Sequence[Trial]], Mapping[str, str | bytes]] = lambda _: {}
    folder: str = ""
    store: str = "trials.jsonl"

    def run(self, count: int, workers: int, store: Path, out: Path, quiet: bool = False) -> list[Trial]:
        """All its trials, those of this code in the store first; a page of those that are done is left in any case."""
        here, code, tasks = commit(), code_digest(), list(self.tasks(count))
        wanted: dict[Hashable, Task] = {(task, code): (*task, here, code) for task in tasks}
        order = {task: k for k, task in enumerate(tasks)}

        def said(done: list[Trial]) -> str:
            return f"{len(done)} of {len(wanted)} {self.of}, {sum(map(self.right, done))} as it should be"

        def leave(done: list[Trial]) -> None:
            ordered = sorted(done, key=lambda it: order[self.task(it)])
            trials.left(out, {f"{self.name}.md": self.page(ordered), **self.beside(ordered)})

        every = trials.run(wanted, self.trial, self.kind, lambda it: (self.task(it), it.code), store, workers)
        return trials.followed(self.title, every, said, leave, quiet)

    def command(self) -> None:
        """From the command line."""
        folder = Path("reports") / (self.folder or self.name)

        def main(
            count: Annotated[int, typer.Option(min=1, help=self.counted)] = self.count,
            workers: Annotated[int, typer.Option(min=1, help="Processes.")] = 2,
            store: Annotated[Path, typer.Option(help="Where finished trials are kept.")] = folder
            / self.store,
            out: Annotated[Path, typer.Option(help="Folder of the page.")] = folder,
            quiet: Annotated[bool, typer.Option("--quiet", help="No progress.")] = False,
        ) -> None:
            found = self.run(count, workers, store, out, quiet)
            print(f"{out / self.name}.md: {len(found)} {self.of}")

        main.__doc__ = f"{self.title.capitalize()}. Stopped and started again, it goes on."
        typer.run(main)
