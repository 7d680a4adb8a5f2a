"""Forms of laws that may be placed at a site: every law class in a module beside this one is found by itself."""

from importlib import import_module
from inspect import isabstract, isclass
from pkgutil import iter_modules

from fem.frame.laws.form import Law


def forms() -> dict[str, type[Law]]:
    """The law classes by their names, in alphabetical order."""
    modules = [import_module(f"{__name__}.{info.name}") for info in iter_modules(__path__)]
    found = {
        name: it
        for module in modules
        for name, it in vars(module).items()
        if isclass(it) and issubclass(it, Law) and not isabstract(it) and it.__module__ == module.__name__
    }
    return dict(sorted(found.items()))
