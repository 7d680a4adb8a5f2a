"""The documentation: pages in MyST Markdown, and `docs.made`, which writes the parts that are generated."""
