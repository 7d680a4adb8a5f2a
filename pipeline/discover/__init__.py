"""What no effect of the catalogue explains: where in the mechanism the rest sits, and what law it follows."""
