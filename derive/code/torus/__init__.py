"""The emitted code of a fluid on the torus: written out for small N, else loops over matrices."""
