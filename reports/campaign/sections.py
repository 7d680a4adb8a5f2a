"""The story of a campaign's page: which sections it has, in which order, and what each of them shows."""

from collections.abc import Iterator, Mapping
from math import ceil

from reports.blocks import (
    Block,
    Bullets,
    Code,
    Columns,
    Details,
    Explorer,
    Figure,
    Heading,
    Lead,
    Section,
    Tables,
    Text,
)
from reports.campaign import curve, dossier, doubt, first_picture, matrix, plots, tables, words
from reports.campaign.names import BEFORE, channel_label, measured, stages_of, test_label, worst
from reports.formats import number
from reports.laws import law_picture
from reports.load import Json

Pictures = Mapping[str, bytes]
MAP = "misfit"
"""Name of the map; a click on it chooses the curve."""
READINGS = 20_000
"""Readings that the page draws, some 110 bytes each; of more steps some are left out."""
NEAREST = 5
"""Candidates that are shown at once."""
CAPTION = "Measured, plain virtual springs and the model; below, what each leaves in sigmas."


def build(page: Json, pictures: Pictures) -> list[Section]:
    """All sections; pictures: PNG by name."""
    parts = [first(page)]
    if measured(page):
        parts += [misfit(page, pictures), curves(page, pictures)]
    parts.append(Section("candidates", "What could be missing", list(candidates(page, pictures))))
    if page["parameters"]:
        parts.append(Section("parameters", "Values", list(parameters(page))))
    if page.get("laws"):
        parts.append(Section("laws", "Laws found", list(found_laws(page))))
    if doubt.known(page):
        parts.append(Section("doubt", "The rig and the readings", list(doubt.blocks(page))))
    if page.get("dossier"):
        parts.append(Section("dossier", "Validation dossier", list(dossier.blocks(page["dossier"]))))
    return [*parts, record(page)]


def first(page: Json) -> Section:
    """What is to be seen without scrolling: the verdict, a picture, what is certain, what to do next."""
    left: list[Block] = []
    if sure := words.sure(page):
        left += [Heading("What is certain"), Bullets(sure)]
    if page.get("doctor"):
        left += [Heading("The table seems to have a mistake"), Bullets(doubt.mistakes(page))]
    left += [Heading("Next step"), *next_step(page)]
    right: list[Block] = []
    if measured(page):
        svg, png = first_picture.drawn(page)
        right = [Figure(first_picture.NAME, first_picture.caption(page), svg=svg, png=png)]
        left.append(tables.bars(page))
    more: list[Block] = [tables.summary(page)]
    said = words.others(page) or [f"{remark}." for remark in page["remarks"]]
    if said:
        more = [Bullets(said), *more]
    if page.get("rivals"):
        left.insert(0, tables.rivals(page))
    return Section(
        "verdict",
        words.heading(page),
        [Lead(words.headline(page)), Columns(left, right), Details("Why, and what the campaign is", more)],
    )


def next_step(page: Json) -> Iterator[Block]:
    """What to do next, with the command that does it."""
    found = page.get("following", ())
    for it in found:
        yield Text(it["words"])
        if it["command"]:
            yield Code(it["command"])
    if page["next_test"] is not None:
        yield Details("How to measure it", list(next_test(page)))
    if not found:
        yield Text(
            "None is needed: the model explains what was measured."
            if page["verdict"] == "within_noise"
            else "Measure what a model predicts."
            if not measured(page)
            else "None is known."
        )


def misfit(page: Json, pictures: Pictures) -> Section:
    """Where it fails."""
    caption = (
        "Root mean square of measured less predicted in each channel, in its own sigmas. White: noise; grey: up to 3 "
        "sigmas; coloured: misfit, the darker the more (k: thousand). Empty: prescribed or not measured. Tests held "
        "out stand below the line. A click shows the curve below."
    )
    drawn = Figure(MAP, caption, plots.misfit_map(page, stages_of(page["effects"])), png=pictures[MAP])
    more = [tables.tests(page, "fit"), *held_out(page), tables.stages(page)]
    return Section(
        "misfit", "Where it fails", [drawn, Details("Errors test by test, and as effects are added", more)]
    )


def curves(page: Json, pictures: Pictures) -> Section:
    """Every curve, and the worst as pictures."""
    caption = (
        "Measured with error bars of one sigma, noise of the inputs included, and each model over what drives the "
        "test; below, what each leaves, in sigmas; within the grey band noise stays in 95 % of steps. Lines join the "
        "steps in the order in which they were done, so that a loop is a loop. Drag to zoom, the three move together."
    )
    readings = sum(len(test["steps"]) * len(test["curves"]) for test in page["tests"])
    stride = max(1, ceil(readings / READINGS))
    if stride > 1:
        caption += f" Of so many steps one in {stride} is drawn; all are in page.json."
    stages = stages_of(page["effects"])
    plots_of = {
        (test_label(test), channel_label(it["channel"])): curve.figure(
            *curve.thinned(test, it, stride), stages=stages
        )
        for test in page["tests"]
        for it in test["curves"]
    }
    top, it = worst(page, 1)[0]
    first = (test_label(top), channel_label(it["channel"]))
    drawn = [Figure(name, CAPTION, png=png) for name, png in pictures.items() if name[:6] == "curve_"]
    explorer = Explorer("curves", caption, ("test", "channel"), plots_of, first, f"plot-{MAP}", tuple(drawn))
    return Section("curves", "Measured and predicted", [explorer])


def held_out(page: Json) -> Iterator[Block]:
    """Tests that nothing was fitted to."""
    if any(test["role"] == "holdout" for test in page["tests"]):
        yield tables.tests(page, "holdout")
    else:
        yield Text("No test was held out: nothing here says how the model predicts what it has not seen.")


def candidates(page: Json, pictures: Pictures) -> Iterator[Block]:
    """What was looked at, and what could be taken for what."""
    every = page["candidates"]
    if not every:
        yield Text("Not looked for: this page shows the model as it is saved. With --diagnose it looks.")
    else:
        near = [it for it in every if it["chosen"] or it["evidence"] is not None][:NEAREST]
        yield tables.candidates(page, near or every[:NEAREST])
        if len(every) > len(near):
            yield Details(f"All {len(every)} candidates", [tables.candidates(page, every)])
    if page.get("out_by_plausibility"):
        sets = [words.set_of(names, page.get("titles", {})) for names in page["out_by_plausibility"]]
        yield Text("These would fit as well, but only with an implausible size:")
        yield Bullets(sets)
    found = page["isolability"]
    if found is not None:
        about = words.set_of(found["about"], page.get("titles", {})) if found["about"] else BEFORE
        caption = (
            f"Which effect could be taken for which in these tests, about {about}: the correlation of what the effect "
            "of a row does, at its typical size, with the best that the effect of a column can do. Dark, near 1: these "
            "tests cannot tell them apart unless the effect is large. An empty row does not show at its typical size."
        )
        if found.get("anew"):
            caption += " Computed for this page: the saved answer does not hold it."
        drawn = Figure("isolability", caption, matrix.isolability(found), png=pictures["isolability"])
        yield Details("What could be taken for what", [drawn])


def parameters(page: Json) -> Iterator[Block]:
    """Values, what the effects are, and what goes with what."""
    yield tables.parameters(
        page, page["parameters"], "Fitted, with 95 % intervals; a dash where the data set no end"
    )
    told = words.evidence(page)
    titles = page.get("titles", {})
    if said := [
        f"{words.capital(words.title_of(name, titles))}: {text}" for name, text in told.items() if text
    ]:
        yield Bullets(said)
    if page["correlations"]:
        pairs = [
            f"{it['first']} and {it['second']}: correlation {it['value']:+.3f}."
            for it in page["correlations"]
        ]
        yield Details("Values whose errors go together", [Bullets(pairs)])


def found_laws(page: Json) -> Iterator[Block]:
    """What was discovered in what is left: where it sits, its form, its picture."""
    for at, law in enumerate(page["laws"], 1):
        said = law["where"] if law["equation"] is None else f"{law['where']}: {law['equation']}"
        yield Heading(f"{said[:1].upper()}{said[1:]}")
        yield Text(f"The readings say of it: {law['shape']}.")
        if law["parameters"]:
            yield tables.parameters(page, law["parameters"])
        if law["curve"] is not None:
            png = law_picture(page["campaign"], law)
            yield Figure(
                f"law_{at}", f"{law['site']}: the curve without a form, its band, and the law.", png=png
            )


def next_test(page: Json) -> Iterator[Block]:
    """What to measure next."""
    found, titles = page["next_test"], page.get("titles", {})
    yield Tables([tables.next_test(it) for it in (found, *found["together_with"])])
    yield Bullets(
        [
            f"It tells {words.set_of(a, titles)} from {words.set_of(b, titles)}: chi-square between them would be "
            f"{number(value, 3)}."
            for (a, b), value in zip(found["tells_apart"], found["expected_chi_square"], strict=True)
        ]
    )


def record(page: Json) -> Section:
    """What it rests on, and how to make the page again."""
    equations: list[Block] = [tables.equations(page)] if page["catalogue"] else []
    return Section(
        "record",
        "What it rests on",
        [
            Details("What was assumed", [Bullets(page["assumptions"]), tables.sigmas(page)]),
            Details("Equations and sources", [*equations, Bullets(page["sources"])]),
            Details("How to make it again", [Code("\n".join(page["commands"])), tables.versions(page)]),
        ],
    )
