"""Diagnoses a campaign and adds what is certain, effect by effect, while the error falls."""
