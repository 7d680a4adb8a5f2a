"""The dirty programme: benches of which bar, gains of sensors and noise are not quite as they were written."""
