"""Relative equilibria, what is proved of their stability, and those under inputs."""
