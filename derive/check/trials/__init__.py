"""The exact points at which a record is tried: bodies, models, what names mean there."""
