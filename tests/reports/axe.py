"""axe-core in a page: what keeps somebody from reading or working it."""

from __future__ import annotations

from importlib.util import find_spec
from pathlib import Path
from typing import Any

import pytest

SPEC = find_spec("axe_playwright_python")
NEEDS_AXE = pytest.mark.skipif(
    SPEC is None, reason="axe-playwright-python is not installed, make setup installs it"
)
COUNTED = ("moderate", "serious", "critical")
RULES = """async () => (await axe.run(document, { resultTypes: ["violations"] })).violations"""


def findings(page: Any) -> list[str]:
    """Every finding that is more than minor: its impact, its rule, and the first places."""
    assert SPEC is not None and SPEC.origin is not None
    script = Path(SPEC.origin).parent / "axe.min.js"
    page.evaluate(script.read_text(encoding="utf-8"))
    return [
        f"{it['impact']} {it['id']}: {len(it['nodes'])} x {[node['html'][:160] for node in it['nodes'][:3]]}"
        for it in page.evaluate(RULES)
        if it["impact"] in COUNTED
    ]
