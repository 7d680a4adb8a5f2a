"""What a user did wrong, in one sentence."""


class InputError(ValueError):
    """Bad input: the message names file and place, what was found and what is allowed."""


def unread(error: OSError) -> str:
    """What to say behind the name of a file that could not be read."""
    return "is missing" if isinstance(error, FileNotFoundError) else f"cannot be read: {error.strerror}"
