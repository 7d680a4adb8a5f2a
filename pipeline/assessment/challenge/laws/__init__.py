"""Benches whose hidden error is a law at a site of the linkage, made by the frame finite elements."""
