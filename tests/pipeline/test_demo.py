"""The demo: the shipped campaign is copied, compared, improved and compared again; nothing is overwritten."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from pipeline.demo import SHIPPED, demo
from pipeline.errors import InputError
from tests.conftest import Done


def test_a_folder_that_is_there_is_left_alone(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="is there already"):
        demo(tmp_path)
    assert not list(tmp_path.iterdir()) and (SHIPPED / "campaign.toml").is_file()


@pytest.mark.long
def test_the_way_is_gone_once(tmp_path: Path, pipeline_command: Callable[..., Done]) -> None:
    done = pipeline_command("demo", "try", "--quiet", cwd=tmp_path)
    assert done.code == 0, done.err
    assert "456 settled load steps" in done.out and "$ python -m pipeline improve try" in done.out
    assert "joint_friction" in (tmp_path / "try" / "model.toml").read_text() and "next: " in done.out
