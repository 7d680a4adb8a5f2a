"""The virtual bench: campaigns measured on a finite-element truth with hidden effects."""
