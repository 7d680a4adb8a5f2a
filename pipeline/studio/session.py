"""One campaign in the studio: the model as it stands, whether it is saved, and what is being done."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from tempfile import TemporaryDirectory

from meshes.files import replacing
from pipeline.answer import Answer
from pipeline.campaign.reading import DESCRIPTION, MEASUREMENTS
from pipeline.errors import InputError
from pipeline.inference.model_file import NAME
from pipeline.page.command import RESULTS
from pipeline.page.record import Isolability, Page
from pipeline.plan.record import Plan
from pipeline.studio.work import Done, Kind, Task
from pipeline.studio.worker import Event, Refused, Said, Worker

Listener = Callable[[], None]
TITLES: dict[Kind, str] = {
    "open": "opening",
    "add": "adding",
    "remove": "removing",
    "diagnose": "looking for what is missing",
    "plan": "looking at what these tests show",
    "export": "drawing the report",
}


class Session:
    """What a page shows and its buttons do; without any widget, so that it is tested without a browser.

    Nothing in a campaign's folder is touched but by `save`. changed: called when something is to be shown anew.
    """

    def __init__(self, changed: Listener = lambda: None, effects_from: Sequence[Path] = ()) -> None:
        self._changed, self._effects_from = changed, tuple(effects_from)
        self._scratch = TemporaryDirectory(prefix="parastiff-studio-")
        self._worker = Worker()
        self._seen: tuple[int, ...] = ()
        self._kept: str | None = None
        self._on_disk: bytes | None = None
        self._pending: tuple[tuple[int, ...], bytes | None] = ((), None)
        self._task: Task | None = None
        self.folder: Path | None = None
        self.model: str | None = None
        self.page: Page | None = None
        self.answer: Answer | None = None
        self.isolability: Isolability | None = None
        self.diagnosed: Page | None = None
        self.plan: Plan | None = None
        self.planned: Page | None = None
        self.names: tuple[tuple[str, str], ...] = ()
        self.dirty = False
        self.complaint = self.remark = self.progress = ""

    @property
    def headline(self) -> str:
        """The verdict on the model as it stands: that of a diagnosis, if there was one of this very model."""
        if self.page is None:
            return ""
        if self.answer is not None and self.diagnosed is self.page:
            return self.answer.sentences[0]
        return self.page.headline

    @property
    def busy(self) -> Kind | None:
        """What is being done."""
        return None if self._task is None else self._task.kind

    def open(self, folder: Path) -> None:
        """Read a campaign and the model that is kept with it."""
        self._begin(Task("open", folder, self._at, effects_from=self._effects_from))

    def add(self, names: Sequence[str]) -> None:
        """Add effects and fit."""
        self._change("add", names)

    def remove(self, name: str) -> None:
        """Take an effect out and fit what remains."""
        self._change("remove", [name])

    def diagnose(self) -> None:
        """Look for what is missing, from the model as it stands."""
        self._change("diagnose", ())

    def look_ahead(self) -> None:
        """Look at what the tests show about the model as it stands, measured or not, and which comes next."""
        self._change("plan", ())

    def export(self, out: Path | None = None) -> None:
        """Draw the report of the model as it stands, outside of the campaign."""
        if self.page is not None:
            self._change("export", (), out or RESULTS / self.page.campaign)

    def cancel(self) -> None:
        """Stop what is being done; everything stays as it was before."""
        if self._task is not None:
            self._worker.cancel()
            self.remark = f"{TITLES[self._task.kind]}: cancelled; nothing was changed"
            self._task, self.progress = None, ""
            self._changed()

    def save(self) -> None:
        """Keep the model with the campaign, unless another has changed it there since; a second time replaces it."""
        if self.folder is None or self.model is None or self._task is not None:
            return
        self.complaint = self.remark = ""
        path, now = self.folder / NAME, _content(self.folder / NAME)
        try:
            if now != self._on_disk:
                self._on_disk = now
                raise InputError(
                    f"{path} was changed since it was read: Open reads it, Save again replaces it"
                )
            with replacing(path) as part:
                part.write_text(self._kept or "", encoding="utf-8")
        except OSError as error:
            self.complaint = f"{path} cannot be written: {error.strerror}"
        except InputError as error:
            self.complaint = str(error)
        else:
            self._on_disk, self.dirty = _content(path), False
            self._seen = _stamps(self.folder)
            self.remark = f"saved: {path}"
        self._changed()

    def poll(self) -> None:
        """Take what the worker has sent; files of the campaign that were edited meanwhile are read again."""
        while (event := self._worker.poll()) is not None:
            self._take(event)
        if self._task is None and self.folder is not None and _stamps(self.folder) != self._seen:
            # What was added and is not saved yet is kept; else the model is read again as well.
            self._begin(Task("open", self.folder, self._at, self.model if self.dirty else None))
            self.remark = "the campaign was edited: read again"

    def close(self) -> None:
        """End the worker and leave nothing behind."""
        self._worker.close()
        self._scratch.cleanup()

    @property
    def _at(self) -> Path:
        return Path(self._scratch.name)

    def _change(self, kind: Kind, names: Sequence[str], out: Path | None = None) -> None:
        if self.folder is None or self.page is None:
            return
        answer, alike = (self.answer, self.isolability) if kind == "export" else (None, None)
        task = Task(
            kind, self.folder, self._at, self.model, tuple(names), self._effects_from, answer, alike, out
        )
        self._begin(task)

    def _begin(self, task: Task) -> None:
        if self._task is not None:
            self.complaint = f"{TITLES[self._task.kind]} is not finished, allowed is to cancel it"
            self._changed()
            return
        self.complaint = self.remark = ""
        self._task, self.progress = task, TITLES[task.kind]
        # Taken before the files are read: an edit meanwhile is seen afterwards.
        self._pending = (_stamps(task.folder), _content(task.folder / NAME))
        self._worker.submit(task)
        self._changed()

    def _take(self, event: Event) -> None:
        task = self._task
        if task is None:
            return
        if isinstance(event, Said):
            self.progress = f"{TITLES[task.kind]}: {event.text}"
        else:
            self._task, self.progress = None, ""
            if task.kind == "open":
                self._seen = self._pending[0] if task.folder == self.folder else self._seen
            if isinstance(event, Refused):
                self.complaint = event.text
            else:
                self._finish(task, event)
        self._changed()

    def _finish(self, task: Task, done: Done) -> None:
        if task.kind == "open":
            self.folder, self._seen = task.folder, self._pending[0]
            if task.model is None:
                self._on_disk, self.dirty = self._pending[1], False
                self.answer = self.isolability = self.plan = None
        if done.page is not None:
            self.model, self._kept, self.page, self.names = done.model, done.kept, done.page, done.names
            self.dirty = self.dirty or task.kind in ("add", "remove")
        if done.answer is not None:
            self.answer, self.isolability = done.answer, done.isolability
            self.diagnosed = self.page
        if done.plan is not None:
            self.plan, self.planned = done.plan, self.page
        if done.written is not None:
            self.remark = f"report: {done.written}"


def _stamps(folder: Path) -> tuple[int, ...]:
    """When the files of a campaign were last changed; 0 for one that is missing."""
    out = []
    for name in (DESCRIPTION, MEASUREMENTS, NAME):
        try:
            out.append((folder / name).stat().st_mtime_ns)
        except OSError:
            out.append(0)
    return tuple(out)


def _content(path: Path) -> bytes | None:
    try:
        return path.read_bytes()
    except OSError:
        return None
