"""One campaign in the studio: the model as it stands, whether it is saved, and what is being done."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from pipeline.answer.record import Answer
from pipeline.campaign.edited import Counts, with_reading
from pipeline.campaign.reading import DESCRIPTION
from pipeline.discover.command import LawsFound
from pipeline.errors import InputError
from pipeline.inference.model_file import NAME
from pipeline.init.choices import Choices
from pipeline.init.found import Found
from pipeline.page.command import RESULTS
from pipeline.page.record import Page
from pipeline.plan.record import Plan
from pipeline.saving import put
from pipeline.selection.mending import Mend
from pipeline.studio import tolerances
from pipeline.studio.drop import TABLES, placed, table
from pipeline.studio.files import Edit, content, edited, stamps, undone, write_laws
from pipeline.studio.preview import Preview
from pipeline.studio.work import Done, Kind, Proposal, Task
from pipeline.studio.worker import Event, Refused, Said, Worker

Listener = Callable[[], None]
TITLES: dict[Kind, str] = {
    "open": "opening",
    "add": "adding",
    "remove": "removing",
    "diagnose": "looking for what is missing",
    "discover": "looking for laws",
    "plan": "looking at what these tests show",
    "export": "drawing the report",
    "look": "looking at the table",
    "preview": "reading the table",
}


class Session:
    """What a page shows and its buttons do; without any widget, so that it is tested without a browser.

    Of a campaign's folder `save` and `add_laws` write files, `edit` and `undo` write campaign.toml; nothing else does.
    changed: called when something is to be shown anew.
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
        self.proposals: tuple[Proposal, ...] = ()
        self.choice: int | None = None
        self.mends: tuple[Mend, ...] = ()
        self.edits: tuple[Edit, ...] = ()
        self.laws: LawsFound | None = None
        self._laws_of: str | None = None
        self._law_file: Path | None = None
        self.plan: Plan | None = None
        self.planned: Page | None = None
        self.names: tuple[tuple[str, str], ...] = ()
        self.dirty = False
        self.report: Path | None = None
        self.file: Path | None = None
        self.found: Found | None = None
        self.preview: Preview | None = None
        self.tolerance: tuple[tuple[str, float], ...] | None = None
        self._then = False
        self.complaint = self.remark = self.progress = ""

    @property
    def proposal(self) -> Proposal | None:
        """What is shown of a diagnosis and is not accepted yet."""
        return None if self.choice is None else self.proposals[self.choice]

    @property
    def shown(self) -> Page | None:
        """What headline, pictures and numbers are of: a proposal, or the model as it stands."""
        proposal = self.proposal
        return self.page if proposal is None else proposal.page

    @property
    def busy(self) -> Kind | None:
        """What is being done."""
        return None if self._task is None else self._task.kind

    def open(self, folder: Path, diagnosing: bool = False) -> None:
        """Read a campaign and the model that is kept with it; diagnosing: and look for what is missing at once."""
        self.tolerance = None
        if self._begin(Task("open", folder, self._at, effects_from=self._effects_from)):
            self._then = diagnosing

    def look(self, files: Sequence[dict[str, Any]]) -> None:
        """Look at a table that was dropped."""
        try:
            self.file = table(files, self._at / "table")
        except InputError as error:
            self.complaint = str(error)
            self._changed()
            return
        self.found = self.preview = None
        self._begin(Task("look", self._at, self._at, file=self.file))

    def read_table(self, choices: Choices) -> None:
        """Read the table with what its owner says of it, to be looked at."""
        self.preview = None
        self._begin(Task("preview", self._at, self._at, file=self.file, choices=choices))

    def make(self, name: str) -> None:
        """Make the table that was looked at a campaign of its own, and open it."""
        if self.file is not None and self.preview is not None and self._task is None:
            files = {path.name: path.read_bytes() for path in (self.file, self.file.parent / DESCRIPTION)}
            self.open(placed(files, name, TABLES))

    def add(self, names: Sequence[str]) -> None:
        """Add effects and fit."""
        self._change("add", names)

    def remove(self, name: str) -> None:
        """Take an effect out and fit what remains."""
        self._change("remove", [name])

    def diagnose(self) -> None:
        """Look for what is missing, from the model as it stands."""
        self._change("diagnose", ())

    def choose(self, number: int) -> None:
        """Show one of the sets of a diagnosis."""
        if self._task is None and 0 <= number < len(self.proposals):
            self.choice = number
            self._changed()

    def back(self) -> None:
        """Show the model as it stands again; what a diagnosis proposes stays at hand."""
        self.choice = None
        self._changed()

    def accept(self) -> None:
        """Make what is proposed the model."""
        taken = self.proposal
        if taken is None or self._task is not None:
            return
        self.page, self.model, self._kept, self.answer = taken.page, taken.model, taken.kept, taken.answer
        self.proposals, self.choice, self.dirty = (), None, True
        self.remark = "accepted; Save model keeps it with the campaign"
        self._changed()

    def tolerate(self, texts: Mapping[str, str]) -> None:
        """Take tolerances of the rig as they were typed: from the next diagnosis on they count. Nothing is written."""
        if self.page is None or self._task is not None:
            return
        self.complaint = self.remark = ""
        try:
            self.tolerance = tolerances.typed(texts, self.page.tolerances)
        except InputError as error:
            self.complaint = str(error)
        else:
            self.remark = "Diagnose looks again with these; Save tolerances writes them in campaign.toml"
        self._changed()

    def save_tolerances(self) -> None:
        """Write them in campaign.toml, which is read again then."""
        page, known = self.page, self.tolerance
        if page is not None and known is not None:
            written = self.edit(
                lambda text: tolerances.with_tolerances(text, known, page.tolerances), "[tolerance]"
            )
            self.tolerance = None if written else known

    def mend(self, number: int) -> None:
        """Write a line that mends what the doctor found in campaign.toml, which is read again then."""
        if 0 <= number < len(self.mends):
            it = self.mends[number]
            self.edit(lambda _: it.text, "; ".join(it.lines))

    def edit(self, change: Callable[[str], str], words: str) -> bool:
        """Write campaign.toml otherwise and read it again; whether it was written."""
        if self.folder is None or self._task is not None:
            return False
        self.complaint = self.remark = ""
        try:
            if stamps(self.folder) != self._seen:
                raise InputError("the campaign was edited meanwhile: it is read again, then once more")
            self.edits = (*self.edits, edited(self.folder, change, words))
        except InputError as error:
            self.complaint = str(error)
            self._changed()
            return False
        self._reread(f"written in {DESCRIPTION}: {words}")
        return True

    def count(self, test: str, step: int, column: str, counts: Counts) -> None:
        """Set a reading aside in campaign.toml, keep it there, or leave it to the diagnosis."""
        said = f"{column} of {test}, step {step}: {counts.replace('_', ' ')}"
        self.edit(lambda text: with_reading(text, test, step, column, counts), said)

    def undo(self) -> None:
        """Take back what was written last in campaign.toml."""
        if self.folder is None or not self.edits or self._task is not None:
            return
        *rest, last = self.edits
        try:
            undone(last)
        except InputError as error:
            self.complaint = str(error)
        else:
            self.edits = tuple(rest)
            self._reread(f"taken back in {last.path.name}: {last.words}")
        self._changed()

    def discover(self) -> None:
        """Look where in the linkage the rest sits, and what law it follows, from the model as it stands."""
        self._change("discover", ())

    @property
    def laws_fresh(self) -> bool:
        """Whether the model is the one from which on laws were looked for."""
        return self._laws_of == self.model

    @property
    def may_add_laws(self) -> bool:
        """Whether laws were found that are no part of the model yet, which is as it was when they were looked for."""
        return self.laws is not None and bool(self.laws.effect_file) and self.laws_fresh

    def add_laws(self) -> None:
        """Write the effect file of the laws beside the campaign, and add them with what entered the model."""
        if self.folder is None or self.laws is None or not self.may_add_laws or self._task is not None:
            return
        try:
            self._law_file = write_laws(self.folder, self.laws.effect_file)
        except InputError as error:
            self.complaint = str(error)
        else:
            self._change("add", self.laws.effects)
            self.remark = f"written: {self._law_file}"
        self._changed()

    def look_ahead(self) -> None:
        """Look at what the tests show about the model as it stands, measured or not, and which comes next."""
        self._change("plan", ())

    def export(self, out: Path | None = None) -> None:
        """Draw the report of what is shown, outside of the campaign."""
        if self.shown is not None:
            self._change("export", (), out or RESULTS / self.shown.campaign)

    def cancel(self) -> None:
        """Stop what is being done; everything stays as it was before."""
        if self._task is not None:
            self._worker.cancel()
            self._then = False
            self.remark = f"{TITLES[self._task.kind]}: cancelled; nothing was changed"
            self._task, self.progress = None, ""
            self._changed()

    def save(self) -> None:
        """Keep the model with the campaign, unless another has changed it there since; a second time replaces it."""
        if self.folder is None or self.model is None or self._task is not None:
            return
        self.complaint = self.remark = ""
        path, now = self.folder / NAME, content(self.folder / NAME)
        try:
            if now != self._on_disk:
                self._on_disk = now
                raise InputError(f"{path} was changed since it was read: Open reads it, Save replaces it")
            put(path, self._kept or "")
        except InputError as error:
            self.complaint = str(error)
        else:
            self._on_disk, self.dirty = content(path), False
            self._seen = stamps(self.folder)
            self.remark = f"saved: {path}"
        self._changed()

    def poll(self) -> None:
        """Take what the worker has sent; files of the campaign that were edited meanwhile are read again."""
        while (event := self._worker.poll()) is not None:
            self._take(event)
        if self._task is None and self.folder is not None and stamps(self.folder) != self._seen:
            self._reread("the campaign was edited: read again")

    def close(self) -> None:
        """End the worker and leave nothing behind."""
        self._worker.close()
        self._scratch.cleanup()

    def served(self, name: str) -> Path:
        """A folder of its own that ends with the session."""
        place = self._at / name
        place.mkdir(exist_ok=True)
        return place

    @property
    def _at(self) -> Path:
        return Path(self._scratch.name)

    @property
    def _known_files(self) -> tuple[Path, ...]:
        """Of effects: the user's, and the last one of laws."""
        return self._effects_from if self._law_file is None else (*self._effects_from, self._law_file)

    def _change(self, kind: Kind, names: Sequence[str], out: Path | None = None) -> None:
        if self.folder is None or self.page is None:
            return
        shown = self.shown if kind == "export" else None
        self._begin(
            Task(
                kind,
                self.folder,
                self._at,
                self.model,
                tuple(names),
                self._known_files,
                shown,
                out,
                tolerance=self.tolerance,
            )
        )

    def _reread(self, remark: str) -> None:
        """What was added and is not saved yet is kept; else the model is read again as well."""
        if self.folder is not None:
            self._begin(Task("open", self.folder, self._at, self.model if self.dirty else None))
            self.remark = remark
            self._changed()

    def _begin(self, task: Task) -> bool:
        """Whether it was begun."""
        if self._task is not None:
            self.complaint = f"{TITLES[self._task.kind]} is not finished, allowed is to cancel it"
            self._changed()
            return False
        self.complaint = self.remark = ""
        self._task, self.progress = task, TITLES[task.kind]
        # Taken before the files are read: an edit meanwhile is seen afterwards.
        self._pending = (stamps(task.folder), content(task.folder / NAME))
        self._worker.submit(task)
        self._changed()
        return True

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
                self.complaint, self._then = event.text, False
            else:
                self._finish(task, event)
        self._changed()
        if self._then and self._task is None:
            self._then = False
            self.diagnose()

    def _finish(self, task: Task, done: Done) -> None:
        if task.kind == "open":
            if task.folder != self.folder:
                self._law_file, self.edits = None, ()
            self.folder, self._seen, self.laws = task.folder, self._pending[0], None
            if task.model is None:
                self._on_disk, self.dirty = self._pending[1], False
                self.answer = self.plan = None
        if done.page is not None:
            self.model, self._kept, self.page, self.names = done.model, done.kept, done.page, done.names
            self.dirty = self.dirty or task.kind in ("add", "remove")
            self.proposals, self.choice, self.mends = (), None, ()
        if done.answer is not None:
            self._propose(done)
        if done.laws is not None:
            self.laws, self._laws_of = done.laws, task.model
        if done.plan is not None:
            self.plan, self.planned = done.plan, self.page
        self.found, self.preview = done.found or self.found, done.preview or self.preview
        if done.written is not None:
            self.remark, self.report = f"report: {done.written}", done.written

    def _propose(self, done: Done) -> None:
        """What was found is shown as it would be; where it adds nothing the page is that of the model itself."""
        self.answer, self.proposals, self.choice, self.mends = done.answer, done.proposals, 0, done.mends
        first = done.proposals[0].page
        if len(done.proposals) == 1 and self.page is not None and first.effects == self.page.effects:
            self.page, self.proposals, self.choice = first, (), None
