"""What a model leaves, as a function of what was prescribed: it describes and is no physics."""
