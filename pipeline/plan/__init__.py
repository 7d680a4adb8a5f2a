"""What a campaign can show, measured or not yet: sizes that it detects and tells apart, and the test to add."""
