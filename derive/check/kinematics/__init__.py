"""Kinematics of first order: two elements of a group that move by the same inputs."""
