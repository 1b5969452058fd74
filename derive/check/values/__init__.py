"""Values: trees evaluated over rings, what is drawn at random."""
