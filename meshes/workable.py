"""Whether a bar can be meshed at a resolution, judged before anything is meshed."""

from meshes.bar import Bar
from meshes.resolution import Resolution

# Half a million quadratic hexahedra are six million unknowns, beyond what a direct solver takes here.
MOST_CELLS = 5e5


def require_workable(bar: Bar, resolution: Resolution) -> None:
    """Raise ValueError for a mesh size that resolves nothing or that no machine could hold."""
    coarsest = bar.length / 4
    if resolution.size > coarsest:
        raise ValueError(
            f"mesh size is {resolution.size:g} mm, allowed is at most a quarter of the bar's length, {coarsest:g} mm"
        )
    cells = estimated_cells(bar, resolution)
    if cells > MOST_CELLS:
        raise ValueError(
            f"mesh size is {resolution.size:g} mm, at level {resolution.level} that makes about {cells:.2g} cells; "
            f"allowed are {MOST_CELLS:g}: take a larger size"
        )


def estimated_cells(bar: Bar, resolution: Resolution) -> float:
    """About how many swept hexahedra a bar takes."""
    width, height = bar.section.size
    filled = bar.section.area / (width * height)
    across = resolution.across(width) * resolution.across(height)
    return max(filled * across, resolution.level**2) * 2.0 * resolution.along(bar.length / 2)[0]
