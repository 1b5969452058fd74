"""Words, calculus and groups: the mathematics without mechanics."""
