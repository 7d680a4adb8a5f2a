"""What was found about a campaign, as records; sentences and tables are made from them and compute nothing."""
