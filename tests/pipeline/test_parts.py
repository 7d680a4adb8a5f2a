"""The parts of the pipeline that can be tested without a solid: cache, files, progress, search, departures."""

import io
import multiprocessing
import os
from pathlib import Path

import numpy as np
import pytest
from pydantic import BaseModel
from rich.console import Console

from fem.material import Isotropic
from meshes.bar import Bar
from pipeline import system
from pipeline.errors import InputError
from pipeline.progress import Progress, Stage
from pipeline.validation.curves import departures
from pipeline.validation.entries import eight_entries
from pipeline.validation.reference_bar import Family, find_bar, thin_walled_stiffness
from pipeline.validation.result import write_text
from pipeline.validation.stages.linkage import SolidPath
from pipeline.validation.workshop import Workshop

ALUMINIUM = Isotropic(70e3, 0.33)


class Number(BaseModel):
    value: float


def test_stage_is_reused_until_its_inputs_change(tmp_path: Path) -> None:
    shop = Workshop(tmp_path, Progress(quiet=True))
    calls: list[int] = []

    def compute(_: Stage) -> Number:
        calls.append(1)
        return Number(value=0.1 + 0.2)

    first = shop.reuse("stage", [1], Number, compute)
    assert shop.reuse("stage", [1], Number, compute) == first and len(calls) == 1
    shop.reuse("stage", [2], Number, compute)
    assert len(calls) == 2


def test_damaged_or_incomplete_stage_is_made_again(tmp_path: Path) -> None:
    shop = Workshop(tmp_path, Progress(quiet=True))
    folder = shop.files("stage", [])
    calls: list[int] = []

    def compute(_: Stage) -> Number:
        calls.append(1)
        folder.mkdir(parents=True, exist_ok=True)
        (folder / "shape.vtu").write_text("x")
        return Number(value=1.0)

    shop.reuse("stage", [], Number, compute, ("shape.vtu",))
    next((tmp_path / "stages").glob("*.json")).write_text('{"value": "torn')
    shop.reuse("stage", [], Number, compute, ("shape.vtu",))
    (folder / "shape.vtu").unlink()
    shop.reuse("stage", [], Number, compute, ("shape.vtu",))
    assert len(calls) == 3


def test_file_is_written_whole_or_not_at_all(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "result.json"
    write_text(path, "old")

    def fail(*_: object) -> None:
        raise OSError("disk full")

    monkeypatch.setattr(os, "replace", fail)
    with pytest.raises(OSError, match="disk full"):
        write_text(path, "new")
    assert path.read_text() == "old" and os.listdir(tmp_path) == ["result.json"]


def test_progress_speaks_on_a_terminal_and_only_there() -> None:
    for terminal, quiet, speaks in ((True, False, True), (True, True, False), (False, False, False)):
        screen = io.StringIO()
        progress = Progress(quiet, console=Console(file=screen, force_terminal=terminal, width=100))
        with progress.stage("mesh study") as stage:
            stage.say("level 2")
            stage.note = "reused"
        assert ("mesh study" in screen.getvalue() and "reused" in screen.getvalue()) == speaks
        assert progress.seconds["mesh study"] >= 0.0


def test_missing_library_names_its_package(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(system, "loads", lambda name: name not in ("libEGL.so.1", "libGLU.so.1"))
    with pytest.raises(InputError, match=r"apt-get install -y libglu1-mesa libegl1 "):
        system.require_libraries()


def test_search_recovers_a_known_bar_through_a_different_model() -> None:
    """The 'solid' is the beam with its entries distorted by fixed factors, which the search does not know."""
    family = Family(310.0, 6.0)
    truth = family.member((11.0, 3.0, 16.0, 3.5))
    factors = np.diag([1.01, 1.04, 0.97, 1.08, 0.99, 1.03]) ** 0.5

    def solid(bar: Bar) -> np.ndarray:
        return factors @ thin_walled_stiffness(bar, ALUMINIUM) @ factors

    found = find_bar(solid(truth), family, ALUMINIUM, solid)
    np.testing.assert_allclose(eight_entries(found.stiffness), eight_entries(solid(truth)), rtol=1e-3)
    start = eight_entries(thin_walled_stiffness(found.start, ALUMINIUM))
    assert np.abs(start / eight_entries(solid(truth)) - 1.0).max() > 0.005, (
        "the start must not already be the answer"
    )


def test_search_that_cannot_settle_says_so() -> None:
    rng = np.random.default_rng(1)

    def noisy(bar: Bar) -> np.ndarray:
        return thin_walled_stiffness(bar, ALUMINIUM) * rng.uniform(0.5, 2.0)

    family = Family(310.0, 6.0)
    target = thin_walled_stiffness(family.member((11.0, 3.0, 16.0, 3.5)), ALUMINIUM)
    with pytest.raises(RuntimeError, match="did not settle"):
        find_bar(target, family, ALUMINIUM, noisy)


def test_departure_is_where_the_curve_has_left_its_tangent() -> None:
    """F = k x (1 + x / 10): one per cent is reached at x = -0.1, five at -0.5."""
    x = -np.linspace(0.0, 1.0, 2001)
    fx = 100.0 * x * (1.0 + x / 10.0)
    path = SolidPath(
        q_deg=0.0,
        held=["z"],
        x=list(x),
        fx=list(fx),
        tension_x=[],
        tension_fx=[],
        tangent=100.0,
        critical=1.0,
        plane="in-plane",
        failure="",
    )
    one, five = departures("solid FE", path, x, fx, 100.0)
    assert one.load_N == pytest.approx(9.9, rel=1e-3) and five.load_N == pytest.approx(47.5, rel=1e-3)
    straight = departures("solid FE", path, x, 100.0 * x, 100.0)
    assert [record.load_N for record in straight] == [None, None]


def write_many(folder: str, text: str) -> None:
    """Write one file again and again, as a second run in the same folder would."""
    for _ in range(300):
        write_text(Path(folder) / "result.json", text)


def test_two_writers_never_meet(tmp_path: Path) -> None:
    texts = ["a" * 100_000, "b" * 100_000]
    context = multiprocessing.get_context("spawn")
    writers = [context.Process(target=write_many, args=(str(tmp_path), text)) for text in texts]
    for writer in writers:
        writer.start()
    for writer in writers:
        writer.join()
    assert [writer.exitcode for writer in writers] == [0, 0]
    assert (tmp_path / "result.json").read_text() in texts and os.listdir(tmp_path) == ["result.json"]
