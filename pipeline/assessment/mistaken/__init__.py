"""How often the look for mistakes of a table names the one that was made, and how often one that was not."""
