"""How often the intervals hold the truth: many benches of one hidden effect that differ in their noise only."""
