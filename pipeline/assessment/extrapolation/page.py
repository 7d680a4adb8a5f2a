"""The study as a page."""

from __future__ import annotations

from pipeline.assessment.extrapolation.approaches import APPROACHES
from pipeline.assessment.extrapolation.table import ALL, IDENTIFIED, NAMED, Group, Ratio, Study

PICTURE = "extrapolation.png"
_NAMES = {ALL: "all", IDENTIFIED: "identified", NAMED: "named"}
_MEANT = {
    ALL: "all",
    IDENTIFIED: "identified by the diagnosis",
    NAMED: "named, identified with an effect beyond what every bench has,",
}
_ABOUT = """\
Campaigns of the challenge that hide one effect of the catalogue or two, on finite elements. Every approach is given
the same fitted tests, with noise. Then it predicts exact readings that it has not seen, so that the error is its own:

- inside: half way between every two fitted steps, on the same way with the same turning points. The fitted steps
  themselves would show less: who repeats the noise there is punished, who is wild between them is not.
- outside: the same tests at 1.5 times their loads and travels, rows beyond the fitted range of what drives the test.

Error: root mean square over the predicted channels, whitened by the noise of the sensors and of what is prescribed
(1 is what noise alone would give a single reading), with the tangent of the true model for all. A row for which a
model has no stable equilibrium counts 30 in each channel; "lost" counts the cases with such rows outside.

| approach | base | what it does |
|---|---|---|
| plain | lumped virtual springs | nothing is added or fitted |
| refined | plain + bar_geometric_nonlinearity | nothing is fitted |
| polynomial | refined | ridge regression of the whitened residual; degree 0 to 3 and damping by 5-fold validation |
| Gaussian process | refined | the same residual; ARD squared exponential, constant mean, noise known [1] |
| forward AIC | plain | the effect of the catalogue that lowers AIC most is added and all fitted, while it falls [2] |
| diagnosis | plain | `pipeline diagnose`, the first of its sets, whatever the verdict |
| true model | refined | the hidden effects at their true values: what virtual springs can do at best |

Every candidate of AIC that could be the best, by its promise to first order, is fitted with the full model.
Inputs of polynomial and process: q, prescribed displacements and forces, which of them are forces, temperature, and
direction of loading; those that vary, at unit spread. One regression for each whitened channel. Whitening and the
bounds of the lengths (at least one spread) were chosen by the exact readings of some of these cases: in favour of both.
What is hidden here is in the catalogue; nothing is said of what no effect explains.

[1] M. C. Kennedy, A. O'Hagan, J. R. Statist. Soc. B 63 (2001), 425-464. [2] H. Akaike, IEEE Trans. Autom. Control 19
(1974), 716-723."""


def page(it: Study) -> str:
    """Markdown; the source fits 120 columns."""
    lines = [
        "# Beyond the fitted loads: the diagnosis and what else could be done",
        "",
        *_ABOUT.splitlines(),
        "",
        f"## {it.cases} cases",
        "",
        "Median and 90 % quantile of the error.",
        "",
        f"| approach | {' | '.join(f'{_NAMES[g.name]}: inside | outside' for g in it.groups)} |",
        f"|---|{'---|---|' * len(it.groups)}",
        *(f"| {name} | {' | '.join(_errors(group, name) for group in it.groups)} |" for name in APPROACHES),
        "",
        "Cases: " + ", ".join(f"{_MEANT[g.name]} {g.cases}" for g in it.groups) + ".",
        "",
        "| approach | cases with a prediction | lost | seconds |",
        "|---|---|---|---|",
        *(
            f"| {r.approach} | {r.cases} | {r.lost} | {r.seconds:.1f} |"
            for g in it.groups[:1]
            for r in g.rows
        ),
        "",
        "Seconds: median of one processor; those of forward AIC come on top of the diagnosis, whose fits it uses, and",
        "those of polynomial and process on top of the refined model.",
        "",
        "## The Gaussian process beside the diagnosis",
        "",
        "Error outside of the process over that of the diagnosis; 95 % interval of the median by order statistics,",
        "of the share by Clopper and Pearson.",
        "",
        "| cases | of | median ratio (95 %) | diagnosis worse |",
        "|---|---|---|---|",
        *(
            f"| {_NAMES[g.name]} | {g.ratio.cases} | {_ratio(g.ratio)} | {g.ratio.worse} |"
            for g in it.groups
            if g.ratio
        ),
        "",
        f"![Error outside against error inside, every case]({PICTURE})",
        "",
        f"No prediction: {_failed(it)}.",
        f"A case took {it.seconds:.0f} s of one processor in the median.",
        f"Code: {', '.join(each[:13] for each in it.commits)}.",
        f"Again: `python -m pipeline.assessment.extrapolation --cases {it.cases}`.",
        "",
    ]
    return "\n".join(lines)


def _errors(group: Group, approach: str) -> str:
    """Two cells."""
    for r in group.rows:
        if r.approach == approach:
            return (
                f"{_number(r.inside)} {_number(r.inside_90)} | {_number(r.outside)} {_number(r.outside_90)}"
            )
    return "– | –"


def _ratio(it: Ratio) -> str:
    bounds = "–" if it.low is None or it.high is None else f"{_number(it.low)} .. {_number(it.high)}"
    return f"{_number(it.median)} ({bounds})"


def _failed(it: Study) -> str:
    return "; ".join(f"case {where}: {why}" for where, why in it.failed.items()) or "none"


def _number(value: float) -> str:
    """Three digits, two of what is small."""
    if value < 0.1:
        return f"{value:.2g}"
    digits = 3 if value < 1.0 else 2 if value < 10.0 else 1 if value < 100.0 else 0
    return f"{value:.{digits}f}"
