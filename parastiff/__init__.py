"""parastiff: stiffness models of linkages beside finite elements and measurements.

    import parastiff

    bench = parastiff.open("bench")
    found = bench.diagnose()
    print(found)
    found.plot().savefig("found.png")

Every name is imported when it is first asked for. An effect of one's own is a class that inherits from
`parastiff.Effect`.
"""

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    # For type checkers and editors; the table below is what is imported.
    from meshes import section as sections
    from pipeline.campaign import Campaign
    from pipeline.errors import InputError
    from pipeline.face import rigs
    from pipeline.face.additions import Addition, add, improve, remove
    from pipeline.face.bars import BarStiffness, OwnBar, bar, identify_bar
    from pipeline.face.bench import Bench
    from pipeline.face.bench import open_bench as open
    from pipeline.face.comparisons import Comparison, compare
    from pipeline.face.diagnoses import Diagnosis, UndecidedError, diagnose
    from pipeline.face.discoveries import Discovery, discover
    from pipeline.face.effects import Catalogue, catalogue
    from pipeline.face.exports import export
    from pipeline.face.linkages import Linkage, linkage
    from pipeline.face.plans import Plan, plan
    from pipeline.face.predictions import Prediction, predict
    from pipeline.face.simulations import VirtualBench, simulate
    from pipeline.face.subject import campaign_of as read
    from pipeline.inference.model import Model, Term
    from vjm import frames, laws, sensors
    from vjm.effects.base import Effect, Parameter, adding, for_bars
    from vjm.site_law import SiteLaw

_PUBLIC = {
    # A bench and what is asked of it.
    "open": ("pipeline.face.bench", "open_bench"),
    "read": ("pipeline.face.subject", "campaign_of"),
    "compare": ("pipeline.face.comparisons", "compare"),
    "diagnose": ("pipeline.face.diagnoses", "diagnose"),
    "add": ("pipeline.face.additions", "add"),
    "remove": ("pipeline.face.additions", "remove"),
    "improve": ("pipeline.face.additions", "improve"),
    "plan": ("pipeline.face.plans", "plan"),
    "predict": ("pipeline.face.predictions", "predict"),
    "discover": ("pipeline.face.discoveries", "discover"),
    "simulate": ("pipeline.face.simulations", "simulate"),
    "export": ("pipeline.face.exports", "export"),
    "catalogue": ("pipeline.face.effects", "catalogue"),
    # A design.
    "rigs": ("pipeline.face.rigs", ""),
    "sections": ("meshes.section", ""),
    "bar": ("pipeline.face.bars", "bar"),
    "identify_bar": ("pipeline.face.bars", "identify_bar"),
    "linkage": ("pipeline.face.linkages", "linkage"),
    # What these give.
    "Bench": ("pipeline.face.bench", "Bench"),
    "VirtualBench": ("pipeline.face.simulations", "VirtualBench"),
    "Comparison": ("pipeline.face.comparisons", "Comparison"),
    "Diagnosis": ("pipeline.face.diagnoses", "Diagnosis"),
    "Addition": ("pipeline.face.additions", "Addition"),
    "Plan": ("pipeline.face.plans", "Plan"),
    "Prediction": ("pipeline.face.predictions", "Prediction"),
    "Discovery": ("pipeline.face.discoveries", "Discovery"),
    "Catalogue": ("pipeline.face.effects", "Catalogue"),
    "OwnBar": ("pipeline.face.bars", "OwnBar"),
    "BarStiffness": ("pipeline.face.bars", "BarStiffness"),
    "Linkage": ("pipeline.face.linkages", "Linkage"),
    "Campaign": ("pipeline.campaign", "Campaign"),
    "Model": ("pipeline.inference.model", "Model"),
    "Term": ("pipeline.inference.model", "Term"),
    "InputError": ("pipeline.errors", "InputError"),
    "UndecidedError": ("pipeline.face.diagnoses", "UndecidedError"),
    # What an effect of one's own is made of.
    "Effect": ("vjm.effects.base", "Effect"),
    "Parameter": ("vjm.effects.base", "Parameter"),
    "SiteLaw": ("vjm.site_law", "SiteLaw"),
    "for_bars": ("vjm.effects.base", "for_bars"),
    "adding": ("vjm.effects.base", "adding"),
    "laws": ("vjm.laws", ""),
    "sensors": ("vjm.sensors", ""),
    "frames": ("vjm.frames", ""),
}
"""Module and name there of each; without a name it is the module itself."""
__all__ = [
    "Addition",
    "BarStiffness",
    "Bench",
    "Campaign",
    "Catalogue",
    "Comparison",
    "Diagnosis",
    "Discovery",
    "Effect",
    "InputError",
    "Linkage",
    "Model",
    "OwnBar",
    "Parameter",
    "Plan",
    "Prediction",
    "SiteLaw",
    "Term",
    "UndecidedError",
    "VirtualBench",
    "add",
    "adding",
    "bar",
    "catalogue",
    "compare",
    "diagnose",
    "discover",
    "export",
    "for_bars",
    "frames",
    "identify_bar",
    "improve",
    "laws",
    "linkage",
    "open",
    "plan",
    "predict",
    "read",
    "remove",
    "rigs",
    "sections",
    "sensors",
    "simulate",
]


def __getattr__(name: str) -> object:
    if name not in _PUBLIC:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    place, inside = _PUBLIC[name]
    module = import_module(place)
    value = getattr(module, inside) if inside else module
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return [*globals(), *__all__]
