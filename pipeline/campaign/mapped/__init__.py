"""Tables as a logger or a spreadsheet leaves them, read by what campaign.toml declares of their columns and units."""
