"""Records in sentences."""
