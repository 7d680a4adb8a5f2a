"""`demo`: the shipped campaign is copied, and the way from readings to a model that explains them is gone once."""

from __future__ import annotations

import shutil
from pathlib import Path

from pipeline.campaign.reading import MEASUREMENTS
from pipeline.command import usable
from pipeline.errors import InputError
from pipeline.typed import command

SHIPPED = Path(__file__).resolve().parents[1] / "examples" / "bench"


def demo(folder: Path, quiet: bool = False) -> None:
    """Copy the campaign and show what each command says of it. InputError where the folder is there already."""
    if folder.exists():
        raise InputError(f"{folder} is there already, allowed is a folder that is not")
    usable(folder, f"the folder {folder}")
    shutil.copytree(SHIPPED, folder)
    from pipeline.compare.command import compare
    from pipeline.improve.command import improve_campaign

    rows = len((folder / MEASUREMENTS).read_text(encoding="utf-8").splitlines()) - 1
    print(
        f"{folder}: a bench of two bars and four hinges, {rows} settled load steps, made by finite elements"
    )
    print(f"\n$ {command('compare', folder)}", flush=True)
    compare(folder, quiet=quiet)
    print(f"\n$ {command('improve', folder)}", flush=True)
    improve_campaign(folder, quiet=quiet)
    print(f"\n$ {command('compare', folder)}", flush=True)
    compare(folder, quiet=quiet)
    print(f"\nnext: {command('report', folder)}", flush=True)
