"""What somebody wrote down about a rig and may be a little off: changes of a mechanism, small and of either sign.

They are effects in all but one thing: nobody looks for them. Each parameter has a nominal value and a standard
deviation, and is estimated beside whatever is looked for (a nuisance parameter). Every module beside this one that
defines a tolerance belongs to them.
"""

from __future__ import annotations

import importlib
import pkgutil
from functools import cache

from vjm.effects import defined_in
from vjm.tolerances.base import Tolerance


@cache
def tolerances() -> tuple[Tolerance, ...]:
    """All of this package, in alphabetical order of their modules."""
    names = sorted(info.name for info in pkgutil.iter_modules(__path__))
    modules = (importlib.import_module(f"{__name__}.{name}") for name in names)
    return tuple(it for module in modules for it in defined_in(module) if isinstance(it, Tolerance))
