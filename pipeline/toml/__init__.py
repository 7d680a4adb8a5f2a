"""Files in TOML, whatever they describe: their lines, their complaints, the types of their values."""
