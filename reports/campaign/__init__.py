"""The report of a campaign: reads page.json in a folder, solves nothing."""

from reports.campaign.draw import draw

__all__ = ["draw"]
