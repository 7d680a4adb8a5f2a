"""What `parastiff` gives in Python: a bench that is opened, and results that can be read, drawn, tabled and saved."""
