"""From fits to the sets of effects that may be true."""
