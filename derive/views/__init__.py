"""Functions over a record: text, LaTeX, Markdown."""
