"""The right spelling of a name that is nearly right."""

from collections.abc import Iterable
from difflib import get_close_matches


def unknown_name(found: str, allowed: Iterable[str]) -> str:
    """What to say of a name that is not allowed: a near one if there is one, else all of them."""
    names = list(allowed)
    folded = {name.casefold(): name for name in reversed(names)}
    near = get_close_matches(found.casefold(), list(folded), n=1, cutoff=0.7 if len(found) > 3 else 0.5)
    if near:
        return f"did you mean {folded[near[0]]!r}?"
    return f"allowed: {', '.join(names)}" if names else "none is allowed here"
