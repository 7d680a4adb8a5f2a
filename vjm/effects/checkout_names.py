"""A user's file that imports `vjm` as in a checkout loads where everything is installed under one name as well."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from importlib import import_module
from importlib.abc import Loader, MetaPathFinder
from importlib.machinery import ModuleSpec
from types import ModuleType

OLD = "vjm"
ABOVE = __name__.removesuffix(f"{OLD}.effects.checkout_names")
"""What stands before the package's name: nothing in a checkout."""


class CheckoutNames(MetaPathFinder, Loader):
    """Finds `vjm` and what is in it by their names in a checkout. asked: whether anything was."""

    asked = False

    def find_spec(
        self, fullname: str, path: Sequence[str] | None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        """Of such a name; what else is on the machine under it comes first, as this is the last one asked."""
        if fullname.partition(".")[0] != OLD:
            return None
        self.asked = True
        return ModuleSpec(fullname, self, is_package=True)

    def exec_module(self, module: ModuleType) -> None:
        """Gives the module the same names as the one installed, so that a class is one class."""
        there = import_module(f"{ABOVE}{module.__name__}")
        module.__dict__.update({k: v for k, v in vars(there).items() if not k.startswith("__")})


def install() -> CheckoutNames:
    """The finder, the last one asked; it stays, as a file may import while its effect is applied."""
    found = next((it for it in sys.meta_path if isinstance(it, CheckoutNames)), None)
    if found is None:
        found = CheckoutNames()
        sys.meta_path.append(found)
    return found
