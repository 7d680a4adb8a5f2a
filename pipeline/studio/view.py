"""The studio's page: a session and the widgets that show it. Wiring only."""

from __future__ import annotations

import asyncio
from pathlib import Path
from typing import Any

from trame.app import get_server
from trame.decorators import TrameApp, change

from pipeline.discover.command import LawsFound
from pipeline.errors import InputError
from pipeline.page.record import Page
from pipeline.plan.record import Plan
from pipeline.studio import own_table
from pipeline.studio.drop import Dropped, lay
from pipeline.studio.layout import Actions, build
from pipeline.studio.recent import example, recent, remember
from pipeline.studio.scene import Scene
from pipeline.studio.session import Session
from pipeline.studio.state import campaigns, channels, panel, test_of, tests
from reports.campaign import curve, matrix, plots, rivals_plot, words
from reports.campaign.names import channel_label, stages_of, test_label, worst
from reports.files import write_bytes

LOW, MATRIX = 330, 400
"""Pixels of a low plot, and of that of a plan; the others fill their places."""
SECONDS = 0.1
"""Between two looks at what the worker has sent."""
REPORTS = "reports"
"""Where exported reports are served."""
EMPTY: dict[str, Any] = {
    "screen": "start",
    "folder": "",
    "folder_shown": "",
    "dropped": None,
    "table_file": None,
    "table": None,
    "preview": own_table.NOTHING,
    "chosen": None,
    "test": "",
    "tests": [],
    "channel": "",
    "channels": [],
    "step": 0,
    "steps": 0,
    "seen": "",
    "tab": "data",
    "report": "",
}


class Drawn(dict[str, Any]):
    """A plot as plotly.js reads it, for a widget that asks plotly's own objects for one."""

    def to_plotly_json(self) -> dict[str, Any]:
        """Itself."""
        return dict(self)


@TrameApp()
class Studio:
    """One page on one campaign; the browser may come and go."""

    def __init__(self, folder: Path | None, effects_from: tuple[Path, ...] = ()) -> None:
        self.server: Any = get_server("parastiff", client_type="vue3")
        self.state = self.server.state
        # First: where nothing can be drawn no process is started.
        self.scene = Scene()
        self.session = Session(self._show, effects_from)
        self._shown: Page | None = None
        self._foreseen: Plan | None = None
        self._found: LawsFound | None = None
        self._framed = ""
        self._exported: Path | None = None
        self._drawn: tuple[str, str] = ("", "")
        self._served = self.session.served(REPORTS)
        self.server.serve[REPORTS] = str(self._served)
        self.state.trame__title = "parastiff studio"
        self.state.update(
            {**EMPTY, **panel(self.session), "campaigns": campaigns(Path.cwd()), "recent": recent()}
        )
        self.views = build(self.server, self._actions(), self.scene.plotter)
        if folder is not None:
            self._enter(str(folder))

    def _actions(self) -> Actions:
        session = self.session
        return {
            "home": lambda: self._screen("start"),
            "work": lambda: self._screen("work"),
            "example": lambda: session.open(example(), diagnosing=True),
            "open": lambda: self._enter(str(self.state.folder or "")),
            "enter": self._enter,
            "add": self._add,
            "remove": session.remove,
            "save": session.save,
            "export": session.export,
            "diagnose": session.diagnose,
            "accept": session.accept,
            "back": session.back,
            "choose": self._choose,
            "take": self._take,
            "discover": session.discover,
            "add_laws": session.add_laws,
            "plan": session.look_ahead,
            "cancel": session.cancel,
            "pick": self._pick,
            "tolerate": lambda: session.tolerate({row["key"]: row["value"] for row in self.state.tolerances}),
            "save_tolerances": session.save_tolerances,
            "mend": session.mend,
            "undo": session.undo,
            "count": session.count,
            "aside": self._aside,
            "kind": lambda *_: self._kind(),
            "preview": self._preview,
            "make": lambda: session.make(str(self.state.table["name"])),
            "drop_table": lambda: self.state.update({"table": None, "table_file": None}),
        }

    def serve(self, port: int, ready: Any) -> None:
        """Serve on this machine's own address until interrupted; ready: called with the port."""
        self.server.controller.on_server_ready.add(lambda **_: ready(self.server.port))
        self.server.controller.on_server_ready.add_task(self._watch)
        try:
            self.server.start(
                port=port,
                host="127.0.0.1",
                open_browser=False,
                show_connection_info=False,
                disable_logging=True,
                timeout=0,
            )
        finally:
            self.session.close()

    async def _watch(self, **_: Any) -> None:
        while True:
            await asyncio.sleep(SECONDS)
            with self.state:
                self.session.poll()

    def _show(self) -> None:
        page = self.session.shown
        self.state.update(panel(self.session))
        if page is not None and page is not self._shown:
            self._shown = page
            self._draw(page)
        if self.session.folder is not None and str(self.session.folder) != self.state.folder_shown:
            self._opened(self.session.folder)
        plan = self.session.plan
        if plan is not self._foreseen:
            self._foreseen = plan
            self.state.tab = "data" if plan is None else "plan"
            if plan is not None:
                self.views["alike"].update(matrix.numbered(plan.names, plan.alike, MATRIX))
        if self.session.laws is not self._found:
            self._found = self.session.laws
            if self._found is not None:
                self.state.tab = "laws"
        if self.session.report is not None and self.session.report != self._exported:
            self._link(self.session.report)
        self._show_table()

    def _opened(self, folder: Path) -> None:
        """Another campaign: its own pictures from the start."""
        remember(folder)
        self.state.update(
            {
                "folder_shown": str(folder),
                "folder": str(folder),
                "screen": "work",
                "recent": recent(),
                "tab": "data",
                "report": "",
                "table": None,
                "table_file": None,
            }
        )

    def _link(self, report: Path) -> None:
        """A copy where the page can lead to: what is on the disk is not for a page from a server."""
        self._exported = report
        name = report.parent.name
        write_bytes(self._served / name / report.name, report.read_bytes())
        self.state.report = f"/{REPORTS}/{name}/{report.name}"

    def _show_table(self) -> None:
        session = self.session
        wanted = self.state.table_file and self.state.table is None
        if wanted and session.found is not None and session.file is not None:
            self.state.table = own_table.table_of(session.file.name, session.found)
        self.state.preview = own_table.shown(session.preview)

    def _draw(self, page: Page) -> None:
        record = page.model_dump()
        self.state.tests = tests(page)
        if self.state.test not in self.state.tests:
            # The worst cell of what is seen is chosen when a campaign is opened.
            test, it = (
                worst(record, 1)[0] if any(t.curves for t in page.tests) else (record["tests"][0], None)
            )
            self.state.test = test_label(test)
            self.state.channel = "" if it is None else channel_label(it["channel"])
            peak = test["misfit_after"]
            known = [value or 0.0 for value in peak]
            self.state.step = known.index(max(known)) if known else 0
        self._drawn = ("", "")
        self._show_test(page)

    def _show_test(self, page: Page) -> None:
        test = test_of(page, self.state.test)
        self.state.channels = channels(test)
        if self.state.channel not in self.state.channels:
            self.state.channel = next(iter(self.state.channels), "")
        self.state.steps = len(test.steps) - 1
        self.state.step = min(int(self.state.step), self.state.steps)
        self._show_curve(page)
        self._show_step(page)

    def _show_curve(self, page: Page) -> None:
        cell = (str(self.state.test), str(self.state.channel))
        if cell == self._drawn:
            return
        self._drawn = cell
        self._show_map(page, cell)
        test = test_of(page, self.state.test)
        every = self.session.proposals if page.rivals else ()
        for k, it in enumerate(test.curves):
            if channel_label(it.channel) != self.state.channel:
                continue
            stages = stages_of(page.effects)
            self.views["curve"].update(filling(curve.figure(test.model_dump(), it.model_dump(), LOW, stages)))
            if every:
                names = [words.set_of(each.page.effects, page.titles) for each in every]
                curves = [test_of(each.page, self.state.test).curves[k].model_dump() for each in every]
                self.views["rivals"].update(Drawn(rivals_plot.figure(names, test.model_dump(), curves)))

    def _show_map(self, page: Page, cell: tuple[str, str]) -> None:
        stages = stages_of(page.effects)
        self.views["map"].update(dense(plots.misfit_map(page.model_dump(), stages, chosen=cell)))

    def _show_step(self, page: Page) -> None:
        test = test_of(page, self.state.test)
        self.state.seen = self.scene.show(test, int(self.state.step))
        self.views["scene"].update()
        if self._framed != test.test:
            # Another test is seen as a whole; another step from where the user has turned it.
            self._framed = test.test
            self.scene.plotter.reset_camera()
            self.views["scene"].push_camera()

    def _add(self, names: list[str]) -> None:
        self.state.chosen = None
        self.session.add([name for name in names if name])

    def _pick(self, cell: list[str] | None) -> None:
        if cell:
            self.state.test, self.state.channel = cell

    def _aside(self) -> None:
        """Set aside the reading that is seen: test, channel and load step as they are chosen."""
        page = self.session.shown
        if page is not None:
            test = test_of(page, self.state.test)
            it = next((c for c in test.curves if channel_label(c.channel) == self.state.channel), None)
            if it is not None:
                step = test.steps[int(self.state.step)]
                self.session.count(test.test, step, f"{it.channel}_{it.unit}", "set_aside")

    def _screen(self, name: str) -> None:
        self.state.screen = name

    def _enter(self, folder: str) -> None:
        self.state.folder = folder
        self.session.open(Path(folder))

    def _choose(self, number: int) -> None:
        self.session.choose(number)
        self.state.tab = "data"

    def _take(self, number: int) -> None:
        self.session.choose(number)
        self.session.accept()
        self.state.tab = "data"

    def _kind(self) -> None:
        """Another kind of rig asks for other numbers."""
        self.state.table = own_table.of_kind(self.state.table)

    def _preview(self) -> None:
        try:
            self.session.read_table(own_table.choices_of(self.state.table))
        except InputError as error:
            self.session.complaint = str(error)
            self._show()

    @change("table_file")
    def _table_dropped(self, table_file: Any = None, **_: Any) -> None:
        if table_file:
            self.state.table = None
            self.session.look(table_file if isinstance(table_file, list) else [table_file])

    @change("test")
    def _test_chosen(self, **_: Any) -> None:
        if self._shown is not None:
            self._show_test(self._shown)

    @change("channel")
    def _channel_chosen(self, **_: Any) -> None:
        if self._shown is not None:
            self._show_curve(self._shown)

    @change("step")
    def _step_chosen(self, **_: Any) -> None:
        if self._shown is not None:
            self._show_step(self._shown)

    @change("dropped")
    def _files_dropped(self, dropped: Dropped = None, **_: Any) -> None:
        if not dropped:
            return
        try:
            self.session.open(lay(dropped))
        except ValueError as error:
            self.session.complaint = str(error)
            self._show()


def filling(figure: dict[str, Any]) -> Drawn:
    """A plot that takes the place that there is."""
    layout = {**figure["layout"], "autosize": True, "margin": {"l": 74, "r": 14, "t": 34, "b": 42}}
    layout["title"] = {"text": ""}
    layout["legend"] = {**layout["legend"], "font": {"size": 11}}
    layout.pop("height", None)
    return Drawn({**figure, "layout": layout})


def dense(figure: Any) -> Any:
    """A map with a name for every row however low it is."""
    figure.update_yaxes(tickfont={"size": 11}, dtick=1)
    figure.update_xaxes(tickfont={"size": 11}, tickangle=0, title_text="")
    margin = {"l": 10, "r": 10, "t": 26, "b": 24}
    figure.update_layout(margin=margin, font={"size": 12}, height=None, autosize=True)
    return figure
