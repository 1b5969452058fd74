"""Each rule of the engine made wrong in its source, once at a time: what notices it."""
