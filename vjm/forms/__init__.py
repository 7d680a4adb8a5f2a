"""Forms of laws: every module beside this one that defines a form belongs to them, and is found by itself."""

from __future__ import annotations

import importlib
import inspect
import pkgutil
from collections.abc import Mapping
from functools import lru_cache
from types import MappingProxyType

from vjm.forms.base import Form
from vjm.forms.curve import CurveForm
from vjm.forms.with_linear import WithLinear


@lru_cache(maxsize=1)
def forms() -> Mapping[str, Form]:
    """All of them by name, those with a linear part beside them included."""
    modules = [importlib.import_module(f"{__name__}.{info.name}") for info in pkgutil.iter_modules(__path__)]
    found = {}
    for module in modules:
        for kind in vars(module).values():
            if _is_form(kind) and kind.__module__ == module.__name__:
                found[kind.name] = kind()
    beside = {
        f"linear+{name}": WithLinear(form)
        for name, form in found.items()
        if form.and_linear and isinstance(form, CurveForm)
    }
    return MappingProxyType(dict(sorted((found | beside).items())))


def _is_form(kind: object) -> bool:
    return (
        inspect.isclass(kind)
        and issubclass(kind, Form)
        and not inspect.isabstract(kind)
        and hasattr(kind, "name")
    )
