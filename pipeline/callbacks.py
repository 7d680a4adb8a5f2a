"""What long work calls while it goes on."""

from collections.abc import Callable

OnProgress = Callable[[str], None]
"""Told in a few words what is being done; what it does with them changes nothing in the work."""
