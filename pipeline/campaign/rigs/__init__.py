"""The kinds of rigs. Each is one file here that defines `TABLE`, its table in campaign.toml; it is found by itself."""

from importlib import import_module
from pkgutil import iter_modules

from pipeline.campaign.rig_table import RigTable

_FILES = [import_module(f"{__name__}.{module.name}") for module in iter_modules(__path__)]
KINDS: dict[str, type[RigTable]] = {
    file.TABLE.model_fields["kind"].annotation.__args__[0]: file.TABLE
    for file in _FILES
    if hasattr(file, "TABLE")
}
"""Tables by the kind that they name."""
