"""Records on a terminal of 80 columns."""
