"""Documents made of a record: text, LaTeX, Markdown, a page; their words in two languages."""
