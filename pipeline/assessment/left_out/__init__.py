"""One effect of the catalogue hidden, and left out of it: its place is found as of a law, or that it has none."""
