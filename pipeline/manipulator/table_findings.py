"""What the paper says of its Table 1 in words, against what comes out without being fitted."""

from collections.abc import Sequence

from pipeline.manipulator.table_record import Cell, Finding, ReadingRow
from vjm import paper

_NEAR = 2.0
"""Factor within which a K_rot is near the printed one, which has two digits."""
_FALLS = -0.5
"""Change of K_tran, %, that counts as a fall; the paper prints three digits."""


def findings(cells: Sequence[Cell], readings: Sequence[ReadingRow]) -> list[Finding]:
    """The three statements, each with its figures."""
    ours = {(c.linkage, c.quantity): c.ours for c in cells if c.model == "vjm"}
    tran, rot = paper.TABLE_1["2x-bar", "vjm"]
    solid = paper.TABLE_1["solid axis", "vjm"]
    gain = ours["solid axis", "K_rot"] / ours["2x-bar", "K_rot"]
    softer = [
        100 * (ours["flexible axis", "K_tran"] / ours["solid axis", "K_tran"] - 1.0),
        100 * (ours["flexible axis", "K_rot"] / ours["solid axis", "K_rot"] - 1.0),
    ]
    change = 100 * (ours["solid axis", "K_tran"] / ours["2x-bar", "K_tran"] - 1.0)
    # A bar with the same pins has the same K_tran to rounding: no minus zero.
    change = 0.0 if abs(change) < 1e-9 else change
    return [
        Finding(
            statement="A parallelogram makes K_rot more than ten times higher.",
            holds=gain > 10.0,
            found=f"x{gain:.0f}, the paper x{solid[1] / rot:.0f}",
        ),
        Finding(
            statement="Flexible axes lower both.",
            holds=max(softer) < 0.0,
            found=f"K_tran {softer[0]:+.1f} %, K_rot {softer[1]:+.1f} %; with any give, for springs in series add",
        ),
        Finding(
            statement="A parallelogram in the place of the 2x-bar lowers K_tran.",
            holds=change < _FALLS,
            found=f"with the same pins {change:+.2f} %, the paper {100 * (solid[0] / tran - 1.0):+.1f} %; "
            + _which(readings, tran / solid[0], rot),
        ),
    ]


def _which(readings: Sequence[ReadingRow], rise: float, rot: float) -> str:
    """Which reading lets K_tran fall as printed and has a K_rot near the printed one, or how near each comes."""

    def higher(r: ReadingRow) -> float:
        return max(r.K_tran_over_parallelogram, r.K_tran_held_over_parallelogram)

    near = [r for r in readings if 1.0 / _NEAR < r.K_rot / rot < _NEAR]
    both = [r.reading for r in near if higher(r) > 0.5 * (1.0 + rise)]
    if both:
        return f"as printed with the reading: {', '.join(both)}"
    most, best = max(readings, key=higher), max(near, key=higher, default=None)
    said = (
        f"no reading gives both printed figures: {most.reading} has {100 * (higher(most) - 1):+.1f} % K_tran "
    )
    said += f"but K_rot {most.K_rot:.2g}"
    if best is not None:
        said += f"; {best.reading} has K_rot {best.K_rot:.2g} but {100 * (higher(best) - 1):+.1f} % K_tran"
    return said
