"""`init`: a campaign to fill in, with what a file of readings says by itself filled in already."""
