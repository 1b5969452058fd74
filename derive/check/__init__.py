"""The independent checker: every equation of a record at exact points, by another road."""
