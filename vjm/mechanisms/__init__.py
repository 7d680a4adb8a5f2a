"""One cited mechanism per file."""
