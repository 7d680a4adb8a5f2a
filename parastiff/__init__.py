"""parastiff: stiffness models of linkages beside finite elements and measurements.

The public names, each imported when it is first asked for:

    import parastiff

    campaign = parastiff.read(Path("bench"))
    known = parastiff.known_effects()
    found = parastiff.diagnose(campaign, parastiff.Model(), known.effects)
    print(parastiff.answered(found).sentences)

An effect of one's own is a class that inherits from `parastiff.Effect`.
"""

from importlib import import_module

_PUBLIC = {
    "Effect": "vjm.effects.base",
    "Parameter": "vjm.effects.base",
    "SiteLaw": "vjm.site_law",
    "catalogue": "vjm.effects",
    "Campaign": "pipeline.campaign",
    "read": "pipeline.campaign",
    "Model": "pipeline.inference.model",
    "Term": "pipeline.inference.model",
    "known_effects": "pipeline.inference.suitable",
    "compare_models": "pipeline.compare.models",
    "add": "pipeline.add.fitting",
    "diagnose": "pipeline.diagnose.diagnosis",
    "answered": "pipeline.diagnose.words",
    "plan_of": "pipeline.plan.command",
    "InputError": "pipeline.errors",
    # What an effect of one's own is made of.
    "for_bars": "vjm.effects.base",
    "adding": "vjm.effects.base",
    "laws": "vjm.laws",
    "sensors": "vjm.sensors",
    "frames": "vjm.frames",
}
__all__ = sorted(_PUBLIC)


def __getattr__(name: str) -> object:
    if name not in _PUBLIC:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    module = import_module(_PUBLIC[name])
    value = module if module.__name__.rpartition(".")[2] == name else getattr(module, name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return [*globals(), *__all__]
