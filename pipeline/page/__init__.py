"""What a report and the studio show of a campaign, collected into one record."""
