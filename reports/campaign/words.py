"""What a page says in words for people: titles of effects in the place of their code names."""

import re
from collections.abc import Mapping

from reports.campaign.names import measured
from reports.load import Json
from reports.quantities import FIXED, NOT_DETERMINED, estimate, interval_text, phrase

PLAIN = "the model as it stands"
_UNIT = r"(?:Nmm|mm|rad|deg|N|K|C)(?:\d+)?"
_PARAMETER = re.compile(rf"\b([a-z]\w*?)_{_UNIT}(?:_per_\w+)?(?= (?:=|not determined|fixed|at its bound))")


def named(text: str, titles: Mapping[str, str]) -> str:
    """A sentence with titles in the place of code names, and parameters without their units, which stand behind."""
    if titles:
        every = "|".join(re.escape(name) for name in sorted(titles, key=len, reverse=True))
        text = re.sub(rf"(?<![\w@.])({every})(?![\w@])", lambda found: titles[found[1]], text)
    for word, said in (("within_noise", "within noise"), ("nothing_tested", "nothing tested")):
        text = text.replace(word, said)
    text = _PARAMETER.sub(lambda found: found[1].replace("_", " "), text)
    return text[:1].upper() + text[1:]


def title_of(name: str, titles: Mapping[str, str]) -> str:
    """An effect in words; one without any by its code name."""
    return titles.get(name, name)


def listed(names: list[str]) -> str:
    """One, two and three."""
    *others, last = names
    return f"{', '.join(others)} and {last}" if others else last


def set_of(names: list[str] | tuple[str, ...], titles: Mapping[str, str]) -> str:
    """A set of effects in words."""
    return listed([title_of(name, titles) for name in names]) if names else "no further effect"


def headline(page: Json) -> str:
    """The verdict in one sentence."""
    said = str(page["headline"])
    if page["diagnosed"] or measured(page):
        said = said.replace(" + ", " and ")
    if page["verdict"] == "ambiguous" and page["diagnosed"]:
        said = said.replace(" or ", ", or ")
    return named(said, page.get("titles", {}))


def heading(page: Json) -> str:
    """What the first section is called: only a diagnosis gives a verdict."""
    return "Verdict" if page["diagnosed"] else "Where the model stands"


def evidence(page: Json) -> dict[str, str]:
    """What the diagnosis says of each effect of the model beside what the catalogue says."""
    told = {}
    for it in page["catalogue"]:
        begin = _catalogue_words(it)
        for said in page["sentences"]:
            if said.startswith(begin):
                rest = re.sub(r" Fitted: .*?(?:\.$|\. (?=Only ))", " ", said.removeprefix(begin) + "")
                told[it["name"]] = rest.strip()
    return told


def others(page: Json) -> list[str]:
    """The sentences but those that stand elsewhere on the page, in words."""
    begins = tuple(_catalogue_words(it) for it in page["catalogue"])
    kept = [said for said in page["sentences"] if not (begins and said.startswith(begins))]
    return [named(said, page.get("titles", {})) for said in kept]


def _catalogue_words(it: Json) -> str:
    return f"{it['name']}: {it['title']}, {it['equation']}. In data: {it['signature']}."


def values(parameters: Json, effect: str) -> str:
    """What each parameter of an effect is that the readings see, its value with its unit and its 95 % interval."""
    own = [it for name, it in parameters.items() if name.rpartition(".")[0] == effect]
    seen = [it for it in own if interval_text(estimate(it)) not in (FIXED, NOT_DETERMINED)]
    told = [f"{it['meaning']} {phrase('', estimate(it), it['unit']).removeprefix(' = ')}" for it in seen]
    return ", ".join(told) + (f"; not seen: {len(own) - len(seen)}" if 0 < len(seen) < len(own) else "")


def sure(page: Json) -> list[str]:
    """What is certain, a sentence each."""
    titles = page.get("titles", {})
    certain = [it["effect"] for it in page.get("certain", ())]
    if not page["diagnosed"] or page["verdict"] == "nothing_tested":
        return []
    if page["verdict"] == "identified":
        certain = list(dict.fromkeys([*(page["proposed"] or page["effects"]), *certain]))
    if page["verdict"] == "within_noise" and not certain:
        return ["The model explains what was measured: no effect is missing that these tests can show."]
    if not certain:
        return [
            "That something is missing; which of these it is, the tests do not tell."
            if page.get("rivals")
            else "That something is missing."
        ]
    out = []
    for name in certain:
        numbers = values(page["parameters"], name)
        out.append(f"{capital(title_of(name, titles))}{f': {numbers}' if numbers else ''}.")
    return out


def capital(text: str) -> str:
    """As a sentence begins."""
    return text[:1].upper() + text[1:]
