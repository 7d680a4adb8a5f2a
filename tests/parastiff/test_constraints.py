"""The versions that the set-up installs run on the oldest Python that is allowed and on that of a bare Debian 12."""

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
    own = {pin.name: distribution(pin.name) for pin in pins if pin.marker is None or pin.marker.evaluate()}
    assert len(own) > 100
    assert {name: it.version for name, it in own.items() if it.version not in own_pins(pins, name)} == {}
    needs = {name: it.metadata.get("Requires-Python") or "" for name, it in own.items()}
    assert {name: need for name, need in needs.items() if DEBIAN not in SpecifierSet(need)} == {}


def own_pins(pins: list[Requirement], name: str) -> SpecifierSet:
    """What the list says of a package."""
    return next(pin.specifier for pin in pins if pin.name == name)
