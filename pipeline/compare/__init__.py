"""Models beside measurements: how far off, where and how."""
