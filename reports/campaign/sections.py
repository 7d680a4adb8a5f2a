"""The story of a campaign's page: which sections it has, in which order, and what each of them shows."""

from collections.abc import Iterator, Mapping
from math import ceil

from reports.blocks import Block, Bullets, Code, Explorer, Figure, Lead, Section, Tables, Text
from reports.campaign import curve, doubt, matrix, plots, tables
from reports.campaign.names import channel_label, measured, test_label, worst
from reports.formats import number
from reports.load import Json

Pictures = Mapping[str, bytes]
MAP = "misfit"
"""Name of the map; a click on it chooses the curve."""
READINGS = 20_000
"""Readings that the page draws, some 110 bytes each; of more steps some are left out."""
CAPTION = "Measured, plain virtual springs and the model; below, what each leaves in sigmas."


def build(page: Json, pictures: Pictures) -> list[Section]:
    """All sections; pictures: PNG by name."""
    parts = [verdict(page)]
    if measured(page):
        parts += [waterfall(page, pictures), misfit(page, pictures), curves(page, pictures)]
    parts += [Section("held-out", "Tests held out", list(held_out(page)))]
    parts += [Section("candidates", "What could be missing", list(candidates(page, pictures)))]
    if page["parameters"]:
        parts.append(Section("parameters", "Parameters", list(parameters(page))))
    if doubt.known(page):
        parts.append(
            Section("doubt", "What was written, and what the readings are", list(doubt.blocks(page)))
        )
    parts.append(Section("next", "Next test", list(next_test(page))))
    parts.append(Section("assumed", "What was assumed", [Bullets(page["assumptions"]), tables.sigmas(page)]))
    return [*parts, sources(page), record(page)]


def verdict(page: Json) -> Section:
    """The answer first."""
    blocks: list[Block] = [Lead(page["headline"])]
    if page["sentences"]:
        blocks.append(Bullets(page["sentences"]))
    if not page["sentences"] and page["remarks"]:
        blocks.append(Bullets([f"{remark}." for remark in page["remarks"]]))
    return Section("verdict", "Verdict", [*blocks, tables.summary(page)])


def waterfall(page: Json, pictures: Pictures) -> Section:
    """How the error falls."""
    caption = (
        "Error of the fitted tests and of those held out, from plain virtual springs to the model, one effect more in "
        "each row, every row fitted. Logarithmic; the dashed line is noise."
    )
    drawn = Figure("waterfall", caption, plots.waterfall(page), png=pictures["waterfall"])
    return Section("error", "How the error falls", [drawn, tables.stages(page)])


def misfit(page: Json, pictures: Pictures) -> Section:
    """Where it fails."""
    caption = (
        "Root mean square of measured less predicted in each channel, in its own sigmas: 1 is noise, light; dark is "
        "misfit, logarithmic. Empty: prescribed or not measured. Tests held out stand below the line. A click shows "
        "the curve below."
    )
    drawn = Figure(MAP, caption, plots.misfit_map(page), png=pictures[MAP])
    return Section("misfit", "Where it fails", [drawn, tables.tests(page, "fit")])


def curves(page: Json, pictures: Pictures) -> Section:
    """Every curve, and the worst as pictures."""
    caption = (
        "Measured with error bars of one sigma, noise of the inputs included, and both models over what drives the "
        "test; below, what each leaves, in sigmas; within the grey band noise stays in 95 % of steps. Lines join the "
        "steps in the order in which they were done, so that a loop is a loop. Drag to zoom, the three move together."
    )
    readings = sum(len(test["steps"]) * len(test["curves"]) for test in page["tests"])
    stride = max(1, ceil(readings / READINGS))
    if stride > 1:
        caption += f" Of so many steps one in {stride} is drawn; all are in page.json."
    plots_of = {
        (test_label(test), channel_label(it["channel"])): curve.figure(*curve.thinned(test, it, stride))
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
    if page["candidates"]:
        yield tables.candidates(page)
        if page.get("out_by_plausibility"):
            yield Text("These would fit as well, but only with an implausible size:")
            yield Bullets([" + ".join(names) for names in page["out_by_plausibility"]])
    else:
        yield Text("Not looked for: this page shows the model as it is saved. With --diagnose it looks.")
    found = page["isolability"]
    if found is not None:
        about = " + ".join(found["about"]) or "plain virtual springs"
        caption = (
            f"Which effect could be taken for which in these tests, about {about}: the correlation of what the effect "
            "of a row does, at its typical size, with the best that the effect of a column can do. Dark, near 1: these "
            "tests cannot tell them apart unless the effect is large. An empty row does not show at its typical size."
        )
        if found.get("anew"):
            caption += " Computed for this page: the saved answer does not hold it."
        yield Figure("isolability", caption, matrix.isolability(found), png=pictures["isolability"])


def parameters(page: Json) -> Iterator[Block]:
    """Values and what goes with what."""
    yield tables.parameters(page)
    if page["correlations"]:
        yield Bullets(
            [
                f"{it['first']} and {it['second']}: correlation {it['value']:+.3f}."
                for it in page["correlations"]
            ]
        )


def next_test(page: Json) -> Iterator[Block]:
    """What to measure next."""
    found = page["next_test"]
    if found is None:
        said = {
            "identified": "None is needed to tell the candidates apart: no rival fits as well.",
            "within_noise": "None is needed: the model explains what was measured.",
            "nothing_tested": "Any with readings that no unknown zero takes: these tests test nothing.",
        }
        unknown = "No test of the menu is known to help." if page["diagnosed"] else "Not looked for."
        yield Text(said.get(page["verdict"], unknown))
        return
    yield Tables([tables.next_test(it) for it in (found, *found["together_with"])])
    yield Bullets(
        [
            f"It tells {' + '.join(a)} from {' + '.join(b)}: chi-square between them would be {number(value, 3)}."
            for (a, b), value in zip(found["tells_apart"], found["expected_chi_square"], strict=True)
        ]
    )


def sources(page: Json) -> Section:
    """Equations and where they come from."""
    blocks: list[Block] = [tables.equations(page)] if page["catalogue"] else []
    return Section("sources", "Equations and sources", [*blocks, Bullets(page["sources"])])


def record(page: Json) -> Section:
    """How to make the page again."""
    return Section(
        "record", "How to make it again", [Code("\n".join(page["commands"])), tables.versions(page)]
    )
