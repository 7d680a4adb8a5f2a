"""What a run is doing: one line a stage with its time on a terminal, nothing where nobody watches."""

import logging
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from time import perf_counter

from rich.console import Console
from rich.status import Status

LOG = logging.getLogger(__name__)


@dataclass
class Progress:
    """Times stages; speaks on a terminal only, and not when `quiet`."""

    quiet: bool = False
    seconds: dict[str, float] = field(default_factory=dict)
    console: Console = field(default_factory=lambda: Console(stderr=True))
    status: Status | None = None

    @property
    def speaks(self) -> bool:
        return not self.quiet and self.console.is_terminal

    @contextmanager
    def stage(self, name: str) -> Iterator["Stage"]:
        """Show a stage while it runs, and a line with its time when it is done."""
        start = perf_counter()
        stage = Stage(self, name)
        if self.speaks:
            self.status = self.console.status(name)
            self.status.start()
        try:
            yield stage
        finally:
            elapsed = perf_counter() - start
            self.seconds[name] = round(self.seconds.get(name, 0.0) + elapsed, 3)
            if self.status is not None:
                self.status.stop()
                self.status = None
        if self.speaks:
            note = f"  [dim]{stage.note}[/dim]" if stage.note else ""
            self.console.print(f"[green]✓[/green] {name:<34}{elapsed:7.1f} s{note}", highlight=False)


@dataclass
class Stage:
    """A running stage; `note` stands behind its time."""

    progress: Progress
    name: str
    note: str = ""

    def say(self, text: str) -> None:
        """What the stage is at."""
        LOG.info("%s: %s", self.name, text)
        if self.progress.status is not None:
            self.progress.status.update(f"{self.name}: {text}")
