"""Virtual joint models: mechanisms as chains of rigid links and lumped springs; arrays in, arrays out.

Conventions (units, order, frames) are stated once, in `vjm.frames`.
"""
