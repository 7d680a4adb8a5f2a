"""The score of the diagnosis: many virtual benches with hidden effects, none, or what no effect explains."""
