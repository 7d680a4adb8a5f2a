"""Effects added to a campaign's model, fitted, and what that changed."""
