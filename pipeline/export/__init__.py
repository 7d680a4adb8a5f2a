"""`export`: stiffness matrices as files that other programs read."""
