"""The report of a campaign: reads page.json in a folder, solves nothing."""

from reports.campaign.draw import draw, first_screen

__all__ = ["draw", "first_screen"]
