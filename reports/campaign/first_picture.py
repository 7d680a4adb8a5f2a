"""The picture of the first screen: what plain virtual springs miss most, measured, and as each model has it."""

from matplotlib.figure import Figure

from reports.campaign.curve import COLOURS
from reports.campaign.names import AFTER, BEFORE, measured, spelled, stages_of, standing, unit_label, worst
from reports.campaign.words import PLAIN
from reports.charts import dress
from reports.drafting import save
from reports.load import Json
from reports.style import INK

NAME = "first"
LOOKS = {"before": (BEFORE, "--"), "after": (AFTER, "-")}


def drawn(page: Json) -> tuple[str, bytes]:
    """SVG and PNG; empty where nothing is measured that a model predicts."""
    if not measured(page):
        return "", b""
    test, it = worst(page, 1)[0]
    figure = Figure(figsize=(6.2, 3.7))
    ax = figure.subplots()
    for key in stages_of(page["effects"]):
        name, dash = LOOKS[key]
        ax.plot(_known(test["loads"]), _known(it[key]), color=COLOURS[key], ls=dash, lw=1.8, label=name)
    ax.plot(_known(test["loads"]), _known(it["measured"]), "o", ms=3.4, color=INK, label="measured", zorder=3)
    ax.set_xlabel(f"{spelled(test['load'])}, {unit_label(test['load_unit'])}")
    ax.set_ylabel(f"{spelled(it['channel'])}, {unit_label(it['unit'])}")
    dress(ax)
    # Above the plot: nowhere inside is sure to be free.
    ax.legend(frameon=False, fontsize=9, loc="lower left", bbox_to_anchor=(-0.02, 1.0), ncol=3)
    return save(figure, NAME)


def caption(page: Json) -> str:
    """What is seen."""
    test, it = worst(page, 1)[0]
    models = f"{BEFORE} and {AFTER}" if page["effects"] else PLAIN
    return (
        f"Where plain virtual springs fail most: {spelled(it['channel'])} in test {standing(test)}; "
        f"measured, {models}."
    )


def _known(values: list[float | None]) -> list[float]:
    return [float("nan") if value is None else value for value in values]
