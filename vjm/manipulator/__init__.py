"""Whole manipulators: legs of actuated, passive and virtual joints, links and parallelograms, from base to platform."""
