"""The data doctor: discrete mistakes of a table, looked for before any physics."""
