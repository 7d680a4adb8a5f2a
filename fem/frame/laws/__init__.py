"""One-dimensional force laws: a coordinate and a memory in; force, its derivative and the new memory out."""
