"""The versions that the set-up installs run on the Python of a bare Debian 12, which is older than the newest 3.11."""

from __future__ import annotations

from importlib.metadata import distribution

from packaging.requirements import Requirement
from packaging.specifiers import SpecifierSet

from tests.parastiff.installed import ROOT

DEBIAN = "3.11.2"
"""Of Debian 12: packages.debian.org/bookworm/python3."""


def test_every_pinned_version_is_for_the_python_of_debian() -> None:
    lines = (ROOT / "constraints.txt").read_text().splitlines()
    pins = [Requirement(line) for line in lines if line and not line.startswith("#")]
    installed = [(pin, distribution(pin.name)) for pin in pins if not pin.marker or pin.marker.evaluate()]
    assert len(installed) > 100
    assert [pin.name for pin, it in installed if it.version not in pin.specifier] == []
    needs = {pin.name: it.metadata.get("Requires-Python") or "" for pin, it in installed}
    assert {name: need for name, need in needs.items() if DEBIAN not in SpecifierSet(need)} == {}
