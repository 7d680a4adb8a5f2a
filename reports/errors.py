"""The one error of this package."""


class ReportError(Exception):
    """A report cannot be drawn; the message is one sentence that names the file and what is wrong with it."""
