"""What a user did wrong, in one sentence."""


class InputError(ValueError):
    """Bad input: the message names file and place, what was found and what is allowed."""
