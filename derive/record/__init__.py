"""The record of a walk, its checker, and the paper as printed."""
