"""Whole manipulators: their description as TOML, the paper's Table 1 and sweeps over the workspace."""
