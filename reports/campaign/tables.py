"""Tables of a campaign's page."""

from reports.blocks import Cell, Column, Table, table
from reports.campaign.names import channel_label, place, stage_labels, unit_label
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
            "model": " + ".join(page["effects"]) or "plain virtual springs",
            **({"not yet in model.toml": " + ".join(page["proposed"])} if page["proposed"] else {}),
        },
    )


def stages(page: Json) -> Table:
    """The error as effects are added."""
    columns = [
        Column("model", numeric=False),
        Column("fitted tests", "sigma"),
        Column("held-out tests", "sigma"),
        Column("noise is so large", "p"),
        Column("noise is so smooth", "p"),
    ]
    rows = []
    for label, stage in zip(stage_labels(page), page["error"], strict=True):
        lost = f"{len(stage['lost'])} tests with rows that have no prediction" if stage["lost"] else ""
        rows.append(
            [
                Cell(label, lost),
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


def candidates(page: Json) -> Table:
    """What was looked at, best first, and why each was chosen or lost."""
    columns = [
        Column("effect", numeric=False),
        Column("first order", "sigma"),
        Column("fitted", "sigma"),
        Column("tests left out", "sigma"),
        Column("evidence", "BIC behind"),
        Column("why", numeric=False),
    ]
    rows = [
        [
            Cell(it["effect"], "✓" if it["chosen"] else ""),
            *(Cell(sigma(it[key])) for key in ("screen", "fit", "crossvalidated")),
            Cell(number(it["evidence"], 3)),
            Cell(f"{it['title']}; {it['why']}"),
        ]
        for it in page["candidates"]
    ]
    notes = (
        "First order: what the linear look promises with this effect. Tests left out: error in tests that the fit did "
        "not see, each left out in turn.",
    )
    return table("Candidates", columns, rows, *notes)


def parameters(page: Json) -> Table:
    """Values with 95 % intervals."""
    columns = [
        Column("effect", numeric=False),
        Column("parameter", numeric=False),
        Column("value"),
        Column("standard error"),
        Column("95 % from"),
        Column("to"),
        Column("unit", numeric=False),
        Column("meaning", numeric=False),
    ]
    rows, last = [], ""
    for name, it in page["parameters"].items():
        effect, _, parameter = name.rpartition(".")
        known = estimate(it)
        rows.append(
            [
                Cell("" if effect == last else effect),
                Cell(parameter, ", ".join(marks(known))),
                Cell(_set(value_text(known, number))),
                Cell(_set(std_text(known, number))),
                *(Cell(_set(end)) for end in ends_text(known, number)),
                Cell("" if it["unit"] == "1" else it["unit"]),
                Cell(it["meaning"]),
            ]
        )
        last = effect
    return table("Parameters with 95 % intervals; a dash where the data set no end", columns, rows)


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
        [f"{it['name']}: {it['title']}" if key == "name" else it[key] for key in keys]
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
