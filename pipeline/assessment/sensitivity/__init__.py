"""What hangs on each threshold of the diagnosis, one changed at a time on benches with a known hidden effect."""
