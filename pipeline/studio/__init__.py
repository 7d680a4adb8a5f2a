"""The same as on the command line, by clicking: a page on this machine's own address."""
