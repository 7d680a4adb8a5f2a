"""Readings of a fitted model at loads, postures and rig values, with 95 % intervals."""
