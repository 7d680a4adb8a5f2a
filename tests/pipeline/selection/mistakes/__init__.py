"""Tests of the mistakes of a table."""
