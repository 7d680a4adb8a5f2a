"""Exported decks under six unit loads in CalculiX, whose .dat file has seven digits."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from tests.peers import calculix
from tests.peers.export import CASES, LIMIT, loaded, source, wanted
from tests.pipeline.export.sources import relative_error

pytestmark = pytest.mark.skipif(calculix.CCX is None, reason="CalculiX (ccx) is not installed")


@pytest.mark.parametrize("case", CASES)
def test_six_unit_loads(case: str, tmp_path: Path) -> None:
    it, path = source(case, "inp", tmp_path)
    # Memory and time go with the largest number of a node.
    text = re.sub(r"\b900(\d{3})\b", r"1\1", path.read_text())
    deck = [*text.splitlines(), "*NSET, NSET=LOADED", "TIP, TIPROT", "*BOUNDARY"]
    for number in ("", "2")[: len(it.springs)]:
        deck += [f"BASE{number},1,3", f"BASEROT{number},1,3"]
    if len(it.springs) == 2:
        deck += ["TIP2,1,3", "TIPROT2,1,3"]
    free = loaded(it)
    deck += [f"TIP,{axis},{axis}" for axis in (1, 2, 3) if axis - 1 not in free]
    for direction in free:
        name, axis = ("TIP", "TIPROT")[direction // 3], direction % 3 + 1
        deck += ["*STEP", "*STATIC", "*CLOAD, OP=NEW", f"{name},{axis},1."]
        deck += ["*NODE PRINT, NSET=LOADED", "U", "*END STEP"]
    found = calculix.nodal(calculix.run(deck, tmp_path).read_text(), 2).reshape(len(free), 6)[:, free].T
    assert relative_error(found, wanted(it)) < LIMIT
