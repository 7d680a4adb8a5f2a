"""A campaign that is dropped on the page: laid aside whole, and never over another one."""

from __future__ import annotations

from pathlib import Path

import pytest

from pipeline.errors import InputError
from pipeline.studio.drop import lay


def dropped(**files: str) -> list[dict[str, object]]:
    names = {"campaign": "campaign.toml", "measurements": "measurements.csv", "notes": "notes.txt"}
    return [{"name": names[key], "content": text.encode()} for key, text in files.items()]


def test_both_files_lie_in_a_folder_with_the_name_of_the_campaign(tmp_path: Path) -> None:
    folder = lay(dropped(campaign='name = "../rig 7"', measurements="test,step"), tmp_path)
    assert folder == tmp_path / "___rig_7"
    assert (folder / "campaign.toml").read_text() == 'name = "../rig 7"'
    assert (folder / "measurements.csv").read_text() == "test,step"


def test_the_same_campaign_keeps_its_folder_and_another_gets_its_own(tmp_path: Path) -> None:
    first = lay(dropped(campaign='name = "a"', measurements="1"), tmp_path)
    (first / "model.toml").write_text("kept")
    assert lay(dropped(campaign='name = "a"', measurements="1"), tmp_path) == first
    other = lay(dropped(campaign='name = "a"', measurements="2"), tmp_path)
    assert other != first and (first / "measurements.csv").read_text() == "1"
    assert (first / "model.toml").read_text() == "kept" and not (other / "model.toml").exists()


@pytest.mark.parametrize("files", [{"campaign": "x"}, {"campaign": "x", "notes": "y"}, {}])
def test_anything_else_is_refused(tmp_path: Path, files: dict[str, str]) -> None:
    with pytest.raises(InputError, match=r"allowed are campaign\.toml and"):
        lay(dropped(**files), tmp_path)
    assert list(tmp_path.iterdir()) == []


def test_a_file_that_is_no_toml_has_its_complaint_when_it_is_read(tmp_path: Path) -> None:
    assert lay(dropped(campaign="= =", measurements=""), tmp_path).name == "campaign"
