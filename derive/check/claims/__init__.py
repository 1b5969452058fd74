"""What the sentences of a record claim beside its equations, computed again from its trees."""
