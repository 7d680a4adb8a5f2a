"""How often the intervals of `predict` hold held-out readings, measured on the benches of the challenge."""
