"""The form of a record: heads, names, symbols, hypotheses."""
