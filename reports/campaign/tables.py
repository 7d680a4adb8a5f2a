"""Tables of a campaign's page."""

from collections.abc import Iterator, Sequence

from reports.blocks import Bar, Bars, Cell, Column, Table, table
from reports.campaign.names import BEFORE, channel_label, place, unit_label
from reports.campaign.words import set_of, title_of, values
from reports.formats import DASH, count, number
from reports.load import Json
from reports.quantities import NONE, ends_text, estimate, marks, p_value, std_text, value_text
from reports.quantities import sigma as plain_sigma
from reports.tables_record import pairs


def sigma(value: float | None) -> str:
    """An error, as everywhere."""
    return _set(plain_sigma(value))


def summary(page: Json) -> Table:
    """What the page is about."""
    rig, tests = page["rig"], page["tests"]
    width = "" if rig["width_mm"] is None else f", {rig['width_mm']:g} mm apart"
    held_out = sum(test["role"] == "holdout" for test in tests)
    return pairs(
        "The campaign",
        "what",
        "value",
        {
            "campaign": page["campaign"],
            "rig": f"{rig['kind']}, L = {rig['length_mm']:g} mm{width}",
            "tests": f"{len(tests)}, {held_out} of them held out",
            "load steps": count(sum(len(test["steps"]) for test in tests)),
            "model": " + ".join(page["effects"]) or BEFORE,
            **(
                {"proposed, not yet in the model's file": " + ".join(page["proposed"])}
                if page["proposed"]
                else {}
            ),
        },
    )


def stages_of(page: Json) -> Iterator[tuple[str, str, Json]]:
    """Every stage of the error in words, by its code names, and what it leaves."""
    seen = set[str]()
    for stage in page["error"]:
        new = [name for name in stage["effects"] if name not in seen]
        seen |= set(new)
        words = " and ".join(title_of(name, page.get("titles", {})) for name in new)
        yield (f"with {words}" if new else BEFORE), " + ".join(new), stage


def bars(page: Json) -> Bars:
    """The error as effects are added."""
    rows = [Bar(words, code, (stage["fit"], stage["holdout"])) for words, code, stage in stages_of(page)]
    return Bars(("fitted", "held out"), rows)


def stages(page: Json) -> Table:
    """The error as effects are added."""
    columns = [
        Column("model", numeric=False),
        Column("fitted tests", "sigma"),
        Column("held-out tests", "sigma"),
        Column("chance that noise is as large", "p"),
        Column("chance that noise is as smooth", "p"),
    ]
    rows = []
    for label, code, stage in stages_of(page):
        lost = f"{len(stage['lost'])} tests with rows that have no prediction" if stage["lost"] else ""
        rows.append(
            [
                Cell(label, lost, code),
                *(Cell(sigma(stage[key])) for key in ("fit", "holdout")),
                *(Cell(_set(p_value(stage[key]))) for key in ("chi_square_p", "lag_one_p")),
            ]
        )
    return table("Error in sigmas, 1 is noise", columns, rows)


def tests(page: Json, role: str) -> Table:
    """Every test of a role before and after."""
    columns = [
        Column("test", numeric=False),
        Column("place", numeric=False) if _moves(page) else Column("q", "°"),
        Column("driven by", numeric=False),
        Column("steps"),
        Column("before", "sigma"),
        Column("after", "sigma"),
    ]
    rows = [
        [
            Cell(
                test["test"], f"{test['lost_after']} steps without prediction" if test["lost_after"] else ""
            ),
            Cell(place(test) if _moves(page) else f"{test['q_deg']:g}".replace("-", "−")),
            Cell(f"{channel_label(test['load'])}, {unit_label(test['load_unit'])}"),
            Cell(str(len(test["steps"]))),
            Cell(sigma(test["error_before"])),
            Cell(sigma(test["error_after"])),
        ]
        for test in page["tests"]
        if test["role"] == role
    ]
    caption = (
        "Tests that were fitted" if role == "fit" else "Tests that were held out: never used to fit or choose"
    )
    return table(caption, columns, rows)


def candidates(page: Json, some: Sequence[Json]) -> Table:
    """What was looked at, best first, and why each was chosen or lost. some: of the page's candidates."""
    columns = [
        Column("effect", numeric=False),
        Column("promised", "sigma"),
        Column("fitted", "sigma"),
        Column("tests left out", "sigma"),
        Column("BIC behind"),
        Column("why", numeric=False),
    ]
    rows = [
        [
            Cell(f"{'✓ ' if it['chosen'] else ''}{it['title']}", "", it["effect"]),
            *(Cell(sigma(it[key])) for key in ("screen", "fit", "crossvalidated")),
            Cell(number(it["evidence"], 3)),
            Cell(it["why"]),
        ]
        for it in some
    ]
    notes = (
        "Promised: the error to first order. Tests left out: the error in tests that the fit did not see, each left "
        "out in turn. BIC behind: of the best set with this effect, behind the best of all.",
    )
    return table("", columns, rows, *notes)


def parameters(page: Json, values: Json, caption: str = "") -> Table:
    """Values with 95 % intervals."""
    columns = [
        Column("what", numeric=False),
        Column("value"),
        Column("standard error"),
        Column("95 % from"),
        Column("to"),
        Column("unit", numeric=False),
    ]
    rows = []
    for name, it in values.items():
        known = estimate(it)
        rows.append(
            [
                Cell(it["meaning"], ", ".join(marks(known)), name),
                Cell(_set(value_text(known, number))),
                Cell(_set(std_text(known, number))),
                *(Cell(_set(end)) for end in ends_text(known, number)),
                Cell("" if it["unit"] == "1" else it["unit"]),
            ]
        )
    return table(caption, columns, rows)


def rivals(page: Json) -> Table:
    """Sets that explain the readings alike, side by side."""
    columns = [
        Column("set", numeric=False),
        Column("fitted", "sigma"),
        Column("held out", "sigma"),
        Column("values, 95 % intervals", numeric=False),
    ]
    rows = [
        [
            Cell(set_of(it["effects"], page["titles"]), "", " + ".join(it["effects"])),
            Cell(sigma(it["error"]["fit"])),
            Cell(sigma(it["error"]["holdout"])),
            Cell("; ".join(values(it["parameters"], name) for name in it["effects"]).strip("; ")),
        ]
        for it in page["rivals"]
    ]
    return table("Sets that explain the readings alike", columns, rows)


def sigmas(page: Json) -> Table:
    """Noise of every column."""
    columns = [
        Column("channel", numeric=False),
        Column("sigma"),
        Column("unit", numeric=False),
        Column("", numeric=False),
    ]
    rows = [
        [
            channel_label(it["column"]),
            number(it["value"], 3),
            unit_label(it["unit"]),
            "given" if it["given"] else "estimated",
        ]
        for it in page["sigmas"]
    ]
    return table("Noise of the sensors", columns, rows)


def equations(page: Json) -> Table:
    """The effects of the model as the catalogue has them."""
    keys = {"name": "effect", "equation": "equation", "signature": "what it looks like", "source": "source"}
    columns = [Column(title, numeric=False) for title in keys.values()]
    rows = [
        [Cell(it["title"], "", it["name"]) if key == "name" else Cell(it[key]) for key in keys]
        for it in page["catalogue"]
    ]
    return table("Effects of the model", columns, rows)


def next_test(found: Json) -> Table:
    """What the next test prescribes."""
    columns = [Column("coordinate", numeric=False), Column("prescribed", numeric=False)]
    rows = [[name, str(by)] for name, by in found["control"].items()]
    return table(f"{found['why']}", columns, rows)


def versions(page: Json) -> Table:
    """Versions and commit."""
    return pairs("Versions", "package", "version", {**page["versions"], "commit": page["commit"]})


def _moves(page: Json) -> bool:
    """Whether tests differ in where the platform stands, and not in an angle."""
    return any(test["rig"].get("place_mm") is not None for test in page["tests"])


def _set(text: str) -> str:
    """A text for terminals as pages have it."""
    return DASH if text == NONE else text
