"""Pages in which a body moves: the emitted JavaScript, and what draws it."""
