"""Benches that have one thing besides the physics and nothing else: each kind of doubt by itself, with its own goal."""
