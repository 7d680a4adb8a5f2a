"""The first screen of a result and its pictures, for a notebook: one piece of HTML that needs nothing from outside."""
