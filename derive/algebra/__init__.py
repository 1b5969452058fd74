"""Words, groups, forms, trees: the mathematics without mechanics."""
