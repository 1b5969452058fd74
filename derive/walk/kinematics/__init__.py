"""Kinematics of first order on a group: the errors of an estimate, and when they move linearly."""
