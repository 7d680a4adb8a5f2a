"""The README's walk is walked: its commands, its excerpt, and the user's own effect that it shows."""

from __future__ import annotations

import re
import shutil
from collections.abc import Callable
from pathlib import Path

import pytest

from pipeline.inference.model_reading import read_model_file
from tests.conftest import ROOT, Done

README = (ROOT / "README.md").read_text(encoding="utf-8")
WALK = README[README.index("## Measurements") : README.index("## More")]
COMMANDS = re.findall(r"^python -m pipeline ([^#\n]+)", WALK, re.MULTILINE)
(EXCERPT,) = re.findall(r"```text\n(.*?)```", WALK, re.DOTALL)
(EFFECT,) = re.findall(r"```py\n(.*?)```", WALK, re.DOTALL)
(OWN,) = re.findall(r"`python -m pipeline (add [^`]*--effects-from[^`]*)`", WALK)

Call = Callable[..., Done]


def bench(folder: Path) -> None:
    shutil.copytree(ROOT / "examples" / "bench", folder / "examples" / "bench")


def flat(text: str) -> str:
    """As one line, without the borders of tables."""
    return re.sub(r"[\s│]+", " ", text)


def walked(call: Call, folder: Path, commands: list[str]) -> str:
    out = []
    for command in commands:
        done = call(*command.split(), cwd=folder)
        assert done.code == 0, done.err
        out.append(done.out)
    return flat(" ".join(out))


def excerpts(lines: slice) -> list[str]:
    """Parts of the excerpt's lines between dots."""
    return [flat(part).strip() for line in EXCERPT.splitlines()[lines] for part in line.split(" ... ")]


def test_the_walk_begins_as_it_is_shown(pipeline_command: Call, tmp_path: Path) -> None:
    bench(tmp_path)
    assert len(COMMANDS) == 4 and len(EXCERPT.splitlines()) == 3
    seen = walked(pipeline_command, tmp_path, COMMANDS[:3])
    for part in excerpts(slice(0, 1)):
        assert part in seen, part
    # What `compare` says of plain virtual springs.
    assert "10.0 sigma" in seen


@pytest.mark.long
def test_the_walk_ends_as_it_is_shown(pipeline_command: Call, tmp_path: Path) -> None:
    bench(tmp_path)
    seen = walked(pipeline_command, tmp_path, COMMANDS[2:])
    for part in excerpts(slice(1, 3)):
        assert part in seen, part


def test_an_effect_of_ones_own_is_about_thirty_lines_outside_the_project(
    pipeline_command: Call, tmp_path: Path
) -> None:
    """Friction is no spring: it lowers the error by little, and the model goes on from its file."""
    bench(tmp_path)
    (tmp_path / "my_effect.py").write_text(EFFECT, encoding="utf-8")
    assert len(EFFECT.splitlines()) <= 30
    seen = walked(pipeline_command, tmp_path, [f"{OWN} --quiet"])
    assert "seal_spring" in seen and "N·mm/rad³" in seen
    saved = read_model_file(tmp_path / "examples" / "bench" / "model.toml")
    assert saved.model.names == ("seal_spring",) and saved.model.values[0] > 0.0
    assert "seals stiffen the hinges" in walked(
        pipeline_command, tmp_path, ["effects seal_spring --effects-from my_effect.py"]
    )
