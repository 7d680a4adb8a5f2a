"""How good the answers are: virtual benches, the score over many of them, and how often intervals hold the truth."""
