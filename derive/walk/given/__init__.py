"""What a problem gives: the body, its potentials, inputs and damping."""
