"""The studio's page: a session and the widgets that show it. Wiring only."""

from __future__ import annotations

import asyncio
from pathlib import Path
from typing import Any

from trame.app import get_server
from trame.decorators import TrameApp, change

from pipeline.page.record import Page
from pipeline.plan.record import Plan
from pipeline.studio.drop import Dropped, lay
from pipeline.studio.layout import Actions, build
from pipeline.studio.scene import Scene
from pipeline.studio.session import Session
from pipeline.studio.state import campaigns, channels, panel, test_of, tests
from reports.campaign import curve, matrix, plots
from reports.campaign.names import channel_label, test_label, worst

HEIGHT, MAP, MATRIX, NARROW = 330, 290, 400, 222
"""Pixels of the plots."""
SECONDS = 0.1
"""Between two looks at what the worker has sent."""
EMPTY: dict[str, Any] = {
    "folder": "",
    "dropped": None,
    "chosen": None,
    "test": "",
    "tests": [],
    "channel": "",
    "channels": [],
    "step": 0,
    "steps": 0,
    "seen": "",
    "tab": "data",
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
        self._framed = ""
        self.state.trame__title = "parastiff studio"
        self.state.update({**EMPTY, **panel(self.session), "campaigns": campaigns(Path.cwd())})
        session = self.session
        actions: Actions = {
            "open": lambda: session.open(Path(str(self.state.folder or ""))),
            "add": self._add,
            "remove": session.remove,
            "save": session.save,
            "export": session.export,
            "diagnose": session.diagnose,
            "plan": session.look_ahead,
            "cancel": session.cancel,
            "pick": self._pick,
        }
        self.views = build(self.server, actions, self.scene.plotter)
        if folder is not None:
            self.state.folder = str(folder)
            session.open(folder)

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
        page = self.session.page
        self.state.update(panel(self.session))
        if page is not None and page is not self._shown:
            self._shown = page
            self.state.folder = str(self.session.folder)
            self._draw(page)
        plan = self.session.plan
        if plan is not self._foreseen:
            self._foreseen = plan
            self.state.tab = "data" if plan is None else "plan"
            if plan is not None:
                self.views["alike"].update(matrix.numbered(plan.names, plan.alike, MATRIX))

    def _draw(self, page: Page) -> None:
        record = page.model_dump()
        self.views["waterfall"].update(small(plots.waterfall(record)))
        self.views["map"].update(dense(plots.misfit_map(record, ("after",), MAP)))
        self.state.tests = tests(page)
        if self.state.test not in self.state.tests:
            test, it = (
                worst(record, 1)[0] if any(t.curves for t in page.tests) else (record["tests"][0], None)
            )
            self.state.test = test_label(test)
            self.state.channel = "" if it is None else channel_label(it["channel"])
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
        test = test_of(page, self.state.test)
        for it in test.curves:
            if channel_label(it.channel) == self.state.channel:
                self.views["curve"].update(Drawn(curve.figure(test.model_dump(), it.model_dump(), HEIGHT)))

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


def small(figure: Any) -> Any:
    """A plot for the narrow column."""
    decades = [1, 10, 100, 1000, 10000]
    figure.update_layout(height=NARROW, margin={"l": 10, "r": 46, "t": 18, "b": 80}, font={"size": 11})
    figure.update_xaxes(
        tickvals=decades, ticktext=[str(it) for it in decades], title_font_size=11, title_standoff=4
    )
    legend = {"xref": "container", "yref": "container", "x": 0.0, "y": 0.0, "yanchor": "bottom"}
    figure.update_layout(legend={**legend, "font": {"size": 11}})
    return figure


def dense(figure: Any) -> Any:
    """A map with a name for every row however low it is."""
    figure.update_yaxes(tickfont={"size": 10}, dtick=1)
    figure.update_xaxes(tickfont={"size": 11}, tickangle=0, title_text="")
    figure.update_layout(margin={"l": 10, "r": 10, "t": 4, "b": 24}, font={"size": 11})
    return figure
